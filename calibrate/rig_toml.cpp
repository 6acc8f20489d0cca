// rig.toml: reader with located errors, and the writer whose output it reads back exactly.
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <set>

#include "calibrate/lenses/lens.h"
#include "calibrate/rig.h"
#include "core/toml.h"

namespace bpms {
namespace {

constexpr long long largest_image_px = 1'000'000;

void read_pose(const TomlValue& value, Camera& camera) {
  if (!value.is_array() || value.size() != 3) value.reject("expected the 3 rows of a 3x4 matrix [R | t]");
  for (std::size_t row = 0; row < 3; ++row) {
    const std::vector<double> numbers = value[row].numbers(4);
    const auto r = static_cast<Eigen::Index>(row);
    camera.r_cam_from_rig.row(r) << numbers[0], numbers[1], numbers[2];
    camera.t_cam_from_rig_m[r] = numbers[3];
  }
  const Eigen::Matrix3d& r = camera.r_cam_from_rig;
  const double off = (r * r.transpose() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  constexpr double tolerance = 1e-6;
  if (!(off < tolerance))
    value.reject(
        fmt::format("the left 3x3 block is no rotation: its rows are off orthonormal by {:.3g}", off));
  if (r.determinant() < 0)
    value.reject("the left 3x3 block is a reflection (determinant -1), expected a rotation");
}

Camera read_camera(const TomlValue& table) {
  Camera camera;
  camera.name = table.require("name").string();
  if (camera.name.empty()) table.get("name").reject("expected a name");
  const TomlValue size = table.require("size_px");
  if (!size.is_array() || size.size() != 2) size.reject("expected [width, height]");
  camera.width_px = static_cast<int>(size[0].integer(1, largest_image_px));
  camera.height_px = static_cast<int>(size[1].integer(1, largest_image_px));
  camera.model = table.require("model").one_of(lens_models());
  const TomlValue parameters = table.require("parameters");
  camera.parameters = parameters.numbers();
  if (const TomlValue constants = table.get("constants")) camera.constants = constants.numbers();
  const Lens& lens = *find_lens(camera.model);
  if (lens.parameter_names({camera.parameters, camera.constants}).empty())
    parameters.reject(fmt::format(
        "{} parameters{}; expected {}", camera.parameters.size(),
        camera.constants.empty() ? "" : fmt::format(" with {} constants", camera.constants.size()),
        lens.expected_numbers()));
  parameters[0].positive();
  parameters[1].positive();
  read_pose(table.require("cam_from_rig"), camera);
  if (const TomlValue identity = table.get("identity")) {
    for (const std::string& key : identity.keys()) camera.identity[key] = identity.get(key).string();
  }
  return camera;
}

Rig::Covariance read_covariance(const TomlValue& table, const Rig& rig) {
  std::set<std::string> known, seen;
  for (const Camera& camera : rig.cameras) {
    for (const std::string& name : parameter_names(camera)) known.insert(camera.name + "." + name);
  }
  Rig::Covariance out;
  const TomlValue order = table.require("order");
  if (!order.is_array()) order.reject("expected an array of names like \"left.fx\"");
  for (std::size_t i = 0; i < order.size(); ++i) {
    const std::string name = order[i].string();
    if (!known.contains(name)) order[i].reject(in_quotes(name) + " is no parameter of a camera of this rig");
    if (!seen.insert(name).second) order[i].reject(in_quotes(name) + " is named twice");
    out.order.push_back(name);
  }
  const TomlValue matrix = table.require("matrix");
  const std::size_t n = out.order.size();
  if (!matrix.is_array() || matrix.size() != n)
    matrix.reject(fmt::format("expected {} rows, one for each name in order", n));
  out.matrix.resize(static_cast<Eigen::Index>(n), static_cast<Eigen::Index>(n));
  for (std::size_t i = 0; i < n; ++i) {
    const std::vector<double> row = matrix[i].numbers(n);
    for (std::size_t j = 0; j < n; ++j)
      out.matrix(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = row[j];
  }
  if (n > 0) {
    // Judged as correlations: variances of fx (px^2) and of p1 differ by ten orders of magnitude.
    const Eigen::VectorXd sigma = out.matrix.diagonal().cwiseMax(0).cwiseSqrt();
    const Eigen::VectorXd scale = (sigma.array() > 0).select(sigma.cwiseInverse(), 0.0);
    const Eigen::MatrixXd correlation = scale.asDiagonal() * out.matrix * scale.asDiagonal();
    constexpr double tolerance = 1e-9;
    if ((out.matrix.diagonal().array() < 0).any()) matrix.reject("a variance on the diagonal is negative");
    if (!((correlation - correlation.transpose()).cwiseAbs().maxCoeff() < tolerance))
      matrix.reject("not symmetric");
    const double least =
        Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(correlation, Eigen::EigenvaluesOnly).eigenvalues()[0];
    if (!(least > -tolerance * static_cast<double>(n)))
      matrix.reject(
          fmt::format("not positive semidefinite: least eigenvalue of the correlations {:.3g}", least));
  }
  if (const TomlValue frames = table.get("frames"))
    out.frames = static_cast<int>(frames.integer(1, 1'000'000));
  if (const TomlValue sigma = table.get("sigma_iid")) {
    const std::vector<double> values = sigma.numbers(n);
    for (std::size_t i = 0; i < n; ++i)
      if (values[i] < 0) sigma[i].reject("a sigma is negative");
    out.sigma_iid = Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(n));
  }
  if (table.has("kind")) out.kind = table.get("kind").one_of({"iid", "clustered"});
  return out;
}

std::string numbers(const Eigen::VectorXd& values) {
  std::string out = "[";
  for (Eigen::Index i = 0; i < values.size(); ++i) out += (i ? ", " : "") + toml_number(values[i]);
  return out + "]";
}

std::string toml_key(const std::string& key) {
  const bool bare = !key.empty() && std::all_of(key.begin(), key.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  });
  return bare ? key : toml_string(key);
}

std::string camera_toml(const Camera& camera) {
  std::string out = "\n[[cameras]]\n";
  out += "name = " + toml_string(camera.name) + "\n";
  out += fmt::format("size_px = [{}, {}]\n", camera.width_px, camera.height_px);
  out += "model = " + toml_string(camera.model) + "\n";
  out += "parameters = " +
         numbers(Eigen::Map<const Eigen::VectorXd>(camera.parameters.data(),
                                                   static_cast<Eigen::Index>(camera.parameters.size()))) +
         "\n";
  if (!camera.constants.empty())
    out += "constants = " +
           numbers(Eigen::Map<const Eigen::VectorXd>(camera.constants.data(),
                                                     static_cast<Eigen::Index>(camera.constants.size()))) +
           "\n";
  Eigen::Matrix<double, 3, 4> pose;
  pose << camera.r_cam_from_rig, camera.t_cam_from_rig_m;
  out += "cam_from_rig = [" + numbers(pose.row(0)) + ",\n                " + numbers(pose.row(1)) +
         ",\n                " + numbers(pose.row(2)) + "]\n";
  if (!camera.identity.empty()) {
    out += "identity = { ";
    bool first = true;
    for (const auto& [key, value] : camera.identity) {
      out += (first ? "" : ", ") + toml_key(key) + " = " + toml_string(value);
      first = false;
    }
    out += " }\n";
  }
  return out;
}

}  // namespace

Rig read_rig(const std::string& path) {
  const TomlDocument document = TomlDocument::read(path);
  const TomlValue root = document.root();
  root.require("units").one_of({"m"});
  root.require("pixel_centre").one_of({"integer"});
  Rig rig;
  const TomlValue cameras = root.require("cameras");
  if (!cameras.is_array() || cameras.size() == 0) cameras.reject("expected at least one [[cameras]] table");
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    const Camera camera = read_camera(cameras[i]);
    if (rig.find(camera.name) >= 0)
      cameras[i].get("name").reject("a second camera named " + in_quotes(camera.name));
    rig.cameras.push_back(camera);
  }
  if (const TomlValue covariance = root.get("covariance")) {
    rig.covariance = read_covariance(covariance, rig);
    if (covariance.has("residual_sigma_px"))
      rig.residual_sigma_px = covariance.get("residual_sigma_px").number(0, 1e6);
  }
  document.finish();
  return rig;
}

std::string rig_toml(const Rig& rig, const std::string& comment) {
  std::string out;
  for (std::size_t at = 0; at < comment.size();) {
    const std::size_t end = std::min(comment.find('\n', at), comment.size());
    out += "# " + comment.substr(at, end - at) + "\n";
    at = end + 1;
  }
  out += "units = \"m\"\npixel_centre = \"integer\"\n";
  for (const Camera& camera : rig.cameras) out += camera_toml(camera);
  if (rig.covariance) {
    const Rig::Covariance& c = *rig.covariance;
    out += "\n[covariance]\norder = [";
    for (std::size_t i = 0; i < c.order.size(); ++i) out += (i ? ", " : "") + toml_string(c.order[i]);
    out += "]\nmatrix = [";
    for (Eigen::Index i = 0; i < c.matrix.rows(); ++i)
      out += (i ? ",\n          " : "") + numbers(c.matrix.row(i));
    out += "]\nkind = " + toml_string(c.kind) + "\n";
    if (c.frames > 0) out += fmt::format("frames = {}\n", c.frames);
    if (c.sigma_iid.size() > 0) out += "sigma_iid = " + numbers(c.sigma_iid) + "\n";
    if (rig.residual_sigma_px > 0) out += "residual_sigma_px = " + toml_number(rig.residual_sigma_px) + "\n";
  }
  return out;
}

}  // namespace bpms
