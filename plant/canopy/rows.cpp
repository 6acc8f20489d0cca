// Rows: parallel lines of plants, which may scatter over a band about each. In a periodic domain the lines
// are gcd(m, n) closed curves of equal length (row_lines.h); in an open one rows are cut at the border.
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

std::vector<Row> closed_rows(const RowLines& lines, const Eigen::Vector2d& size_m) {
  const Eigen::Vector2d waves = lines.across.cwiseProduct(size_m) / lines.spacing_m;
  const long long closed = std::gcd(std::llround(waves.x()), std::llround(waves.y()));
  const double length = size_m.prod() / (lines.spacing_m * static_cast<double>(closed));
  std::vector<Row> out;
  for (long long i = 0; i < closed; ++i)
    out.push_back({(lines.offset_m + static_cast<double>(i) * lines.spacing_m) * lines.across, length});
  return out;
}

// The part of the line start + t along that lies in the field.
std::optional<Row> cut(const Eigen::Vector2d& point, const Eigen::Vector2d& along,
                       const Eigen::Vector2d& size_m) {
  double from = -size_m.norm(), to = size_m.norm();
  for (int k = 0; k < 2; ++k) {
    const double half = size_m[k] / 2;
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

std::vector<Row> cut_rows(const RowLines& lines, const Eigen::Vector2d& size_m) {
  std::vector<Row> out;
  const long long count = row_line_count(lines, size_m);
  for (long long i = 0; i < count; ++i) {
    const double offset = lines.offset_m + static_cast<double>(i) * lines.spacing_m;
    if (const auto row = cut(offset * lines.across, lines.along, size_m)) out.push_back(*row);
  }
  return out;
}

// How a plant scatters about its place.
struct RowScatter {
  double along_m = 0;        // sd along the row about where even spacing puts it
  bool random = false;       // anywhere in the row
  double hill_radius_m = 0;  // anywhere in a disc
};

// How places lie along a row and aside of it.
struct InRow {
  MeanSd per_m;       // of places, drawn for each row
  MeanSd width_m;     // of the band, drawn for each row
  MeanSd hill{1, 0};  // plants at a place
  RowScatter scatter;
};

// A place of a row: where it would stand without scatter, and how it scatters.
struct RowPlace {
  Eigen::Vector2d row_start;  // where the row begins, its own displacement included
  double at_m, length_m, width_m;
};

Eigen::Vector2d scattered(const RowPlace& place, const RowScatter& scatter, const RowLines& lines,
                          Philox& random) {
  double at = place.at_m;
  if (scatter.random)
    at = random.uniform(0, place.length_m);
  else
    at += scatter.along_m * random.normal();
  const double aside = place.width_m > 0 ? random.uniform(-0.5, 0.5) * place.width_m : 0;
  return place.row_start + at * lines.along + aside * lines.across;
}

Eigen::Vector2d within_hill(const Eigen::Vector2d& centre, double radius_m, Philox& random) {
  const double r = radius_m * std::sqrt(random.uniform());
  const double angle = random.uniform(0, 2 * pi);
  return centre + r * Eigen::Vector2d(std::cos(angle), std::sin(angle));
}

class RowFreedom : public SiteFreedom {
 public:
  RowFreedom(const RowScatter& scatter, const RowLines& lines, const PlantingField& field)
      : scatter_(scatter), lines_(lines), field_{field.size_m, field.periodic, Philox(0)} {}
  void add(const RowPlace& place) { places_.push_back(place); }
  std::optional<Eigen::Vector2d> again(std::size_t i, Philox& random) override {
    const RowPlace& place = places_[i];
    const bool in_hill = scatter_.hill_radius_m > 0;
    if (!in_hill && !scatter_.random && scatter_.along_m == 0 && place.width_m == 0) return std::nullopt;
    const Eigen::Vector2d xy = in_hill ? within_hill(place.row_start, scatter_.hill_radius_m, random)
                                       : scattered(place, scatter_, lines_, random);
    if (field_.periodic) return field_.wrapped(xy);
    return field_.holds(xy) ? std::optional(xy) : std::nullopt;
  }

 private:
  RowScatter scatter_;
  RowLines lines_;
  PlantingField field_;
  std::vector<RowPlace> places_;  // of a hill's plants, its centre alone
};

void read_hills(const TomlValue& planting, InRow& out) {
  const TomlValue hill = planting.get("plants_per_hill"), radius = planting.get("hill_radius_m");
  if (!hill) {
    if (radius) radius.reject("without plants_per_hill there are no hills");
    return;
  }
  constexpr double most = 1000;
  out.hill = positive_mean_sd(hill);
  if (out.hill.mean > most) hill.reject("expected up to 1000 plants");
  if (out.hill.sd > out.hill.mean) hill.reject("expected an sd no larger than the mean");
  out.scatter.hill_radius_m = planting.require("hill_radius_m").positive();
}

// `total_length_m`: of all rows; for the density.
InRow read_in_row(const TomlValue& planting, double total_length_m, PlantingField& field) {
  InRow out{};
  if (const TomlValue in_row = planting.get("in_row"))
    out.scatter.random = in_row.one_of({"regular", "random"}) == "random";
  if (const TomlValue width = planting.get("row_width_m")) {
    out.width_m = mean_sd(width);
    if (out.width_m.mean < 0) width.reject("expected a width of 0 or more");
  }
  read_hills(planting, out);
  const TomlValue spacing = planting.get("spacing_in_row_m"), per_m = planting.get("plants_per_m"),
                  density = planting.get("density_per_m2");
  if (static_cast<int>(static_cast<bool>(spacing)) + static_cast<int>(static_cast<bool>(per_m)) +
          static_cast<int>(static_cast<bool>(density)) !=
      1)
    planting.reject_choice("expected one of density_per_m2, plants_per_m and spacing_in_row_m");
  if (spacing) {
    const MeanSd between = positive_mean_sd(spacing);
    if (out.scatter.random && between.sd > 0)
      spacing.reject("plants at random in their row have no sd of spacing");
    // Displacements of sd / sqrt 2 on either side give the distance between neighbours its sd.
    out.scatter.along_m = between.sd / std::sqrt(2.0);
    out.per_m = {1 / between.mean, 0};
  } else if (per_m) {
    out.per_m = positive_mean_sd(per_m);
    if (out.per_m.sd > out.per_m.mean) per_m.reject("expected an sd no larger than the mean");
    out.per_m.mean /= out.hill.mean, out.per_m.sd /= out.hill.mean;
  } else {
    field.wanted = density.positive() * field.area_m2();
    out.per_m = {field.wanted / (out.hill.mean * total_length_m), 0};
  }
  const TomlValue key = spacing ? spacing : per_m ? per_m : density;
  field.plant_count(total_length_m * out.per_m.mean * out.hill.mean, key);
  const auto places = static_cast<double>(field.plant_count(total_length_m * out.per_m.mean, key));
  if (!per_m) out.per_m.mean = places / total_length_m;  // whole places in all
  return out;
}

std::size_t plants_at(const MeanSd& hill, Philox& random) {
  if (hill.sd == 0 && hill.mean == std::round(hill.mean)) return static_cast<std::size_t>(hill.mean);
  const double wanted = hill.mean + hill.sd * (hill.sd > 0 ? random.normal() : 0);
  return static_cast<std::size_t>(std::max(0.0, std::floor(wanted + random.uniform())));
}

// Plants the places of one row after another.
class RowPlanter {
 public:
  RowPlanter(const InRow& in_row, const RowLines& lines, PlantingField& field)
      : in_row_(in_row), lines_(lines), field_(field) {
    if (field.want_freedom) freedom_ = std::make_unique<RowFreedom>(in_row.scatter, lines, field);
  }
  ~RowPlanter() { field_.freedom = std::move(freedom_); }
  RowPlanter(const RowPlanter&) = delete;
  RowPlanter& operator=(const RowPlanter&) = delete;

  // `aside_sd_m`: of the whole row.
  void plant(const Row& row, double aside_sd_m) {
    const std::size_t count = places_of(row);
    RowPlace place{row.start, 0, row.length_m, in_row_.width_m.mean};
    place.row_start += aside_sd_m * field_.random.normal() * lines_.across;
    const double phase = field_.random.uniform();
    if (in_row_.width_m.sd > 0)
      place.width_m = std::max(0.0, place.width_m + in_row_.width_m.sd * field_.random.normal());
    for (std::size_t i = 0; i < count; ++i) {
      place.at_m = (static_cast<double>(i) + phase) * row.length_m / static_cast<double>(count);
      plant_place(place);
    }
  }
  std::vector<PlantingSite> sites;

 private:
  // Whole places a row; what is left over goes on to the next, so that the total is right.
  std::size_t places_of(const Row& row) {
    const double before = places_;
    double per_m = in_row_.per_m.mean;
    if (in_row_.per_m.sd > 0) per_m = std::max(0.0, per_m + in_row_.per_m.sd * field_.random.normal());
    places_ += per_m * row.length_m;
    return static_cast<std::size_t>(std::llround(places_) - std::llround(before));
  }

  void plant_place(const RowPlace& place) {
    Eigen::Vector2d xy = scattered(place, in_row_.scatter, lines_, field_.random);
    if (in_row_.scatter.hill_radius_m == 0) return plant_one(xy, place);
    const RowPlace hill{xy, 0, 0, 0};
    const std::size_t plants = plants_at(in_row_.hill, field_.random);
    for (std::size_t k = 0; k < plants; ++k)
      plant_one(within_hill(xy, in_row_.scatter.hill_radius_m, field_.random), hill);
  }
  void plant_one(const Eigen::Vector2d& xy, const RowPlace& place) {
    if (field_.plant(xy, sites) && freedom_) freedom_->add(place);
  }

  const InRow& in_row_;
  const RowLines& lines_;
  PlantingField& field_;
  double places_ = 0;
  std::unique_ptr<RowFreedom> freedom_;
};

}  // namespace

std::vector<PlantingSite> plant_rows(const TomlValue& planting, PlantingField& field) {
  const TomlValue spacing_key = planting.require("row_spacing_m");
  const MeanSd spacing = positive_mean_sd(spacing_key);
  const double azimuth = radians(planting.number_or("row_azimuth_deg", 0));
  const RowLines lines = fit_row_lines(spacing.mean, azimuth, "rows", spacing_key, field);
  field.rows = lines;
  const std::vector<Row> rows =
      field.periodic ? closed_rows(lines, field.size_m) : cut_rows(lines, field.size_m);
  double total_length = 0;
  for (const Row& row : rows) total_length += row.length_m;
  const InRow in_row = read_in_row(planting, total_length, field);
  RowPlanter planter(in_row, lines, field);
  for (const Row& row : rows) planter.plant(row, spacing.sd / std::sqrt(2.0));
  return std::move(planter.sites);
}

}  // namespace bpms
