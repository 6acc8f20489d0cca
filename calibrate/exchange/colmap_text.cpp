// COLMAP's text files: a line a camera and a point, two lines an image, of which the second may be empty.
#include <cmath>
#include <limits>

#include "calibrate/exchange/camera_numbers.h"
#include "calibrate/exchange/colmap_camera.h"
#include "calibrate/exchange/colmap_ids.h"
#include "core/text.h"

namespace bpms {
namespace {

class ColmapLines {
 public:
  ColmapLines(const std::string& path, std::string_view text) : path_(path), text_(text) {}

  std::optional<std::string_view> next() {
    if (at_ >= text_.size()) return std::nullopt;
    const std::size_t end = std::min(text_.find('\n', at_), text_.size());
    std::string_view line = text_.substr(at_, end - at_);
    if (line.ends_with('\r')) line.remove_suffix(1);
    at_ = end + 1;
    ++number_;
    return line;
  }
  // The next line that is neither blank nor a comment.
  std::optional<std::string_view> next_entry() {
    for (auto line = next(); line; line = next()) {
      const std::size_t first = line->find_first_not_of(" \t");
      if (first != std::string_view::npos && (*line)[first] != '#') return line;
    }
    return std::nullopt;
  }
  const std::string& path() const { return path_; }
  int number() const { return number_; }

 private:
  const std::string& path_;
  std::string_view text_;
  std::size_t at_ = 0;
  int number_ = 0;
};

// The words of one line, with their columns.
class ColmapWords {
 public:
  ColmapWords(const ColmapLines& lines, std::string_view line) : lines_(lines), line_(line) { skip(); }

  bool done() const { return at_ >= line_.size(); }
  SourceLocation where() const { return {lines_.path(), lines_.number(), static_cast<int>(at_) + 1}; }
  std::string_view word(const char* expected) {
    if (done()) bad_input(where(), "the line ends, expected {}", expected);
    const std::size_t end = std::min(line_.find_first_of(" \t", at_), line_.size());
    const std::string_view out = line_.substr(at_, end - at_);
    at_ = end;
    skip();
    return out;
  }
  std::string_view rest(const char* expected) {
    if (done()) bad_input(where(), "the line ends, expected {}", expected);
    std::string_view out = line_.substr(at_);
    out = out.substr(0, out.find_last_not_of(" \t") + 1);
    at_ = line_.size();
    return out;
  }
  double number(const char* expected) {
    const SourceLocation here = where();
    const std::string_view text = word(expected);
    const auto out = parse_number(text);
    if (!out || std::abs(*out) > largest_camera_number)
      bad_input(here, "found {}, expected {}: a number of at most 1e12", in_quotes(text), expected);
    return *out;
  }
  long long integer(const char* expected, long long low, long long high) {
    const SourceLocation here = where();
    const std::string_view text = word(expected);
    const auto out = parse_integer(text);
    if (!out || *out < low || *out > high)
      bad_input(here, "found {}, expected {} from {} to {}", in_quotes(text), expected, low, high);
    return *out;
  }

 private:
  void skip() {
    while (at_ < line_.size() && (line_[at_] == ' ' || line_[at_] == '\t')) ++at_;
  }
  const ColmapLines& lines_;
  std::string_view line_;
  std::size_t at_ = 0;
};

constexpr long long largest_colmap_id = std::numeric_limits<std::uint32_t>::max() - 1;
constexpr long long largest_colmap_point = std::numeric_limits<std::int64_t>::max();

std::uint32_t colmap_id(ColmapWords& words, const char* what) {
  return static_cast<std::uint32_t>(words.integer(what, 0, largest_colmap_id));
}

ColmapParts::CameraPart text_camera(ColmapWords words) {
  ColmapParts::CameraPart out;
  out.where = words.where();
  out.id = colmap_id(words, "the camera's id");
  const SourceLocation model_at = words.where();
  const std::string_view model = words.word("a camera model");
  const ColmapLens* lens = find_colmap_lens(model);
  if (lens == nullptr)
    bad_input(model_at, "unknown camera model {}; read are {}", in_quotes(model), colmap_lens_names());
  out.camera.width_px = static_cast<int>(words.integer("the width in pixels", 1, largest_camera_image_px));
  out.camera.height_px = static_cast<int>(words.integer("the height in pixels", 1, largest_camera_image_px));
  std::vector<double> numbers;
  while (!words.done()) numbers.push_back(words.number("a parameter of the camera"));
  if (numbers.size() != static_cast<std::size_t>(lens->parameters))
    bad_input(model_at, "{} parameters of a camera {}, expected {}", numbers.size(), model, lens->parameters);
  set_colmap_parameters(*lens, numbers, model_at, out.camera);
  return out;
}

ColmapParts::ImagePart text_image(ColmapWords words) {
  ColmapParts::ImagePart out;
  out.where = words.where();
  out.image.id = colmap_id(words, "the image's id");
  const SourceLocation quaternion_at = words.where();
  Eigen::Vector4d q;
  for (double& x : q) x = words.number("the quaternion w x y z");
  out.image.cam_from_world.r = sound_rotation(q, quaternion_at);
  for (double& x : out.image.cam_from_world.t_m) x = words.number("the translation x y z");
  out.camera_id = colmap_id(words, "the camera's id");
  out.image.name = words.rest("the image's name");
  return out;
}

void text_keypoints(ColmapWords words, ColmapParts::ImagePart& out) {
  while (!words.done()) {
    const double x = words.number("a keypoint's x"), y = words.number("a keypoint's y");
    out.image.keypoints_px.emplace_back(x - 0.5, y - 0.5);
    const long long point = words.integer("a keypoint's point", -1, largest_colmap_point);
    out.point_ids.push_back(point < 0 ? no_colmap_point : static_cast<std::uint64_t>(point));
  }
}

ColmapParts::PointPart text_point(ColmapWords words) {
  ColmapParts::PointPart out;
  out.where = words.where();
  out.point.id = static_cast<std::uint64_t>(words.integer("the point's id", 0, largest_colmap_point));
  for (double& x : out.point.x_world) x = words.number("the point x y z");
  constexpr int brightest = 255;
  for (std::uint8_t* c : {&out.point.red, &out.point.green, &out.point.blue})
    *c = static_cast<std::uint8_t>(words.integer("a colour", 0, brightest));
  out.point.error_px = words.number("the reprojection error");
  while (!words.done()) {
    const std::uint32_t image = colmap_id(words, "the id of an image of the track");
    out.track.push_back({image, colmap_id(words, "a keypoint of the track")});
  }
  return out;
}

std::vector<std::uint64_t> written_ids(const std::vector<std::uint64_t>& ids) {
  std::vector<std::uint64_t> sorted = ids;
  std::sort(sorted.begin(), sorted.end());
  const bool good = std::adjacent_find(sorted.begin(), sorted.end()) == sorted.end() &&
                    (sorted.empty() || sorted.front() > 0);
  std::vector<std::uint64_t> out = ids;
  for (std::size_t i = 0; !good && i < out.size(); ++i) out[i] = i + 1;
  return out;
}

std::string shortest(double value) {
  return fmt::format("{}", value);
}

}  // namespace

ColmapModel parse_colmap_text(const ColmapFiles& files) {
  ColmapParts parts;
  ColmapLines cameras(files.cameras_path, files.cameras), images(files.images_path, files.images),
      points(files.points_path, files.points);
  while (const auto line = cameras.next_entry()) parts.cameras.push_back(text_camera({cameras, *line}));
  while (const auto line = images.next_entry()) {
    parts.images.push_back(text_image({images, *line}));
    if (const auto second = images.next()) text_keypoints({images, *second}, parts.images.back());
  }
  while (const auto line = points.next_entry()) parts.points.push_back(text_point({points, *line}));
  return join_colmap(std::move(parts));
}

ColmapFiles colmap_text(const ColmapModel& model, const std::string& folder) {
  const std::string in = folder.empty() || folder.ends_with('/') ? folder : folder + "/";
  ColmapFiles out{in + "cameras.txt",
                  "# CAMERA_ID MODEL WIDTH HEIGHT PARAMS[]\n",
                  in + "images.txt",
                  "# IMAGE_ID QW QX QY QZ TX TY TZ CAMERA_ID NAME, then X Y POINT3D_ID of each keypoint\n",
                  in + "points3D.txt",
                  "# POINT3D_ID X Y Z R G B ERROR (IMAGE_ID POINT2D_IDX)[]\n"};
  for (std::size_t c = 0; c < model.cameras.size(); ++c) {
    const Camera& camera = model.cameras[c];
    const ColmapParameters lens = colmap_parameters(camera);
    out.cameras += fmt::format("{} {} {} {}", c + 1, lens.model, camera.width_px, camera.height_px);
    for (const double p : lens.numbers) out.cameras += " " + shortest(p);
    out.cameras += "\n";
  }
  std::vector<std::uint64_t> image_ids, point_ids;
  for (const ColmapImage& image : model.images) image_ids.push_back(image.id);
  for (const ColmapPoint& point : model.points) point_ids.push_back(point.id);
  image_ids = written_ids(image_ids);
  point_ids = written_ids(point_ids);
  for (std::size_t i = 0; i < model.images.size(); ++i) {
    const ColmapImage& image = model.images[i];
    if (image.name.empty() || image.name.find_first_of(" \t\r\n") != std::string::npos)
      bad_input({out.images_path}, "the name {} cannot stand in COLMAP's text, which separates by blanks",
                in_quotes(image.name));
    const Eigen::Vector4d q = quaternion_wxyz(image.cam_from_world.r);
    out.images += std::to_string(image_ids[i]);
    for (const double x : q) out.images += " " + shortest(x);
    for (const double x : image.cam_from_world.t_m) out.images += " " + shortest(x);
    out.images += fmt::format(" {} {}\n", image.camera + 1, image.name);
    for (std::size_t k = 0; k < image.keypoints_px.size(); ++k) {
      const int point = image.points[k];
      out.images += fmt::format(
          "{}{} {} {}", k > 0 ? " " : "", image.keypoints_px[k].x() + 0.5, image.keypoints_px[k].y() + 0.5,
          point < 0 ? "-1" : std::to_string(point_ids[static_cast<std::size_t>(point)]));
    }
    out.images += "\n";
  }
  for (std::size_t i = 0; i < model.points.size(); ++i) {
    const ColmapPoint& p = model.points[i];
    out.points += fmt::format("{} {} {} {} {} {} {} {}", point_ids[i], p.x_world.x(), p.x_world.y(),
                              p.x_world.z(), p.red, p.green, p.blue, p.error_px);
    for (const auto& sight : p.track)
      out.points += fmt::format(" {} {}", image_ids[static_cast<std::size_t>(sight.image)], sight.keypoint);
    out.points += "\n";
  }
  return out;
}

}  // namespace bpms
