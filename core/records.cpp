#include "core/records.h"

#include <Eigen/Eigenvalues>
#include <array>
#include <set>
#include <tuple>

#include "core/csv.h"

namespace bpms {

std::string OrganLabel::str() const {
  return fmt::format("plant {} axis {} rank {} {} {}", plant, axis, rank, organ, feature);
}

namespace {

struct LabelColumns {
  explicit LabelColumns(const CsvTable& table)
      : plant(table.require("plant")),
        axis(table.require("axis")),
        rank(table.require("rank")),
        organ(table.require("organ")),
        feature(table.require("feature")),
        point(table.require("point")) {}
  OrganLabel label(const CsvTable& table, std::size_t row) const {
    constexpr long long highest_rank = 1'000'000;
    const long long number = table.integer(row, rank);
    if (number < 0 || number > highest_rank)
      bad_input(table.where(row, rank), "rank {} is out of range", number);
    OrganLabel out{std::string(table.text(row, plant)), std::string(table.text(row, axis)),
                   static_cast<int>(number), std::string(table.text(row, organ)),
                   std::string(table.text(row, feature))};
    if (out.organ.empty()) bad_input(table.where(row, organ), "the organ has no name");
    if (out.feature.empty()) bad_input(table.where(row, feature), "the feature has no name");
    return out;
  }
  int number(const CsvTable& table, std::size_t row) const {
    const long long value = table.integer(row, point);
    constexpr long long largest = 1'000'000'000;
    if (value < 0 || value > largest) bad_input(table.where(row, point), "point {} is out of range", value);
    return static_cast<int>(value);
  }
  int plant, axis, rank, organ, feature, point;
};

}  // namespace

std::vector<ImagePoint> read_image_points(const std::string& path) {
  const CsvTable table = CsvTable::read(path);
  const LabelColumns labels(table);
  const int view = table.require("view"), camera = table.require("camera");
  const int u = table.require("u_px"), v = table.require("v_px"), sigma = table.require("sigma_px");
  std::vector<ImagePoint> out;
  std::set<std::tuple<OrganLabel, int, std::string, std::string>> seen;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    ImagePoint point;
    point.label = labels.label(table, row);
    point.point = labels.number(table, row);
    point.view = table.text(row, view);
    point.camera = table.text(row, camera);
    point.u_px = table.number(row, u);
    point.v_px = table.number(row, v);
    point.sigma_px = table.number(row, sigma);
    point.where = table.where(row, labels.point);
    if (point.camera.empty()) bad_input(table.where(row, camera), "the camera has no name");
    constexpr double finest_px = 1e-9;  // finer ones leave nothing of a covariance in doubles
    if (point.sigma_px < finest_px)
      bad_input(table.where(row, sigma), "found {}, expected a sigma above 0 px", point.sigma_px);
    if (!seen.emplace(point.label, point.point, point.view, point.camera).second)
      bad_input(point.where, "{} point {} stands twice for view '{}', camera '{}'", point.label.str(),
                point.point, point.view, point.camera);
    out.push_back(std::move(point));
  }
  if (out.empty()) bad_input({path}, "no points after the header");
  return out;
}

std::vector<VectorPoint> read_vectors(const std::string& path) {
  const CsvTable table = CsvTable::read(path);
  const LabelColumns labels(table);
  const std::array<int, 3> x{table.require("x_m"), table.require("y_m"), table.require("z_m")};
  const bool with_covariance = table.has("xx");
  std::array<int, 6> c{};
  if (with_covariance) {
    c = {table.require("xx"), table.require("xy"), table.require("xz"),
         table.require("yy"), table.require("yz"), table.require("zz")};
  }
  std::vector<VectorPoint> out;
  std::set<std::pair<OrganLabel, int>> seen;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    VectorPoint point;
    point.label = labels.label(table, row);
    point.point = labels.number(table, row);
    point.where = table.where(row, labels.point);
    for (int k = 0; k < 3; ++k) point.x_m[k] = table.number(row, x[static_cast<std::size_t>(k)]);
    if (with_covariance) {
      int at = 0;
      for (int i = 0; i < 3; ++i) {
        for (int j = i; j < 3; ++j, ++at)
          point.covariance_m2(i, j) = point.covariance_m2(j, i) =
              table.number(row, c[static_cast<std::size_t>(at)]);
      }
      const double least = point.covariance_m2.selfadjointView<Eigen::Lower>().eigenvalues().minCoeff();
      if (least < -1e-9 * std::abs(point.covariance_m2.trace()) || point.covariance_m2.trace() < 0)
        bad_input(table.where(row, c[0]), "the covariance is not positive semi-definite");
    }
    if (!seen.emplace(point.label, point.point).second)
      bad_input(point.where, "{} point {} stands twice", point.label.str(), point.point);
    out.push_back(std::move(point));
  }
  if (out.empty()) bad_input({path}, "no vectors after the header");
  return out;
}

std::string vectors_csv(const std::vector<VectorPoint>& points) {
  std::string out = "plant,axis,rank,organ,feature,point,x_m,y_m,z_m,xx,xy,xz,yy,yz,zz\n";
  for (const VectorPoint& p : points) {
    const auto& c = p.covariance_m2;
    out += fmt::format("{},{},{},{},{},{}", csv_field(p.label.plant), csv_field(p.label.axis), p.label.rank,
                       csv_field(p.label.organ), csv_field(p.label.feature), p.point);
    for (const double value :
         {p.x_m[0], p.x_m[1], p.x_m[2], c(0, 0), c(0, 1), c(0, 2), c(1, 1), c(1, 2), c(2, 2)})
      out += "," + csv_number(value);
    out += "\n";
  }
  return out;
}

}  // namespace bpms
