// COLMAP's binary files: little-endian, counts and point ids of 64 bits, other ids of 32, doubles.
#include <bit>
#include <cstring>
#include <limits>

#include "calibrate/exchange/camera_numbers.h"
#include "calibrate/exchange/colmap_camera.h"
#include "calibrate/exchange/colmap_ids.h"

static_assert(std::endian::native == std::endian::little, "COLMAP's binary files are read as they lie");

namespace bpms {
namespace {

class ColmapBytes {
 public:
  ColmapBytes(const std::string& path, const std::string& bytes) : path_(path), bytes_(bytes) {}

  template <class T>
  T take(const char* what) {
    if (bytes_.size() - at_ < sizeof(T))
      bad_input({path_}, "ends at byte {} in the middle of {}", bytes_.size(), what);
    T out;
    std::memcpy(&out, bytes_.data() + at_, sizeof(T));
    at_ += sizeof(T);
    return out;
  }
  // A count of things of at least `least` bytes each, which must all still follow.
  std::uint64_t count(std::size_t least, const char* what) {
    const std::size_t before = at_;
    const auto out = take<std::uint64_t>(what);
    if (out > (bytes_.size() - at_) / least)
      bad_input({path_}, "at byte {}: {} {} are announced, only {} bytes follow", before, out, what,
                bytes_.size() - at_);
    return out;
  }
  std::string text(const char* what) {
    const std::size_t end = bytes_.find('\0', at_);
    if (end == std::string::npos) bad_input({path_}, "ends in the middle of {}", what);
    std::string out = bytes_.substr(at_, end - at_);
    at_ = end + 1;
    return out;
  }
  void finish() const {
    if (at_ != bytes_.size())
      bad_input({path_}, "{} bytes are left over after the last entry", bytes_.size() - at_);
  }
  SourceLocation where() const { return {path_}; }

 private:
  const std::string& path_;
  const std::string& bytes_;
  std::size_t at_ = 0;
};

ColmapParts::CameraPart binary_camera(ColmapBytes& in) {
  ColmapParts::CameraPart out;
  out.where = in.where();
  out.id = in.take<std::uint32_t>("a camera");
  const auto model = in.take<std::int32_t>("a camera");
  const auto width = in.take<std::uint64_t>("a camera"), height = in.take<std::uint64_t>("a camera");
  const ColmapLens* lens = find_colmap_lens(model);
  if (lens == nullptr) bad_input(out.where, "camera {} has the unknown model number {}", out.id, model);
  if (width > largest_camera_image_px || height > largest_camera_image_px)
    bad_input(out.where, "camera {} has {}x{} pixels, expected at most 1000000 each way", out.id, width,
              height);
  out.camera.width_px = static_cast<int>(width);
  out.camera.height_px = static_cast<int>(height);
  std::vector<double> numbers;
  for (int i = 0; i < lens->parameters; ++i) numbers.push_back(in.take<double>("a camera"));
  set_colmap_parameters(*lens, numbers, out.where, out.camera);
  return out;
}

ColmapParts::ImagePart binary_image(ColmapBytes& in) {
  ColmapParts::ImagePart out;
  out.where = in.where();
  out.image.id = in.take<std::uint32_t>("an image");
  Eigen::Vector4d q;
  for (double& x : q) x = in.take<double>("an image");
  for (double& x : out.image.cam_from_world.t_m) x = in.take<double>("an image");
  out.image.cam_from_world.r = sound_rotation(q, out.where);
  out.camera_id = in.take<std::uint32_t>("an image");
  out.image.name = in.text("an image's name");
  constexpr std::size_t keypoint_bytes = 24;
  const std::uint64_t keypoints = in.count(keypoint_bytes, "keypoints");
  for (std::uint64_t i = 0; i < keypoints; ++i) {
    const auto x = in.take<double>("a keypoint"), y = in.take<double>("a keypoint");
    out.image.keypoints_px.emplace_back(x - 0.5, y - 0.5);
    out.point_ids.push_back(in.take<std::uint64_t>("a keypoint"));
  }
  return out;
}

ColmapParts::PointPart binary_point(ColmapBytes& in) {
  ColmapParts::PointPart out;
  out.where = in.where();
  out.point.id = in.take<std::uint64_t>("a point");
  for (double& x : out.point.x_world) x = in.take<double>("a point");
  for (std::uint8_t* c : {&out.point.red, &out.point.green, &out.point.blue})
    *c = in.take<std::uint8_t>("a point");
  out.point.error_px = in.take<double>("a point");
  constexpr std::size_t sight_bytes = 8;
  const std::uint64_t sights = in.count(sight_bytes, "entries of a track");
  for (std::uint64_t i = 0; i < sights; ++i) {
    const auto image = in.take<std::uint32_t>("a track");
    out.track.push_back({image, in.take<std::uint32_t>("a track")});
  }
  return out;
}

}  // namespace

ColmapModel parse_colmap_binary(const ColmapFiles& files) {
  ColmapParts parts;
  ColmapBytes cameras(files.cameras_path, files.cameras), images(files.images_path, files.images),
      points(files.points_path, files.points);
  constexpr std::size_t least_camera = 48, least_image = 73, least_point = 51;
  for (auto n = cameras.count(least_camera, "cameras"); n > 0; --n)
    parts.cameras.push_back(binary_camera(cameras));
  cameras.finish();
  for (auto n = images.count(least_image, "images"); n > 0; --n) parts.images.push_back(binary_image(images));
  images.finish();
  for (auto n = points.count(least_point, "points"); n > 0; --n) parts.points.push_back(binary_point(points));
  points.finish();
  return join_colmap(std::move(parts));
}

}  // namespace bpms
