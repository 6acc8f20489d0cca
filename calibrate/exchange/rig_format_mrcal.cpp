// mrcal's .cameramodel, a camera a file: a Python dictionary with 'lensmodel', 'intrinsics' (fx fy cx cy and
// what the model has), 'extrinsics' (rotation vector and translation of the camera from the reference),
// 'imagersize'. LENSMODEL_OPENCV4, 5 and 8 have OpenCV's order, which is ours. The optimisation that a file
// may carry is passed over. mrcal's unit of length is that of the user's boards, by default metres.
#include <algorithm>
#include <cmath>
#include <filesystem>

#include "calibrate/exchange/camera_numbers.h"
#include "calibrate/exchange/python_literal.h"
#include "calibrate/exchange/rig_file.h"
#include "calibrate/lenses/lens.h"
#include "core/text.h"
#include "core/units.h"

namespace bpms {
namespace {

constexpr std::string_view splined_prefix = "LENSMODEL_SPLINED_STEREOGRAPHIC_";
constexpr std::string_view splined_model = "splined_stereographic";

const PythonLiteral& required(const PythonLiteral& file, const char* key) {
  const PythonLiteral* found = file.find(key);
  if (found == nullptr) bad_input(file.where, "no '{}' in the camera model", key);
  return *found;
}

// "order=3_Nx=30_Ny=18_fov_x_deg=150" -> [3, 30, 18, 150].
std::vector<double> spline_constants(std::string_view text, const SourceLocation& where) {
  std::vector<double> out;
  for (const std::string_view key : {"order=", "Nx=", "Ny=", "fov_x_deg="}) {
    const std::size_t at = text.find(key);
    const std::size_t begin = at + key.size(), end = std::min(text.find('_', begin), text.size());
    const auto number =
        at == std::string_view::npos ? std::nullopt : parse_number(text.substr(begin, end - begin));
    if (!number)
      bad_input(where, "found {}, expected a spline of the form order=3_Nx=30_Ny=18_fov_x_deg=150",
                in_quotes(text));
    out.push_back(*number);
  }
  return out;
}

void read_mrcal_lens(const PythonLiteral& model, const PythonLiteral& intrinsics, Camera& camera) {
  if (model.kind != PythonLiteral::Kind::text) bad_input(model.where, "'lensmodel': expected a text");
  camera.parameters = intrinsics.numbers("'intrinsics'");
  std::size_t expected = 0;
  if (model.text == "LENSMODEL_PINHOLE") {
    expected = 4;
  } else if (model.text == "LENSMODEL_OPENCV4") {
    expected = 8;
  } else if (model.text == "LENSMODEL_OPENCV5") {
    expected = 9;
  } else if (model.text == "LENSMODEL_OPENCV8") {
    expected = 12;
  } else if (model.text.starts_with(splined_prefix)) {
    camera.model = splined_model;
    camera.constants =
        spline_constants(std::string_view(model.text).substr(splined_prefix.size()), model.where);
  } else {
    bad_input(model.where,
              "no lens model {}; expected LENSMODEL_PINHOLE, _OPENCV4, _OPENCV5, _OPENCV8 or "
              "_SPLINED_STEREOGRAPHIC",
              in_quotes(model.text));
  }
  if (expected > 0 && camera.parameters.size() != expected)
    bad_input(intrinsics.where, "{} numbers of a {}, expected {}", camera.parameters.size(), model.text,
              expected);
  require_sound_numbers(camera, intrinsics.where);
}

RigFromFile read_mrcal(const std::vector<std::string>& paths, const RigReading& reading) {
  RigFromFile out;
  for (const std::string& path : paths) {
    Camera camera = parse_cameramodel(path, read_text(path));
    camera.t_cam_from_rig_m *= reading.unit_m;
    if (out.rig.find(camera.name) >= 0) camera.name = path;
    if (out.rig.find(camera.name) >= 0) bad_input({path}, "is given twice");
    out.rig.cameras.push_back(std::move(camera));
  }
  return out;
}

std::string mrcal_model(const Camera& camera) {
  if (camera.model == splined_model && camera.constants.size() == 4) {
    const std::vector<double>& c = camera.constants;
    for (const double number : c) {
      if (number != std::round(number))
        bad_input({}, "camera {}: mrcal's splines span whole degrees, this one {}", in_quotes(camera.name),
                  number);
    }
    return fmt::format("{}order={}_Nx={}_Ny={}_fov_x_deg={}", splined_prefix, c[0], c[1], c[2], c[3]);
  }
  if (camera.model == "brown_conrady") {
    switch (camera.parameters.size()) {
      case 4:
        return "LENSMODEL_PINHOLE";
      case 8:
        return "LENSMODEL_OPENCV4";
      case 9:
        return "LENSMODEL_OPENCV5";
      default:
        return "LENSMODEL_OPENCV8";
    }
  }
  bad_input({}, "camera {}: mrcal has no counterpart of the lens model {}", in_quotes(camera.name),
            camera.model);
}

std::string mrcal_list(const std::vector<double>& numbers) {
  std::string out = "[";
  for (const double number : numbers) out += fmt::format(" {},", number);
  return out + "]";
}

std::string cameramodel_text(const Camera& camera) {
  const Eigen::Vector3d turn = vector_from_rotation(camera.r_cam_from_rig), &t = camera.t_cam_from_rig_m;
  return fmt::format(
      "{{\n    'lensmodel':  '{}',\n\n    'intrinsics': {},\n\n    'extrinsics': {},\n\n"
      "    'imagersize': [ {}, {},],\n}}\n",
      mrcal_model(camera), mrcal_list(camera.parameters),
      mrcal_list({turn.x(), turn.y(), turn.z(), t.x(), t.y(), t.z()}), camera.width_px, camera.height_px);
}

FilesOfRig write_mrcal(const Rig& rig, const std::string& path) {
  if (rig.cameras.size() > 1 && !path.ends_with('/'))
    bad_input({path}, "a .cameramodel holds one camera, the rig has {}: name a folder, {}/ (with --to mrcal)",
              rig.cameras.size(), std::filesystem::path(path).stem().string());
  FilesOfRig out;
  for (const Camera& camera : rig.cameras) {
    if (camera.name.find('/') != std::string::npos)
      bad_input({path}, "the camera's name {} cannot be the name of a file", in_quotes(camera.name));
    out.files.push_back(
        {path.ends_with('/') ? path + camera.name + ".cameramodel" : path, cameramodel_text(camera)});
  }
  if (rig.covariance)
    out.notes.emplace_back("mrcal's files have no covariance but the optimisation itself: it is left out");
  return out;
}

}  // namespace

Camera parse_cameramodel(const std::string& path, const std::string& text) {
  const PythonLiteral file = parse_python_literal(path, text);
  if (file.kind != PythonLiteral::Kind::dictionary) bad_input(file.where, "expected a dictionary {{ ... }}");
  Camera camera;
  camera.name = std::filesystem::path(path).stem().string();
  read_mrcal_lens(required(file, "lensmodel"), required(file, "intrinsics"), camera);
  const PythonLiteral& size = required(file, "imagersize");
  const std::vector<double> pixels = size.numbers("'imagersize'");
  if (pixels.size() != 2) bad_input(size.where, "'imagersize': expected [width, height]");
  for (const double n : pixels)
    if (n != std::round(n) || n < 1 || n > largest_camera_image_px)
      bad_input(size.where, "'imagersize': an image of {}x{} pixels", pixels[0], pixels[1]);
  camera.width_px = static_cast<int>(pixels[0]);
  camera.height_px = static_cast<int>(pixels[1]);
  const PythonLiteral& pose = required(file, "extrinsics");
  const std::vector<double> rt = pose.numbers("'extrinsics'");
  if (rt.size() != 6)
    bad_input(pose.where, "'extrinsics': {} numbers, expected a rotation vector and a translation",
              rt.size());
  const Eigen::Vector3d turn(rt[0], rt[1], rt[2]);
  constexpr double turns = 1e3;
  if (!(turn.norm() < turns)) bad_input(pose.where, "'extrinsics': a rotation by {:.3g} rad", turn.norm());
  camera.r_cam_from_rig = rotation_from_vector(turn);
  camera.t_cam_from_rig_m = {rt[3], rt[4], rt[5]};
  return camera;
}

const RigFormat& mrcal_rig_format() {
  static const RigFormat format{"mrcal", "mrcal's .cameramodel, a file for each camera",
                                [](const std::string& path, std::string_view head) {
                                  return path.ends_with(".cameramodel") ||
                                         head.find("'lensmodel'") != std::string_view::npos;
                                },
                                read_mrcal, write_mrcal};
  return format;
}

}  // namespace bpms
