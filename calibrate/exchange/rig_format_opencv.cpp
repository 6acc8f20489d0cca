// OpenCV's FileStorage (YAML, XML, JSON) with the keys of its sample programs. One camera: camera_matrix,
// distortion_coefficients, image_width, image_height, fisheye_model. A pair, in one file or in
// intrinsics.yml and extrinsics.yml: M1 D1 M2 D2, and R T of camera 2 from camera 1, R1 R2 P1 P2 Q of the
// rectified pair. T is in the unit of the board's squares, which the files do not say.
// Ours besides: bpms_names, bpms_image_sizes, bpms_models, bpms_covariance and its order, kind, sigma.
#include <algorithm>
#include <filesystem>
#include <opencv2/calib3d.hpp>
#include <opencv2/core.hpp>

#include "calibrate/exchange/camera_numbers.h"
#include "calibrate/exchange/rig_file.h"
#include "core/text.h"

namespace bpms {
namespace {

using OpencvStorage = cv::FileStorage;

// Which of several files has a key.
class OpencvFiles {
 public:
  explicit OpencvFiles(const std::vector<std::string>& paths) {
    for (const std::string& path : paths) {
      read_text(path);  // missing, empty or binary: said as for every other file
      try {
        storages_.emplace_back(path, OpencvStorage::READ);
      } catch (const cv::Exception& error) {
        bad_input({path, line_of(error)}, "OpenCV cannot read it: {}", in_quotes(error.err));
      }
      paths_.push_back(path);
      if (!storages_.back().isOpened()) bad_input({path}, "not a file that OpenCV opens");
    }
  }

  bool has(const char* key) const { return find(key) >= 0; }
  SourceLocation where(const char* key) const {
    const int at = find(key);
    return {paths_[static_cast<std::size_t>(std::max(0, at))]};
  }
  cv::FileNode node(const char* key) const {
    const int at = find(key);
    if (at < 0) bad_input({paths_.front()}, "has no {}", key);
    return storages_[static_cast<std::size_t>(at)][key];
  }
  Eigen::MatrixXd matrix(const char* key) const {
    cv::Mat read;
    try {
      node(key) >> read;
      if (read.dims != 2 || read.empty() || read.channels() != 1)
        bad_input(where(key), "{} is no matrix", key);
      read.convertTo(read, CV_64F);
    } catch (const cv::Exception& error) {
      bad_input(where(key), "{} is no matrix: {}", key, in_quotes(error.err));
    }
    Eigen::MatrixXd out(read.rows, read.cols);
    for (int i = 0; i < read.rows; ++i)
      for (int j = 0; j < read.cols; ++j) out(i, j) = read.at<double>(i, j);
    if (!out.allFinite()) bad_input(where(key), "{} holds numbers that are not finite", key);
    return out;
  }
  Eigen::MatrixXd matrix(const char* key, Eigen::Index rows, Eigen::Index columns) const {
    const Eigen::MatrixXd out = matrix(key);
    if (out.rows() != rows || out.cols() != columns)
      bad_input(where(key), "{} is {}x{}, expected {}x{}", key, out.rows(), out.cols(), rows, columns);
    return out;
  }
  double number(const char* key) const {
    const cv::FileNode at = node(key);
    if (!at.isInt() && !at.isReal()) bad_input(where(key), "{} is no number", key);
    return at.real();
  }
  std::vector<std::string> texts(const char* key) const {
    std::vector<std::string> out;
    for (const cv::FileNode& at : node(key)) {
      if (!at.isString()) bad_input(where(key), "{} is no list of texts", key);
      out.push_back(at.string());
    }
    return out;
  }

 private:
  int find(const char* key) const {
    for (std::size_t i = 0; i < storages_.size(); ++i)
      if (!storages_[i][key].empty()) return static_cast<int>(i);
    return -1;
  }
  // "intrinsics.yml(12): ..." in its message.
  static int line_of(const cv::Exception& error) {
    const std::size_t close = error.err.find("): "), open = error.err.rfind('(', close);
    if (close == std::string::npos || open == std::string::npos) return 0;
    return static_cast<int>(parse_integer(error.err.substr(open + 1, close - open - 1)).value_or(0));
  }
  std::vector<std::string> paths_;
  std::vector<OpencvStorage> storages_;
};

// 4 (k1 k2 p1 p2), 5, 8, or 12 and 14 with a thin prism and a tilt that are not there.
std::vector<double> opencv_distortion(const OpencvFiles& files, const char* key, bool fisheye) {
  const Eigen::MatrixXd d = files.matrix(key);
  std::vector<double> out(d.data(), d.data() + d.size());
  const auto none = [](double k) { return k == 0; };
  if (fisheye) {
    if (out.size() != 4)
      bad_input(files.where(key), "{} of a fisheye has {} numbers, expected 4", key, out.size());
    return out;
  }
  if (out.size() > 8 && std::all_of(out.begin() + 8, out.end(), none)) out.resize(8);
  if (out.size() > 8)
    bad_input(files.where(key), "{}: a thin prism or a tilted sensor has no counterpart in bpms", key);
  if (out.size() != 4 && out.size() != 5 && out.size() != 8)
    bad_input(files.where(key), "{} has {} numbers, expected 4, 5 or 8", key, out.size());
  return out;
}

Camera opencv_camera(const OpencvFiles& files, const char* matrix_key, const char* distortion_key,
                     bool fisheye) {
  const Eigen::Matrix3d k = files.matrix(matrix_key, 3, 3);
  if (k(0, 1) != 0 || k(1, 0) != 0 || k(2, 0) != 0 || k(2, 1) != 0 || k(2, 2) != 1)
    bad_input(files.where(matrix_key), "{} is not of the form [fx 0 cx; 0 fy cy; 0 0 1]", matrix_key);
  Camera out;
  out.model = fisheye ? "fisheye" : "brown_conrady";
  out.parameters = {k(0, 0), k(1, 1), k(0, 2), k(1, 2)};
  if (fisheye || files.has(distortion_key)) {
    const std::vector<double> d = opencv_distortion(files, distortion_key, fisheye);
    out.parameters.insert(out.parameters.end(), d.begin(), d.end());
  }
  require_sound_numbers(out, files.where(matrix_key));
  return out;
}

void read_opencv_size(const OpencvFiles& files, const RigReading& reading, std::size_t index,
                      Camera& camera) {
  std::pair<double, double> size;
  if (files.has("bpms_image_sizes")) {
    const Eigen::MatrixXd all = files.matrix("bpms_image_sizes");
    if (all.cols() != 2 || all.rows() <= static_cast<Eigen::Index>(index))
      bad_input(files.where("bpms_image_sizes"), "bpms_image_sizes has no row of camera {}", index + 1);
    size = {all(static_cast<Eigen::Index>(index), 0), all(static_cast<Eigen::Index>(index), 1)};
  } else if (files.has("image_width")) {
    size = {files.number("image_width"), files.number("image_height")};
  } else if (reading.size_px) {
    size = {reading.size_px->first, reading.size_px->second};
  } else {
    bad_input(files.where("image_width"),
              "has no image_width and image_height: give the size of the images (--image-size)");
  }
  const auto sound = [](double n) { return n >= 1 && n <= largest_camera_image_px; };
  if (!sound(size.first) || !sound(size.second))
    bad_input(files.where("image_width"), "an image of {}x{} pixels", size.first, size.second);
  camera.width_px = static_cast<int>(size.first);
  camera.height_px = static_cast<int>(size.second);
}

void read_opencv_covariance(const OpencvFiles& files, Rig& rig) {
  if (files.has("bpms_residual_sigma_px")) rig.residual_sigma_px = files.number("bpms_residual_sigma_px");
  if (!files.has("bpms_covariance")) return;
  Rig::Covariance out;
  out.order = files.texts("bpms_covariance_order");
  const auto n = static_cast<Eigen::Index>(out.order.size());
  out.matrix = files.matrix("bpms_covariance", n, n);
  if (files.has("bpms_covariance_kind")) out.kind = files.node("bpms_covariance_kind").string();
  rig.covariance = std::move(out);
}

RigFromFile read_opencv(const std::vector<std::string>& paths, const RigReading& reading) {
  const OpencvFiles files(paths);
  RigFromFile out;
  Rig& rig = out.rig;
  const bool pair = files.has("M1");
  std::vector<std::string> names =
      pair ? std::vector<std::string>{"left", "right"} : std::vector<std::string>{"camera"};
  if (files.has("bpms_names")) names = files.texts("bpms_names");
  if (names.size() != (pair ? 2u : 1u))
    bad_input(files.where("bpms_names"), "bpms_names does not suit the cameras");
  std::vector<bool> fisheye(names.size(), files.has("fisheye_model") && files.number("fisheye_model") != 0);
  if (files.has("bpms_models")) {
    const std::vector<std::string> models = files.texts("bpms_models");
    for (std::size_t i = 0; i < names.size() && i < models.size(); ++i) fisheye[i] = models[i] == "fisheye";
  }
  if (pair) {
    rig.cameras = {opencv_camera(files, "M1", "D1", fisheye[0]),
                   opencv_camera(files, "M2", "D2", fisheye[1])};
    if (files.has("R")) {
      rig.cameras[1].r_cam_from_rig =
          sound_rotation(Eigen::Matrix3d(files.matrix("R", 3, 3)), files.where("R"));
      const Eigen::MatrixXd t = files.matrix("T");
      if (t.size() != 3) bad_input(files.where("T"), "T has {} numbers, expected 3", t.size());
      rig.cameras[1].t_cam_from_rig_m = reading.unit_m * Eigen::Map<const Eigen::Vector3d>(t.data());
      out.notes.push_back(fmt::format("T is taken as {} m a unit: the baseline is {:.6g} m", reading.unit_m,
                                      rig.cameras[1].t_cam_from_rig_m.norm()));
    } else {
      out.notes.emplace_back("no R and T (extrinsics.yml): both cameras are left at the same place");
    }
  } else {
    rig.cameras = {opencv_camera(files, "camera_matrix", "distortion_coefficients", fisheye[0])};
  }
  for (std::size_t i = 0; i < names.size(); ++i) {
    rig.cameras[i].name = names[i];
    read_opencv_size(files, reading, i, rig.cameras[i]);
  }
  read_opencv_covariance(files, rig);
  return out;
}

cv::Mat opencv_matrix(const Eigen::MatrixXd& m) {
  cv::Mat out(static_cast<int>(m.rows()), static_cast<int>(m.cols()), CV_64F);
  for (int i = 0; i < out.rows; ++i)
    for (int j = 0; j < out.cols; ++j) out.at<double>(i, j) = m(i, j);
  return out;
}

struct OpencvLens {
  cv::Mat matrix, distortion;
};
OpencvLens opencv_lens(const Camera& camera) {
  if (camera.model != "brown_conrady" && camera.model != "fisheye")
    bad_input({}, "camera {}: OpenCV has no counterpart of the lens model {}", in_quotes(camera.name),
              camera.model);
  const std::vector<double>& p = camera.parameters;
  OpencvLens out;
  out.matrix = (cv::Mat_<double>(3, 3) << p[0], 0, p[2], 0, p[1], p[3], 0, 0, 1);
  const std::size_t count = std::max<std::size_t>(4, p.size() - 4);  // a pinhole has four zeros
  out.distortion = cv::Mat::zeros(static_cast<int>(count), 1, CV_64F);
  for (std::size_t i = 4; i < p.size(); ++i) out.distortion.at<double>(static_cast<int>(i) - 4) = p[i];
  return out;
}

// As OpenCV's stereo sample rectifies: the whole image kept, zero disparity at infinity.
void write_rectified(OpencvStorage& out, const Rig& rig, const OpencvLens& a, const OpencvLens& b,
                     const cv::Mat& r, const cv::Mat& t) {
  const Camera& first = rig.cameras[0];
  const cv::Size size(first.width_px, first.height_px);
  cv::Mat r1, r2, p1, p2, q;
  if (first.model == "fisheye")
    cv::fisheye::stereoRectify(a.matrix, a.distortion, b.matrix, b.distortion, size, r, t, r1, r2, p1, p2, q,
                               cv::CALIB_ZERO_DISPARITY);
  else
    cv::stereoRectify(a.matrix, a.distortion, b.matrix, b.distortion, size, r, t, r1, r2, p1, p2, q,
                      cv::CALIB_ZERO_DISPARITY, 1);
  out << "R1" << r1 << "R2" << r2 << "P1" << p1 << "P2" << p2 << "Q" << q;
}

void write_texts(OpencvStorage& out, const char* key, const std::vector<std::string>& texts) {
  out << key << "[";
  for (const std::string& text : texts) out << text;
  out << "]";
}

void write_opencv_lenses(OpencvStorage& out, const Rig& rig) {
  const Camera& first = rig.cameras[0];
  const OpencvLens a = opencv_lens(first);
  out << "image_width" << first.width_px << "image_height" << first.height_px;
  out << "fisheye_model" << (first.model == "fisheye" ? 1 : 0);
  if (rig.cameras.size() == 1) {
    out << "camera_matrix" << a.matrix << "distortion_coefficients" << a.distortion;
  } else {
    const OpencvLens b = opencv_lens(rig.cameras[1]);
    out << "M1" << a.matrix << "D1" << a.distortion << "M2" << b.matrix << "D2" << b.distortion;
  }
  std::vector<std::string> names, models;
  cv::Mat sizes(static_cast<int>(rig.cameras.size()), 2, CV_32S);
  for (std::size_t i = 0; i < rig.cameras.size(); ++i) {
    names.push_back(rig.cameras[i].name);
    models.push_back(rig.cameras[i].model);
    sizes.at<int>(static_cast<int>(i), 0) = rig.cameras[i].width_px;
    sizes.at<int>(static_cast<int>(i), 1) = rig.cameras[i].height_px;
  }
  write_texts(out, "bpms_names", names);
  write_texts(out, "bpms_models", models);
  out << "bpms_image_sizes" << sizes;
}

void write_opencv_pose(OpencvStorage& out, const Rig& rig, std::vector<std::string>& notes) {
  const Camera &a = rig.cameras[0], &b = rig.cameras[1];
  const Eigen::Matrix3d r = b.r_cam_from_rig * a.r_cam_from_rig.transpose();
  const Eigen::Vector3d t = b.t_cam_from_rig_m - r * a.t_cam_from_rig_m;
  const cv::Mat r_cv = opencv_matrix(r), t_cv = opencv_matrix(t);
  out << "R" << r_cv << "T" << t_cv;
  if (a.model == b.model && a.width_px == b.width_px && a.height_px == b.height_px && t.norm() > 0)
    write_rectified(out, rig, opencv_lens(a), opencv_lens(b), r_cv, t_cv);
  else
    notes.emplace_back("no rectified pair (R1 R2 P1 P2 Q): the cameras differ in lens model or size");
}

void write_opencv_covariance(OpencvStorage& out, const Rig& rig, std::vector<std::string>& notes) {
  if (rig.residual_sigma_px > 0) out << "bpms_residual_sigma_px" << rig.residual_sigma_px;
  if (!rig.covariance) return;
  const Camera& first = rig.cameras.front();
  if (!first.r_cam_from_rig.isIdentity(0) || !first.t_cam_from_rig_m.isZero(0)) {
    notes.emplace_back(
        "the covariance is left out: it is of poses in a frame that is not the first camera's");
    return;
  }
  write_texts(out, "bpms_covariance_order", rig.covariance->order);
  out << "bpms_covariance" << opencv_matrix(rig.covariance->matrix) << "bpms_covariance_kind"
      << rig.covariance->kind;
}

FilesOfRig write_opencv(const Rig& rig, const std::string& path) {
  if (rig.cameras.size() > 2)
    bad_input({path}, "OpenCV's files hold one camera or a pair, the rig has {}: choose with --cameras",
              rig.cameras.size());
  const bool folder = path.ends_with('/'), pair = rig.cameras.size() == 2;
  const std::string first = folder ? path + (pair ? "intrinsics.yml" : rig.cameras[0].name + ".yml") : path;
  const int flags = OpencvStorage::WRITE | OpencvStorage::MEMORY;
  FilesOfRig out;
  try {
    OpencvStorage lenses(first, flags);
    write_opencv_lenses(lenses, rig);
    if (pair && !folder) write_opencv_pose(lenses, rig, out.notes);
    write_opencv_covariance(lenses, rig, out.notes);
    out.files.push_back({first, lenses.releaseAndGetString()});
    if (pair && folder) {
      OpencvStorage poses(path + "extrinsics.yml", flags);
      write_opencv_pose(poses, rig, out.notes);
      out.files.push_back({path + "extrinsics.yml", poses.releaseAndGetString()});
    }
  } catch (const cv::Exception& error) {
    bad_input({path}, "OpenCV cannot write it: {}", in_quotes(error.err));
  }
  return out;
}

}  // namespace

const RigFormat& opencv_rig_format() {
  static const RigFormat format{
      "opencv",
      "FileStorage of OpenCV's sample programs: .yml, .xml; a folder for intrinsics.yml and extrinsics.yml",
      [](const std::string& path, std::string_view head) {
        const bool has_keys =
            head.find("camera_matrix") != std::string_view::npos || head.find("M1") != std::string_view::npos;
        return head.starts_with("%YAML:1.0") || head.find("<opencv_storage>") != std::string_view::npos ||
               (path.ends_with(".json") && has_keys);
      },
      read_opencv, write_opencv};
  return format;
}

}  // namespace bpms
