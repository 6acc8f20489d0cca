// Kalibr's camchain.yaml: tables cam0, cam1, ... with camera_model pinhole, intrinsics [fu fv pu pv],
// distortion_model radtan (k1 k2 p1 p2), equidistant (k1 k2 k3 k4: our fisheye) or none, resolution,
// rostopic, and T_cn_cnm1, the pose of camera n from camera n-1, in metres. Pixel centres are OpenCV's.
#include <algorithm>
#include <set>

#include "calibrate/exchange/camera_numbers.h"
#include "calibrate/exchange/rig_file.h"
#include "calibrate/yaml.h"
#include "core/text.h"

namespace bpms {
namespace {

Pose kalibr_pose(const YamlValue& matrix) {
  if (!matrix.is_list() || matrix.size() != 4) matrix.reject("expected the 4 rows of a 4x4 matrix");
  Pose out;
  for (std::size_t row = 0; row < 4; ++row) {
    const std::vector<double> numbers = matrix[row].numbers(4);
    if (row == 3) {
      if (numbers != std::vector<double>{0, 0, 0, 1}) matrix[row].reject("expected [0, 0, 0, 1]");
      break;
    }
    const auto r = static_cast<Eigen::Index>(row);
    out.r.row(r) << numbers[0], numbers[1], numbers[2];
    out.t_m[r] = numbers[3];
  }
  out.r = sound_rotation(out.r, matrix.where());
  return out;
}

// "/left/image_raw" -> "left"; else the table's own name.
std::string kalibr_camera_name(const std::string& topic, const std::string& table) {
  constexpr std::string_view end = "/image_raw";
  if (!topic.starts_with('/') || !topic.ends_with(end) || topic.size() <= end.size() + 1) return table;
  const std::string name = topic.substr(1, topic.size() - 1 - end.size());
  return name.find('/') == std::string::npos ? name : table;
}

Camera kalibr_camera(const YamlValue& table, const std::string& name) {
  Camera camera;
  const YamlValue model = table.require("camera_model");
  if (model.string() != "pinhole")
    model.reject(
        fmt::format("found {}; only pinhole cameras (with radtan, equidistant or no distortion) are read",
                    in_quotes(model.string())));
  const YamlValue intrinsics = table.require("intrinsics");
  camera.parameters = intrinsics.numbers(4);
  const YamlValue distortion = table.require("distortion_model");
  const std::string kind = distortion.string();
  if (kind == "equidistant")
    camera.model = "fisheye";
  else if (kind != "radtan" && kind != "none")
    distortion.reject(fmt::format("found {}, expected radtan, equidistant or none", in_quotes(kind)));
  if (kind != "none") {
    const std::vector<double> k = table.require("distortion_coeffs").numbers(4);
    camera.parameters.insert(camera.parameters.end(), k.begin(), k.end());
  }
  require_sound_numbers(camera, intrinsics.where());
  const YamlValue size = table.require("resolution");
  if (!size.is_list() || size.size() != 2) size.reject("expected [width, height]");
  camera.width_px = static_cast<int>(size[0].integer(1, largest_camera_image_px));
  camera.height_px = static_cast<int>(size[1].integer(1, largest_camera_image_px));
  camera.name = name;
  if (const YamlValue topic = table.get("rostopic")) {
    camera.name = kalibr_camera_name(topic.string(), name);
    camera.identity["rostopic"] = topic.string();
  }
  return camera;
}

RigFromFile read_kalibr(const std::vector<std::string>& paths, const RigReading&) {
  if (paths.size() > 1) bad_input({paths[1]}, "one camchain.yaml is one rig; a second one is given");
  return {parse_camchain(paths[0], read_text(paths[0])), {}};
}

struct KalibrLens {
  std::string_view distortion;
  std::vector<double> coefficients;
};
KalibrLens kalibr_lens(const Camera& camera) {
  std::vector<double> k(camera.parameters.begin() + 4, camera.parameters.end());
  if (camera.model == "fisheye") return {"equidistant", k};
  if (camera.model != "brown_conrady")
    bad_input({}, "camera {}: Kalibr has no counterpart of the lens model {}", in_quotes(camera.name),
              camera.model);
  for (std::size_t i = 4; i < k.size(); ++i)
    if (k[i] != 0)
      bad_input(
          {}, "camera {}: Kalibr's radtan has k1 k2 p1 p2, the lens has {} more coefficients that are not 0",
          in_quotes(camera.name), k.size() - 4);
  if (k.empty()) return {"none", {}};
  k.resize(4);
  return {"radtan", k};
}

template <class Numbers>
std::string kalibr_list(const Numbers& numbers) {
  return fmt::format("[{}]", fmt::join(numbers, ", "));
}

FilesOfRig write_kalibr(const Rig& rig, const std::string& path) {
  FilesOfRig out;
  std::string text;
  const auto last = static_cast<int>(rig.cameras.size()) - 1;
  for (int i = 0; i <= last; ++i) {
    const Camera& camera = rig.cameras[static_cast<std::size_t>(i)];
    const KalibrLens lens = kalibr_lens(camera);
    std::vector<int> others;
    for (int j = 0; j <= last; ++j)
      if (j != i) others.push_back(j);
    text += fmt::format("cam{}:\n", i);
    if (i > 0) {
      const Camera& before = rig.cameras[static_cast<std::size_t>(i) - 1];
      const Pose pose = Pose{camera.r_cam_from_rig, camera.t_cam_from_rig_m} *
                        Pose{before.r_cam_from_rig, before.t_cam_from_rig_m}.inverse();
      text += "  T_cn_cnm1:\n";
      for (int r = 0; r < 3; ++r)
        text += fmt::format("  - [{}, {}, {}, {}]\n", pose.r(r, 0), pose.r(r, 1), pose.r(r, 2), pose.t_m[r]);
      text += "  - [0.0, 0.0, 0.0, 1.0]\n";
    }
    const auto topic = camera.identity.find("rostopic");
    text += "  cam_overlaps: " + kalibr_list(others) + "\n  camera_model: pinhole\n";
    text += fmt::format("  distortion_coeffs: {}\n  distortion_model: {}\n", kalibr_list(lens.coefficients),
                        lens.distortion);
    text += "  intrinsics: " +
            kalibr_list(std::vector<double>(camera.parameters.begin(), camera.parameters.begin() + 4)) + "\n";
    text += fmt::format("  resolution: [{}, {}]\n", camera.width_px, camera.height_px);
    text += "  rostopic: " +
            yaml_string(topic != camera.identity.end() ? topic->second : "/" + camera.name + "/image_raw") +
            "\n";
  }
  out.files.push_back({path.ends_with('/') ? path + "camchain.yaml" : path, text});
  if (rig.covariance) out.notes.emplace_back("Kalibr's files have no covariance: it is left out");
  return out;
}

}  // namespace

Rig parse_camchain(const std::string& path, const std::string& text) {
  const YamlValue root = YamlValue::parse(path, text);
  if (!root.is_table()) root.reject("expected tables cam0, cam1, ...");
  Rig rig;
  Pose pose;
  for (int i = 0;; ++i) {
    const std::string name = fmt::format("cam{}", i);
    const YamlValue table = root.get(name);
    if (!table) break;
    if (!table.is_table()) table.reject("expected a table");
    Camera camera = kalibr_camera(table, name);
    if (rig.find(camera.name) >= 0) camera.name = name;
    if (rig.find(camera.name) >= 0) table.reject("two cameras have one name");
    if (i > 0) pose = kalibr_pose(table.require("T_cn_cnm1")) * pose;
    camera.r_cam_from_rig = pose.r;
    camera.t_cam_from_rig_m = pose.t_m;
    if (!is_sound_vector(pose.t_m)) table.reject("the camera is too far away");
    rig.cameras.push_back(std::move(camera));
  }
  if (rig.cameras.empty()) root.reject("no table cam0");
  return rig;
}

const RigFormat& kalibr_rig_format() {
  static const RigFormat format{"kalibr", "camchain.yaml of Kalibr",
                                [](const std::string&, std::string_view head) {
                                  return head.starts_with("cam0:") ||
                                         head.find("\ncam0:") != std::string_view::npos;
                                },
                                read_kalibr, write_kalibr};
  return format;
}

}  // namespace bpms
