// A control frame: AprilTags (36h11) fixed in space, surveyed points without tags, and lengths measured
// between any of them. The points are the four corners of each tag in the order of the file (upper left,
// upper right, lower right, lower left of its black border), then the surveyed points.
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <map>

#include "calibrate/targets/tag_detector.h"
#include "calibrate/targets/target_kind.h"
#include "core/text.h"

namespace bpms {
namespace {

constexpr double farthest_m = 1e5;
// The standard deviation of what has none beside surveyed points: a covariance must have an inverse.
constexpr double as_exact_m = 1e-6;
constexpr std::size_t most_parts = 100'000;

Eigen::Vector3d position(const TomlValue& table) {
  const TomlValue value = table.require("position_m");
  const std::vector<double> x = value.numbers(3);
  const Eigen::Vector3d out(x[0], x[1], x[2]);
  if (out.cwiseAbs().maxCoeff() > farthest_m) value.reject("expected a position within 100 km");
  return out;
}

// sigma_m = 0.0002, sigma_m = [x, y, z], covariance_m2 = nine numbers; nothing: exact.
Eigen::Matrix3d covariance(const TomlValue& table) {
  const TomlValue sigma = table.get("sigma_m"), full = table.get("covariance_m2");
  if (sigma && full) full.reject("stands beside sigma_m; expected one of them");
  Eigen::Matrix3d out = Eigen::Matrix3d::Zero();
  if (sigma) {
    std::vector<double> s(3, 0);
    if (sigma.is_array())
      s = sigma.numbers(3);
    else
      s.assign(3, sigma.number());
    for (int k = 0; k < 3; ++k) {
      const double each = s[static_cast<std::size_t>(k)];
      if (!(each > 0) || each > farthest_m) sigma.reject("expected standard deviations above 0, in metres");
      out(k, k) = each * each;
    }
  }
  if (full) {
    const std::vector<double> c = full.numbers(9);
    out = Eigen::Map<const Eigen::Matrix3d>(c.data());
    if (!out.isApprox(out.transpose(), 1e-9)) full.reject("is not symmetric");
    if (!(Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(out).eigenvalues().minCoeff() > 0))
      full.reject("is not positive definite");
  }
  return out;
}

Eigen::Matrix3d rotation(const TomlValue& table) {
  const TomlValue value = table.get("quaternion_wxyz");
  if (!value) return Eigen::Matrix3d::Identity();
  const std::vector<double> q = value.numbers(4);
  const Eigen::Quaterniond out(q[0], q[1], q[2], q[3]);
  constexpr double typed = 1e-3;  // as many digits as people type
  if (std::abs(out.norm() - 1) > typed)
    value.reject(fmt::format("has length {:.6g}, expected a quaternion w x y z of length 1", out.norm()));
  return out.normalized().toRotationMatrix();
}

std::vector<double> row_major(const Eigen::Matrix3d& m) {
  std::vector<double> out;
  for (int i = 0; i < 9; ++i) out.push_back(m(i / 3, i % 3));
  return out;
}

std::string numbers_toml(const std::vector<double>& numbers) {
  std::string out = "[";
  for (std::size_t i = 0; i < numbers.size(); ++i) out += (i ? ", " : "") + toml_number(numbers[i]);
  return out + "]";
}

class ControlFrameKind final : public TargetKind {
 public:
  std::string_view name() const override { return "control_frame"; }
  bool flat() const override { return false; }

  void read(const TomlValue& root, Target& target) const override {
    std::vector<Eigen::Matrix3d> covariances;
    read_tags(root.get("tags"), target, covariances);
    read_points(root.get("points"), target, covariances);
    if (target.tags.empty() && target.control_points.empty())
      root.reject_choice("has neither [[tags]] nor [[points]]");
    const auto surveyed = [](const Eigen::Matrix3d& c) { return !c.isZero(0); };
    if (std::any_of(covariances.begin(), covariances.end(), surveyed)) {
      for (Eigen::Matrix3d& c : covariances)
        if (c.isZero(0)) c = std::pow(as_exact_m, 2) * Eigen::Matrix3d::Identity();
      target.covariance_m2 = covariances;
    }
    read_bars(root.get("scale_bars"), target);
  }

  std::string toml(const Target& target) const override {
    std::string out;
    for (std::size_t i = 0; i < target.tags.size(); ++i) {
      const TargetTag& tag = target.tags[i];
      const Eigen::Quaterniond q(tag.r_target_from_tag);
      out += fmt::format("[[tags]]\nid = {}\nsize_m = {}\nposition_m = {}\nquaternion_wxyz = {}\n", tag.id,
                         toml_number(tag.size_m),
                         numbers_toml({tag.centre_m.x(), tag.centre_m.y(), tag.centre_m.z()}),
                         numbers_toml({q.w(), q.x(), q.y(), q.z()}));
      out += covariance_toml(target, 4 * i);
    }
    for (std::size_t i = 0; i < target.control_points.size(); ++i) {
      const auto& [point, x] = target.control_points[i];
      out += fmt::format("[[points]]\nname = {}\nposition_m = {}\n", toml_string(point),
                         numbers_toml({x.x(), x.y(), x.z()}));
      out += covariance_toml(target, 4 * target.tags.size() + i);
    }
    for (const ScaleBar& bar : target.scale_bars)
      out += fmt::format("[[scale_bars]]\nfrom = {}\nto = {}\nlength_m = {}\nsigma_m = {}\n",
                         toml_string(point_name(target, bar.a)), toml_string(point_name(target, bar.b)),
                         toml_number(bar.length_m), toml_number(bar.sigma_m));
    return out;
  }

  std::vector<Eigen::Vector3d> designed_points_m(const Target& target) const override {
    std::vector<Eigen::Vector3d> out;
    for (const TargetTag& tag : target.tags) {
      for (const Eigen::Vector3d& corner : unit_tag_corners())
        out.push_back(tag.centre_m + tag.r_target_from_tag * (tag.size_m * corner));
    }
    for (const ControlPoint& point : target.control_points) out.push_back(point.position_m);
    return out;
  }
  std::string point_name(const Target& target, int point) const override {
    const auto tag = static_cast<std::size_t>(point / 4);
    if (tag < target.tags.size()) return fmt::format("{}.{}", target.tags[tag].id, point % 4);
    return target.control_points.at(static_cast<std::size_t>(point) - 4 * target.tags.size()).name;
  }
  std::vector<std::string> looks(const Target& target) const override {
    std::vector<std::string> out;
    for (const TargetTag& tag : target.tags) out.push_back(fmt::format("tag {} of 36h11", tag.id));
    return out;
  }

  Detection detect(const cv::Mat& grey, const Target& target) const override {
    Detection out;
    if (target.tags.empty()) {
      out.trouble = "the control frame has no tags; its points are digitised";
      return out;
    }
    std::map<int, int> index;
    std::set<int> wanted;
    for (const TargetTag& tag : target.tags) {
      index.emplace(tag.id, static_cast<int>(index.size()));
      wanted.insert(tag.id);
    }
    const SeenTags seen = find_tags(grey, wanted);
    out.remarks = seen.remarks;
    for (const SeenTag& tag : seen.tags) {
      for (int i = 0; i < 4; ++i)
        out.corners.push_back({4 * index.at(tag.id) + i, tag.corners[static_cast<std::size_t>(i)]});
    }
    if (!out.found()) out.trouble = "none of the control frame's tags found";
    return out;
  }

 private:
  static void read_tags(const TomlValue& tags, Target& target, std::vector<Eigen::Matrix3d>& covariances) {
    if (!tags) return;
    if (tags.size() > tag_codes) tags.reject("has more tags than the family has ids");
    std::set<int> ids;
    for (std::size_t i = 0; i < tags.size(); ++i) {
      const TomlValue table = tags[i];
      const TomlValue id = table.require("id");
      TargetTag tag;
      tag.id = static_cast<int>(id.integer(0, tag_codes - 1));
      if (!ids.insert(tag.id).second) id.reject(fmt::format("tag {} is there twice", tag.id));
      const TomlValue size = table.require("size_m");
      tag.size_m = size.positive();
      if (tag.size_m > farthest_m) size.reject("expected a tag below 100 km");
      tag.centre_m = position(table);
      tag.r_target_from_tag = rotation(table);
      target.tags.push_back(tag);
      covariances.insert(covariances.end(), 4, covariance(table));
    }
  }

  static void read_points(const TomlValue& points, Target& target,
                          std::vector<Eigen::Matrix3d>& covariances) {
    if (!points) return;
    if (points.size() > most_parts) points.reject("has more than 100000 points");
    std::set<std::string> names;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const TomlValue name = points[i].require("name");
      ControlPoint point{name.string(), position(points[i])};
      if (point.name.empty()) name.reject("expected a name");
      if (!names.insert(point.name).second) name.reject(in_quotes(point.name) + " is there twice");
      target.control_points.push_back(point);
      covariances.push_back(covariance(points[i]));
    }
  }

  void read_bars(const TomlValue& bars, Target& target) const {
    if (!bars) return;
    if (bars.size() > most_parts) bars.reject("has more than 100000 scale bars");
    std::map<std::string, int> index;
    const int points = target.size();
    for (int i = 0; i < points; ++i) index.emplace(point_name(target, i), i);
    const auto end = [&](const TomlValue& value) {
      const auto found = index.find(value.string());
      if (found == index.end())
        value.reject("is no point of the frame, expected the name of a point or ID.CORNER as in \"3.0\"");
      return found->second;
    };
    const std::vector<Eigen::Vector3d> x = target.points_m();
    for (std::size_t i = 0; i < bars.size(); ++i) {
      ScaleBar bar;
      bar.a = end(bars[i].require("from"));
      bar.b = end(bars[i].require("to"));
      if (bar.a == bar.b) bars[i].reject("goes from a point to itself");
      const TomlValue length = bars[i].require("length_m");
      bar.length_m = length.positive();
      bar.sigma_m = bars[i].require("sigma_m").positive();
      const double surveyed =
          (x[static_cast<std::size_t>(bar.a)] - x[static_cast<std::size_t>(bar.b)]).norm();
      constexpr double alike = 2;  // another unit or another pair of points differs by more
      if (!(bar.length_m < alike * surveyed && surveyed < alike * bar.length_m))
        length.reject(fmt::format("differs from the {:.6g} m between the positions of its ends", surveyed));
      target.scale_bars.push_back(bar);
    }
  }

  static std::string covariance_toml(const Target& target, std::size_t point) {
    if (target.covariance_m2.empty()) return {};
    return fmt::format("covariance_m2 = {}\n", numbers_toml(row_major(target.covariance_m2[point])));
  }
};

}  // namespace

const TargetKind& control_frame_kind() {
  static const ControlFrameKind kind;
  return kind;
}

}  // namespace bpms
