#include "calibrate/exchange/colmap_ids.h"

#include <cmath>
#include <limits>
#include <set>
#include <unordered_map>

#include "calibrate/exchange/camera_numbers.h"

namespace bpms {
namespace {

template <class Id>
using ColmapIndex = std::unordered_map<Id, int>;

template <class Id>
void number_colmap_part(ColmapIndex<Id>& index, Id id, const char* what, const SourceLocation& where) {
  if (!index.emplace(id, static_cast<int>(index.size())).second)
    bad_input(where, "a second {} with the id {}", what, id);
}

void require_sound_point(const ColmapPoint& point, const SourceLocation& where) {
  if (!is_sound_vector(point.x_world) || !std::isfinite(point.error_px))
    bad_input(where, "point {} has coordinates or an error that are no finite numbers below 1e12", point.id);
}

}  // namespace

ColmapModel join_colmap(ColmapParts parts) {
  ColmapModel out;
  ColmapIndex<std::uint32_t> cameras, images;
  ColmapIndex<std::uint64_t> points;
  for (auto& part : parts.cameras) {
    number_colmap_part(cameras, part.id, "camera", part.where);
    require_sound_size(part.camera, part.where);
    part.camera.name = std::to_string(part.id);
    out.cameras.push_back(std::move(part.camera));
  }
  for (const auto& part : parts.points) {
    number_colmap_part(points, part.point.id, "point", part.where);
    require_sound_point(part.point, part.where);
  }
  std::set<std::string> names;
  for (auto& part : parts.images) {
    ColmapImage& image = part.image;
    number_colmap_part(images, image.id, "image", part.where);
    if (!names.insert(image.name).second)
      bad_input(part.where, "a second image named {}", in_quotes(image.name));
    const auto camera = cameras.find(part.camera_id);
    if (camera == cameras.end())
      bad_input(part.where, "image {} is of camera {}, which is not there", in_quotes(image.name),
                part.camera_id);
    image.camera = camera->second;
    if (!is_sound_vector(image.cam_from_world.t_m))
      bad_input(part.where, "the translation of image {} is no finite vector", in_quotes(image.name));
    for (std::size_t i = 0; i < part.point_ids.size(); ++i) {
      if (!is_sound_vector(image.keypoints_px[i]))
        bad_input(part.where, "keypoint {} of image {} is no finite pixel", i, in_quotes(image.name));
      int point = -1;
      if (part.point_ids[i] != no_colmap_point) {
        const auto at = points.find(part.point_ids[i]);
        if (at == points.end())
          bad_input(part.where, "image {} shows point {}, which is not among the points",
                    in_quotes(image.name), part.point_ids[i]);
        point = at->second;
      }
      image.points.push_back(point);
    }
    out.images.push_back(std::move(image));
  }
  for (auto& part : parts.points) {
    for (const auto& sight : part.track) {
      const auto image = images.find(sight.image_id);
      if (image == images.end())
        bad_input(part.where, "point {} is seen in image {}, which is not there", part.point.id,
                  sight.image_id);
      const std::size_t keypoints = out.images[static_cast<std::size_t>(image->second)].keypoints_px.size();
      if (sight.keypoint >= keypoints)
        bad_input(part.where, "point {} is keypoint {} of image {}, which has {} (counted from 0)",
                  part.point.id, sight.keypoint, sight.image_id, keypoints);
      part.point.track.push_back({image->second, static_cast<int>(sight.keypoint)});
    }
    out.points.push_back(std::move(part.point));
  }
  return out;
}

}  // namespace bpms
