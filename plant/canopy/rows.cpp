// Rows: parallel lines of plants. In a periodic domain of size (X, Y) rows go over into themselves only when
// their wave vector is (m / X, n / Y) with whole m, n: spacing and azimuth snap to the nearest such pair. The
// lines are then gcd(m, n) closed curves of equal length. In an open domain nothing snaps and rows are cut at
// the border.
#include <cmath>
#include <numeric>

#include "core/units.h"
#include "plant/canopy/pattern.h"

namespace bpms {
namespace {

struct Row {
  Eigen::Vector2d start;
  double length_m;
};

struct RowSet {
  Eigen::Vector2d along, across;  // unit
  double spacing_m;
  std::vector<Row> rows;
};

RowSet periodic_rows(double spacing_m, double azimuth, PlantingField& field) {
  const Eigen::Vector2d wave = Eigen::Vector2d(std::cos(azimuth), -std::sin(azimuth)) / spacing_m;
  long long m = std::llround(wave.x() * field.size_m.x());
  long long n = std::llround(wave.y() * field.size_m.y());
  if (m == 0 && n == 0) (std::abs(wave.x()) >= std::abs(wave.y()) ? m : n) = 1;  // one row at least
  const Eigen::Vector2d snapped(static_cast<double>(m) / field.size_m.x(),
                                static_cast<double>(n) / field.size_m.y());
  RowSet out;
  out.spacing_m = 1 / snapped.norm();
  out.across = snapped.normalized();
  out.along = {-out.across.y(), out.across.x()};
  if (out.along.dot(Eigen::Vector2d(std::sin(azimuth), std::cos(azimuth))) < 0) out.along = -out.along;
  const double turned = std::acos(std::min(1.0, std::abs(out.across.dot(wave.normalized()))));
  if (std::abs(out.spacing_m / spacing_m - 1) > 1e-9 || turned > 1e-9)
    field.notes.push_back(
        fmt::format("rows snapped to the periodic domain: spacing {:.6g} m became {:.6g} m ({:+.3f} %), "
                    "azimuth turned by {:.4g} degrees",
                    spacing_m, out.spacing_m, 100 * (out.spacing_m / spacing_m - 1), degrees(turned)));
  const long long closed = std::gcd(m, n);
  const double length = field.area_m2() / (out.spacing_m * static_cast<double>(closed));
  for (long long i = 0; i < closed; ++i) {
    const double offset = (static_cast<double>(i) + 0.5) * out.spacing_m;
    out.rows.push_back({offset * out.across, length});
  }
  return out;
}

// The part of the line start + t along that lies in the field.
std::optional<Row> cut(const Eigen::Vector2d& point, const Eigen::Vector2d& along,
                       const PlantingField& field) {
  double from = -field.size_m.norm(), to = field.size_m.norm();
  for (int k = 0; k < 2; ++k) {
    const double half = field.size_m[k] / 2;
    if (std::abs(along[k]) < 1e-12) {
      if (std::abs(point[k]) > half) return std::nullopt;
      continue;
    }
    const double a = (-half - point[k]) / along[k], b = (half - point[k]) / along[k];
    from = std::max(from, std::min(a, b));
    to = std::min(to, std::max(a, b));
  }
  if (to <= from) return std::nullopt;
  return Row{point + from * along, to - from};
}

RowSet open_rows(double spacing_m, double azimuth, const PlantingField& field) {
  RowSet out{{std::sin(azimuth), std::cos(azimuth)}, {std::cos(azimuth), -std::sin(azimuth)}, spacing_m, {}};
  const double reach = (out.across.cwiseAbs().array() * field.size_m.array()).sum() / 2;
  const long long count = std::max(1LL, std::llround(2 * reach / spacing_m));
  for (long long i = 0; i < count; ++i) {
    const double offset = (static_cast<double>(i) - static_cast<double>(count - 1) / 2) * spacing_m;
    if (const auto row = cut(offset * out.across, out.along, field)) out.rows.push_back(*row);
  }
  return out;
}

}  // namespace

std::vector<PlantingSite> plant_rows(const TomlValue& planting, PlantingField& field) {
  const TomlValue spacing_key = planting.require("row_spacing_m");
  const MeanSd spacing = positive_mean_sd(spacing_key);
  plant_count(std::max(1.0, field.size_m.norm() / spacing.mean),
              spacing_key);  // as many rows, before they are made
  const double azimuth = radians(planting.number_or("row_azimuth_deg", 0));
  const RowSet set =
      field.periodic ? periodic_rows(spacing.mean, azimuth, field) : open_rows(spacing.mean, azimuth, field);
  double total_length = 0;
  for (const Row& row : set.rows) total_length += row.length_m;

  const TomlValue in_row_key = planting.get("spacing_in_row_m");
  const TomlValue density_key = planting.get("density_per_m2");
  if (static_cast<bool>(in_row_key) == static_cast<bool>(density_key))
    planting.reject_choice("expected one of density_per_m2 and spacing_in_row_m");
  MeanSd in_row;
  if (in_row_key)
    in_row = positive_mean_sd(in_row_key);
  else
    in_row.mean = total_length / (density_key.positive() * field.area_m2());
  const TomlValue key = in_row_key ? in_row_key : density_key;
  if (density_key) field.wanted = density_key.positive() * field.area_m2();
  const std::size_t plants = plant_count(total_length / in_row.mean, key);

  // Displacements of sd / sqrt 2 on either side give the distance between neighbours its sd.
  const double row_scatter = spacing.sd / std::sqrt(2.0), plant_scatter = in_row.sd / std::sqrt(2.0);
  std::vector<PlantingSite> out;
  double length_before = 0;
  for (const Row& row : set.rows) {
    // Whole plants a row; what is left over goes on to the next, so that the total is right.
    const auto planted = [&](double length) {
      return static_cast<std::size_t>(std::llround(static_cast<double>(plants) * length / total_length));
    };
    const std::size_t count = planted(length_before + row.length_m) - planted(length_before);
    length_before += row.length_m;
    const double aside = row_scatter * field.random.normal();
    const double phase = field.random.uniform();
    for (std::size_t i = 0; i < count; ++i) {
      const double at = (static_cast<double>(i) + phase) * row.length_m / static_cast<double>(count) +
                        plant_scatter * field.random.normal();
      const Eigen::Vector2d xy = row.start + at * set.along + aside * set.across;
      field.plant(xy, out);
    }
  }
  return out;
}

}  // namespace bpms
