#include "calibrate/observations.h"

#include <algorithm>
#include <filesystem>
#include <map>

#include "core/text.h"

namespace bpms {
namespace {

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

std::string without_separators(std::string_view text) {
  constexpr std::string_view separators = "_-. ";
  while (!text.empty() && separators.find(text.front()) != std::string_view::npos) text.remove_prefix(1);
  while (!text.empty() && separators.find(text.back()) != std::string_view::npos) text.remove_suffix(1);
  return std::string(text);
}

int camera_index(Observations& out, const std::string& name, int width_px, int height_px) {
  for (std::size_t i = 0; i < out.cameras.size(); ++i) {
    if (out.cameras[i].name == name) return static_cast<int>(i);
  }
  out.cameras.push_back({name, width_px, height_px});
  return static_cast<int>(out.cameras.size()) - 1;
}

// The name of an image that stands in a table.
ImageName image_name(const std::string& image, const SourceLocation& where) {
  try {
    return parse_image_name(image);
  } catch (const Error& error) {
    bad_input(where, "{}: {}", in_quotes(image), error.message());
  }
}

}  // namespace

ImageName parse_image_name(const std::string& path) {
  const std::filesystem::path file(path);
  const std::string stem = file.stem().string();
  std::size_t end = stem.size();
  while (end > 0 && !is_digit(stem[end - 1])) --end;
  std::size_t begin = end;
  while (begin > 0 && is_digit(stem[begin - 1])) --begin;
  if (begin == end)
    bad_input({path}, "no digits in the name; expected a camera and a frame, as in left01.jpg");
  ImageName out;
  out.frame = stem.substr(begin, end - begin);
  out.camera = without_separators(without_separators(stem.substr(0, begin)) + stem.substr(end));
  if (out.camera.empty()) out.camera = file.parent_path().filename().string();
  if (out.camera.empty()) out.camera = "camera";
  return out;
}

ImageName parse_shot_name(const std::string& path, const std::vector<std::string>& cameras) {
  const std::string stem = std::filesystem::path(path).stem().string();
  const bool digits = std::any_of(stem.begin(), stem.end(), is_digit);
  ImageName out{without_separators(stem), "1"};
  if (digits) out = parse_image_name(path);
  const auto known = [&](const std::string& name) {
    return std::find(cameras.begin(), cameras.end(), name) != cameras.end();
  };
  if (known(out.camera)) return out;
  std::vector<std::string> words;
  for (std::size_t at = 0; at <= out.camera.size();) {
    const std::size_t end = std::min(out.camera.find_first_of("_-. ", at), out.camera.size());
    if (known(out.camera.substr(at, end - at))) words.push_back(out.camera.substr(at, end - at));
    at = end + 1;
  }
  if (words.size() != 1)
    bad_input({path},
              "the name does not say which camera it is of: {}; expected one of them in it, as in {}1.png",
              fmt::join(cameras, ", "), cameras.empty() ? "left" : cameras.front());
  out.camera = words.front();
  return out;
}

Observations read_corners(const std::string& path, int width_px, int height_px, int corners_per_image) {
  const std::string text = read_text(path);
  TokenReader reader(path, text);
  Observations out;
  std::map<std::string, std::size_t> view_of_image;
  std::map<std::pair<int, std::string>, std::string> image_of_frame;
  std::vector<int> rows;  // of each view, found or not
  const auto check_whole = [&](const SourceLocation& where) {
    if (!rows.empty() && rows.back() != corners_per_image)
      bad_input(where, "{} has {} corners, the target has {}", out.views.back().image, rows.back(),
                corners_per_image);
  };
  while (const auto token = reader.next()) {
    const std::string image(token->text);
    if (out.views.empty() || out.views.back().image != image) {
      check_whole(reader.where(*token));
      if (!view_of_image.emplace(image, out.views.size()).second)
        bad_input(reader.where(*token), "corners of {} appear in two places", in_quotes(image));
      const ImageName name = image_name(image, reader.where(*token));
      BoardView view{image, camera_index(out, name.camera, width_px, height_px), name.frame, {}};
      const auto [twin, fresh] = image_of_frame.emplace(std::pair(view.camera, view.frame), image);
      if (!fresh)
        bad_input(reader.where(*token), "{} and {} are both frame {} of camera {}", twin->second, image,
                  view.frame, name.camera);
      out.views.push_back(std::move(view));
      rows.push_back(0);
    }
    if (++rows.back() > corners_per_image)
      bad_input(reader.where(*token), "{} has more corners than the target's {}", in_quotes(image),
                corners_per_image);
    const auto u = reader.next(), v = reader.next(), level = reader.next();
    if (!level || u->line != token->line || level->line != token->line)
      bad_input(reader.where(*token), "expected four fields in the row: filename x y level");
    if (level->text == "-") continue;
    if (!parse_integer(level->text))
      bad_input(reader.where(*level), "level {}; expected an integer or -", in_quotes(level->text));
    ImageCorner corner{rows.back() - 1, {}};
    const Token* const coordinates[] = {&*u, &*v};
    const int size[] = {width_px, height_px};
    for (int axis = 0; axis < 2; ++axis) {
      const auto value = parse_number(coordinates[axis]->text);
      if (!value)
        bad_input(reader.where(*coordinates[axis]), "{}; expected a coordinate in pixels",
                  in_quotes(coordinates[axis]->text));
      if (!(*value >= -0.5 && *value <= size[axis] - 0.5))
        bad_input(reader.where(*coordinates[axis]), "{} lies outside the {}x{} image", *value, width_px,
                  height_px);
      corner.pixel[axis] = *value;
    }
    out.views.back().corners.push_back(corner);
  }
  check_whole(reader.here());
  if (out.views.empty()) bad_input({path}, "no corners, expected rows of filename x y level");
  for (std::size_t i = out.views.size(); i-- > 0;) {
    if (!out.views[i].corners.empty()) continue;
    out.skipped.push_back({out.views[i].image, "no corners"});
    out.views.erase(out.views.begin() + static_cast<std::ptrdiff_t>(i));
  }
  std::reverse(out.skipped.begin(), out.skipped.end());
  return out;
}

}  // namespace bpms
