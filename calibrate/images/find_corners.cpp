#include "calibrate/images/find_corners.h"

#include <glob.h>

#include <algorithm>
#include <filesystem>
#include <map>

#include "calibrate/images/image_file.h"
#include "calibrate/images/overlay.h"
#include "calibrate/images/view_quality.h"
#include "calibrate/targets/target_kind.h"
#include "core/atomic_file.h"
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
  std::string device, sha256;
  std::vector<Detection> found;  // of each target
  std::vector<ViewQuality> quality;
  std::vector<std::string> remarks;
  std::string trouble;
};

Image name_image(const std::string& path) {
  Image out;
  out.path = path;
  if (path.find_first_of("*?[") != std::string::npos && !std::filesystem::exists(path)) {
    out.trouble = "no file matches";
    return out;
  }
  try {
    out.name = parse_image_name(path);
  } catch (const Error& error) {
    out.trouble = error.message();
  }
  return out;
}

void look(const std::vector<Target>& targets, const FindOptions& options, Image& image) {
  const ImageFile file = read_image_file(image.path);
  image.sha256 = file.sha256;
  image.device = file.header.device();
  image.remarks = file.remarks;
  image.trouble = file.trouble;
  if (!image.trouble.empty()) return;
  image.width_px = file.grey.cols;
  image.height_px = file.grey.rows;
  std::string none;
  bool any = false;
  for (const Target& target : targets) {
    Detection found = detect_target(file.grey, target);
    any |= found.found();
    if (!found.found()) none += (none.empty() ? "" : "; ") + found.trouble;
    if (!found.found() && !found.remarks.empty())
      none += fmt::format(" ({})", fmt::join(found.remarks, "; "));
    image.quality.push_back(found.found() ? view_quality(file.grey, found.corners) : ViewQuality());
    if (found.found()) {
      for (const std::string& remark : quality_remarks(image.quality.back())) image.remarks.push_back(remark);
    }
    image.found.push_back(std::move(found));
  }
  if (!any) image.trouble = none;
  if (!options.debug_folder.empty())
    write_file(
        (std::filesystem::path(options.debug_folder) / (image.name.camera + "_" + image.name.frame + ".png"))
            .string(),
        overlay_png(file.grey, targets, image.found), options.overwrite);
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

// What most images of the camera say took them; nothing where none says.
std::string usual_device(const std::vector<Image>& images, const std::string& camera) {
  std::map<std::string, int> votes;
  for (const Image& image : images) {
    if (image.name.camera == camera && !image.device.empty()) ++votes[image.device];
  }
  std::string best;
  int most = 0;
  for (const auto& [device, count] : votes) {
    if (count > most) most = count, best = device;
  }
  return best;
}

// Images that do not belong with the others of their camera.
void name_strangers(std::vector<Image>& images) {
  std::map<std::string, std::string> path_of;  // by content
  std::map<std::string, std::string> device_of;
  for (Image& image : images) {
    if (!image.sha256.empty()) {
      const auto [first, fresh] = path_of.emplace(image.sha256, image.path);
      if (!fresh) image.trouble = fmt::format("is the same file as {}, byte for byte", first->second);
    }
    const auto [width, height] = usual_size(images, image.name.camera);
    if (image.width_px > 0 && std::pair(image.width_px, image.height_px) != std::pair(width, height))
      image.trouble = fmt::format("{}x{} pixels; most images of camera {} have {}x{}", image.width_px,
                                  image.height_px, image.name.camera, width, height);
    const auto [device, fresh] = device_of.emplace(image.name.camera, "");
    if (fresh) device->second = usual_device(images, image.name.camera);
    if (image.trouble.empty() && !image.device.empty() && image.device != device->second)
      image.trouble = fmt::format("taken by {}; most images of camera {} by {}", image.device,
                                  image.name.camera, device->second);
  }
}

// A board that looks the same after half a turn: the first view of a frame decides, the others follow the
// direction of its rows in the image (cameras are rolled by less than 90 degrees against each other).
void agree_on_half_turns(const std::vector<Target>& targets, Observations& observations) {
  std::map<std::pair<int, std::string>, Eigen::Vector2d> along_of_frame;
  for (BoardView& view : observations.views) {
    const Target& target = targets[static_cast<std::size_t>(view.target)];
    if (!target_kind(target.kind).half_turn_alike(target)) continue;
    const Eigen::Vector2d along =
        view.corners[static_cast<std::size_t>(target.columns - 1)].pixel - view.corners[0].pixel;
    const auto [first, fresh] = along_of_frame.emplace(std::pair(view.target, view.frame), along);
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

Observations find_corners(const std::vector<std::string>& paths, const std::vector<Target>& targets,
                          const FindOptions& options) {
  if (!options.debug_folder.empty()) std::filesystem::create_directories(options.debug_folder);
  std::vector<Image> images;
  for (const std::string& path : paths) images.push_back(name_image(path));
  Progress progress("finding corners", images.size());
  parallel_for(images.size(), [&](std::size_t i) {
    throw_if_interrupted();
    if (images[i].trouble.empty()) look(targets, options, images[i]);
    progress.add();
  });

  name_strangers(images);
  Observations out;
  std::map<std::string, int> index;
  std::map<std::pair<int, std::string>, std::string> taken;
  for (Image& image : images) {
    if (!image.trouble.empty()) {
      out.skipped.push_back({image.path, image.trouble});
      continue;
    }
    const auto [camera, fresh] = index.emplace(image.name.camera, static_cast<int>(out.cameras.size()));
    if (fresh) out.cameras.push_back({image.name.camera, image.width_px, image.height_px});
    const auto [twin, first] = taken.emplace(std::pair(camera->second, image.name.frame), image.path);
    if (!first)
      bad_input({image.path}, "a second image of frame {} of camera {}, beside {}", image.name.frame,
                image.name.camera, twin->second);
    for (const std::string& remark : image.remarks) out.remarks.push_back({image.path, remark});
    for (std::size_t t = 0; t < targets.size(); ++t) {
      for (const std::string& remark : image.found[t].remarks) out.remarks.push_back({image.path, remark});
      if (!image.found[t].found()) continue;
      out.views.push_back({image.path, camera->second, image.name.frame, std::move(image.found[t].corners),
                           static_cast<int>(t), image.quality[t].blur_px, image.quality[t].overexposed});
    }
  }
  agree_on_half_turns(targets, out);
  return out;
}

}  // namespace bpms
