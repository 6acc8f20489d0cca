#include "calibrate/images/find_corners.h"

#include <glob.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <opencv2/imgcodecs.hpp>

#include "calibrate/targets/chessboard_detector.h"
#include "core/error.h"
#include "core/interrupt.h"
#include "core/parallel.h"
#include "core/progress.h"
#include "core/text.h"

namespace bpms {
namespace {

struct Image {
  std::string path;
  ImageName name;
  int width_px = 0, height_px = 0;
  std::optional<std::vector<Eigen::Vector2d>> corners;
  std::string trouble;
};

Image name_image(const std::string& path, const ImageNaming& name_of) {
  Image out{path, {}, 0, 0, std::nullopt, {}};
  if (path.find_first_of("*?[") != std::string::npos && !std::filesystem::exists(path)) {
    out.trouble = "no file matches";
    return out;
  }
  try {
    out.name = name_of(path);
  } catch (const Error& error) {
    out.trouble = error.message();
  }
  return out;
}

// The PNG decoder would say so on stderr by itself, without the file's name.
bool is_png_cut_short(const std::string& path) {
  const std::string bytes = read_file(path);
  constexpr std::string_view end = "IEND\xae\x42\x60\x82";
  return bytes.starts_with("\x89PNG") && bytes.find(end) == std::string::npos;
}

void look(const Target& target, Image& image) {
  if (!std::filesystem::exists(image.path)) {
    image.trouble = "no such file";
    return;
  }
  if (is_png_cut_short(image.path)) {
    image.trouble = "is cut short";
    return;
  }
  cv::Mat grey;
  try {
    grey = cv::imread(image.path, cv::IMREAD_GRAYSCALE | cv::IMREAD_IGNORE_ORIENTATION);
  } catch (const cv::Exception&) {  // broken in a way the decoder did not expect: as unreadable as any other
  }
  if (grey.empty()) {
    image.trouble = "cannot be read as an image";
    return;
  }
  image.width_px = grey.cols;
  image.height_px = grey.rows;
  image.corners = find_chessboard(grey, target);
  if (!image.corners)
    image.trouble = fmt::format("no whole {}x{} chessboard found", target.columns, target.rows);
}

// The size that most readable images of the camera have.
std::pair<int, int> usual_size(const std::vector<Image>& images, const std::string& camera) {
  std::map<std::pair<int, int>, int> votes;
  for (const Image& image : images) {
    if (image.name.camera == camera && image.width_px > 0) ++votes[{image.width_px, image.height_px}];
  }
  std::pair<int, int> best{0, 0};
  int most = 0;
  for (const auto& [size, count] : votes) {
    if (count > most) most = count, best = size;
  }
  return best;
}

// A board that looks the same after half a turn: the first view of a frame decides, the others follow the
// direction of its rows in the image (cameras are rolled by less than 90 degrees against each other).
void agree_on_half_turns(const Target& target, Observations& observations) {
  if ((target.columns + target.rows) % 2 != 0) return;
  std::map<std::string, Eigen::Vector2d> along_of_frame;
  for (BoardView& view : observations.views) {
    const Eigen::Vector2d along =
        view.corners[static_cast<std::size_t>(target.columns - 1)].pixel - view.corners[0].pixel;
    const auto [first, fresh] = along_of_frame.emplace(view.frame, along);
    if (fresh || first->second.dot(along) > 0) continue;
    for (ImageCorner& corner : view.corners) corner.point = target.size() - 1 - corner.point;
  }
}

}  // namespace

std::vector<std::string> expand_patterns(const std::vector<std::string>& arguments) {
  std::vector<std::string> out;
  for (const std::string& argument : arguments) {
    glob_t found{};
    if (!std::filesystem::exists(argument) && glob(argument.c_str(), 0, nullptr, &found) == 0) {
      for (std::size_t i = 0; i < found.gl_pathc; ++i) out.emplace_back(found.gl_pathv[i]);
    } else {
      out.push_back(argument);
    }
    globfree(&found);
  }
  return out;
}

Observations find_corners(const std::vector<std::string>& paths, const Target& target,
                          const ImageNaming& name_of) {
  std::vector<Image> images;
  for (const std::string& path : paths) images.push_back(name_image(path, name_of));
  Progress progress("finding corners", images.size());
  parallel_for(images.size(), [&](std::size_t i) {
    throw_if_interrupted();
    if (images[i].trouble.empty()) look(target, images[i]);
    progress.add();
  });

  Observations out;
  std::map<std::string, int> index;
  std::map<std::pair<int, std::string>, std::string> taken;
  for (Image& image : images) {
    const auto [width, height] = usual_size(images, image.name.camera);
    if (image.width_px > 0 && std::pair(image.width_px, image.height_px) != std::pair(width, height))
      image.trouble = fmt::format("{}x{} pixels; most images of camera {} have {}x{}", image.width_px,
                                  image.height_px, image.name.camera, width, height);
    if (!image.trouble.empty()) {
      out.skipped.push_back({image.path, image.trouble});
      continue;
    }
    const auto [camera, fresh] = index.emplace(image.name.camera, static_cast<int>(out.cameras.size()));
    if (fresh) out.cameras.push_back({image.name.camera, width, height});
    const auto [twin, first] = taken.emplace(std::pair(camera->second, image.name.frame), image.path);
    if (!first)
      bad_input({image.path}, "a second image of frame {} of camera {}, beside {}", image.name.frame,
                image.name.camera, twin->second);
    BoardView view{image.path, camera->second, image.name.frame, {}};
    for (int i = 0; i < target.size(); ++i)
      view.corners.push_back({i, (*image.corners)[static_cast<std::size_t>(i)]});
    out.views.push_back(std::move(view));
  }
  agree_on_half_turns(target, out);
  return out;
}

}  // namespace bpms
