#include "plant/structure/orientation.h"

#include <algorithm>
#include <cmath>

#include "core/units.h"
#include "plant/structure/mean_projection.h"

namespace bpms {
namespace {

constexpr std::size_t fine_bins = 1800, cell_rows = 90, cell_columns = 180;

std::size_t place_of(double fraction, std::size_t count) {
  // An angle that lies on an edge belongs to the upper bin, whatever its rounding.
  constexpr double hair = 1e-9;
  const double at = (fraction + hair) * static_cast<double>(count);
  return at <= 0 ? 0 : std::min(count - 1, static_cast<std::size_t>(at));
}

double inclination_of(const Eigen::Vector3d& v) {
  return std::atan2(v.head<2>().norm(), std::abs(v.z()));
}

}  // namespace

FacetOrientation::FacetOrientation()
    : cells_(cell_rows * cell_columns), weight_(fine_bins), weighted_angle_(fine_bins) {}

void FacetOrientation::add_inclination(double angle, double area) {
  const std::size_t bin = place_of(angle / (pi / 2), fine_bins);
  weight_[bin] += area;
  weighted_angle_[bin] += area * angle;
  area_ += area;
  angle_sum_ += area * angle;
  angle2_sum_ += area * angle * angle;
  cos2_sum_ += area * std::pow(std::cos(angle), 2);
}

void FacetOrientation::add_cell(const Eigen::Vector3d& up, const Cell& cell) {
  const std::size_t row = place_of(inclination_of(up) / (pi / 2), cell_rows);
  double turn = std::atan2(up.y(), up.x()) / (2 * pi);
  if (turn < 0) turn += 1;
  Cell& at = cells_[row * cell_columns + place_of(turn, cell_columns)];
  at.area += cell.area;
  at.vector += cell.vector;
}

void FacetOrientation::add(const Eigen::Vector3d& area_vector) {
  const double area = area_vector.norm();
  if (!(area > 0)) return;
  add_inclination(inclination_of(area_vector), area);
  const Eigen::Vector3d up = area_vector.z() < 0 ? (-area_vector).eval() : area_vector;
  add_cell(up, {area, up});
}

void FacetOrientation::add(const FacetOrientation& other, double factor) {
  add(other, factor, 0.0);
}

void FacetOrientation::add(const FacetOrientation& other, double factor, double about_z) {
  if (other.empty()) return;
  for (std::size_t k = 0; k < fine_bins; ++k) {
    weight_[k] += factor * other.weight_[k];
    weighted_angle_[k] += factor * other.weighted_angle_[k];
  }
  area_ += factor * other.area_;
  angle_sum_ += factor * other.angle_sum_;
  angle2_sum_ += factor * other.angle2_sum_;
  cos2_sum_ += factor * other.cos2_sum_;
  const double c = std::cos(about_z), s = std::sin(about_z);
  for (std::size_t k = 0; k < cells_.size(); ++k) {
    const Cell& cell = other.cells_[k];
    if (!(cell.area > 0)) continue;
    const Eigen::Vector3d v = factor * cell.vector;
    if (about_z == 0) {
      cells_[k].area += factor * cell.area;
      cells_[k].vector += v;
    } else {
      const Eigen::Vector3d turned(c * v.x() - s * v.y(), s * v.x() + c * v.y(), v.z());
      add_cell(turned, {factor * cell.area, turned});
    }
  }
}

void FacetOrientation::add(const FacetOrientation& other, double factor, const Eigen::Matrix3d& rotation) {
  for (const Cell& cell : other.cells_) {
    if (!(cell.area > 0)) continue;
    Eigen::Vector3d v = factor * (rotation * cell.vector);
    if (v.z() < 0) v = -v;
    add_inclination(inclination_of(v), factor * cell.area);
    add_cell(v, {factor * cell.area, v});
  }
}

double FacetOrientation::sd_inclination() const {
  const double mean = mean_inclination();
  return std::sqrt(std::max(0.0, angle2_sum_ / area_ - mean * mean));
}

std::vector<AngleBin> FacetOrientation::inclination_bins(double width_deg) const {
  std::vector<AngleBin> out;
  if (empty()) return out;
  const auto count = static_cast<std::size_t>(std::lround(90 / width_deg));
  const std::size_t each = fine_bins / count;
  for (std::size_t k = 0; k < count; ++k) {
    double sum = 0;
    for (std::size_t i = k * each; i < (k + 1) * each; ++i) sum += weight_[i];
    const double from = width_deg * static_cast<double>(k);
    out.push_back({from, from + width_deg, sum / area_, sum / area_ / width_deg});
  }
  return out;
}

std::vector<AngleBin> FacetOrientation::azimuth_bins(double width_deg) const {
  std::vector<AngleBin> out;
  if (empty()) return out;
  const auto count = static_cast<std::size_t>(std::lround(360 / width_deg));
  const std::size_t each = cell_columns / count;
  for (std::size_t k = 0; k < count; ++k) {
    double sum = 0;
    for (std::size_t row = 0; row < cell_rows; ++row)
      for (std::size_t i = k * each; i < (k + 1) * each; ++i) sum += cells_[row * cell_columns + i].area;
    const double from = width_deg * static_cast<double>(k);
    out.push_back({from, from + width_deg, sum / area_, sum / area_ / width_deg});
  }
  return out;
}

double FacetOrientation::g(double zenith) const {
  double sum = 0;
  for (std::size_t i = 0; i < fine_bins; ++i) {
    if (weight_[i] > 0) sum += weight_[i] * mean_projection(weighted_angle_[i] / weight_[i], zenith);
  }
  return sum / area_;
}

double FacetOrientation::g(double zenith, double azimuth) const {
  const Eigen::Vector3d omega(std::sin(zenith) * std::cos(azimuth), std::sin(zenith) * std::sin(azimuth),
                              std::cos(zenith));
  double sum = 0;
  for (const Cell& cell : cells_) sum += std::abs(cell.vector.dot(omega));
  return sum / area_;
}

std::vector<FacetOrientation::Band> FacetOrientation::bands(std::size_t count) const {
  std::vector<Band> out(count);
  for (std::size_t i = 0; i < fine_bins; ++i) {
    Band& band = out[i * count / fine_bins];
    band.area += weight_[i];
    band.inclination += weighted_angle_[i];
  }
  for (Band& band : out)
    if (band.area > 0) band.inclination /= band.area;
  return out;
}

Eigen::Vector3d triangle_area_vector(const Mesh& mesh, std::size_t triangle) {
  const auto& [a, b, c] = mesh.triangles[triangle];
  const Eigen::Vector3d p = mesh.positions_m[a].cast<double>();
  return 0.5 * (mesh.positions_m[b].cast<double>() - p).cross(mesh.positions_m[c].cast<double>() - p);
}

FacetOrientation leaf_orientation(const Mesh& mesh) {
  FacetOrientation out;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    if (mesh.organs[mesh.organ_of_triangle[t]].kind == "leaf") out.add(triangle_area_vector(mesh, t));
  return out;
}

}  // namespace bpms
