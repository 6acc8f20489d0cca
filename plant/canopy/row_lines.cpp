#include "plant/canopy/row_lines.h"

#include <cmath>

#include "core/units.h"
#include "plant/canopy/pattern.h"

namespace bpms {
namespace {

constexpr double same = 1e-9;  // relative: no more than rounding

// The domain's sides become whole numbers of wave lengths.
void fit_domain(const Eigen::Vector2d& wave, const char* what, const TomlValue& where, PlantingField& field) {
  constexpr double most_growth = 1.5;
  const Eigen::Vector2d before = field.size_m;
  for (int k = 0; k < 2; ++k) {
    const double per_metre = std::abs(wave[k]);
    if (per_metre < same * wave.norm()) continue;  // the lines run along this side
    const double whole = std::max(1.0, std::round(per_metre * field.size_m[k]));
    field.size_m[k] = whole / per_metre;
    if (field.size_m[k] > most_growth * before[k])
      where.reject(
          fmt::format("{} so oblique repeat only every {:.6g} m along {}, the domain is {:.6g} m: "
                      "enlarge it, turn them, or leave out [domain] snap",
                      what, 1 / per_metre, k == 0 ? "x" : "y", before[k]));
  }
  const Eigen::Array2d change = field.size_m.array() / before.array() - 1;
  if (change.abs().maxCoeff() > same)
    field.notes.push_back(fmt::format(
        "the domain snapped to whole {}: {:.6g} x {:.6g} m became {:.6g} x {:.6g} m ({:+.3f} %, {:+.3f} %)",
        what, before.x(), before.y(), field.size_m.x(), field.size_m.y(), 100 * change.x(),
        100 * change.y()));
}

RowLines periodic_lines(double spacing_m, double azimuth, const char* what, PlantingField& field) {
  const Eigen::Vector2d wave = Eigen::Vector2d(std::cos(azimuth), -std::sin(azimuth)) / spacing_m;
  Eigen::Vector2d whole = wave.cwiseProduct(field.size_m).array().round();
  if (whole.isZero()) whole[std::abs(wave.x()) >= std::abs(wave.y()) ? 0 : 1] = 1;  // one line at least
  const Eigen::Vector2d snapped = whole.cwiseQuotient(field.size_m);
  RowLines out;
  out.spacing_m = 1 / snapped.norm();
  out.across = snapped.normalized();
  out.along = {-out.across.y(), out.across.x()};
  if (out.along.dot(Eigen::Vector2d(std::sin(azimuth), std::cos(azimuth))) < 0) out.along = -out.along;
  out.offset_m = 0.5 * out.spacing_m;
  const double cosine = std::min(1.0, std::abs(out.across.dot(wave.normalized())));
  const double turned = 1 - cosine < 1e-14 ? 0 : std::acos(cosine);
  if (std::abs(out.spacing_m / spacing_m - 1) > same || turned > same)
    field.notes.push_back(
        fmt::format("{} snapped to the periodic domain: spacing {:.6g} m became {:.6g} m ({:+.3f} %), "
                    "azimuth turned by {:.4g} degrees",
                    what, spacing_m, out.spacing_m, 100 * (out.spacing_m / spacing_m - 1), degrees(turned)));
  return out;
}

}  // namespace

long long row_line_count(const RowLines& lines, const Eigen::Vector2d& size_m) {
  const double reach = (lines.across.cwiseAbs().array() * size_m.array()).sum();
  return std::max(1LL, std::llround(reach / lines.spacing_m));
}

RowLines fit_row_lines(double spacing_m, double azimuth, const char* what, const TomlValue& where,
                       PlantingField& field) {
  field.plant_count(std::max(1.0, field.size_m.norm() / spacing_m),
                    where);  // as many lines, before they are made
  if (field.periodic && field.snap_domain) {
    const Eigen::Vector2d wave = Eigen::Vector2d(std::cos(azimuth), -std::sin(azimuth)) / spacing_m;
    fit_domain(wave, what, where, field);
    field.snap_domain = false;  // what comes after it fits the domain
  }
  if (field.periodic) return periodic_lines(spacing_m, azimuth, what, field);
  RowLines out{{std::sin(azimuth), std::cos(azimuth)}, {std::cos(azimuth), -std::sin(azimuth)}, spacing_m, 0};
  const long long count = row_line_count(out, field.size_m);
  out.offset_m = -0.5 * static_cast<double>(count - 1) * spacing_m;
  return out;
}

}  // namespace bpms
