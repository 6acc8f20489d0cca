#include "plant/canopy/reduce_overlap.h"

#include <numeric>
#include <set>

#include "core/units.h"
#include "plant/canopy/overlap.h"

namespace bpms {
namespace {

constexpr std::uint64_t overlap_stream = std::uint64_t{1} << 40;  // beyond the streams of the plants

class OverlapReducer {
 public:
  OverlapReducer(const CanopyOverlapOptions& options, const std::vector<PlantingSite>& sites,
                 PlantingField& field, const Standing& standing, const PlantSource* source, Canopy& canopy)
      : options_(options),
        sites_(sites),
        field_(field),
        standing_(standing),
        source_(source),
        canopy_(canopy),
        crossings_(canopy) {}

  double largest_radius_m() const { return crossings_.largest_radius_m(); }
  CanopyOverlap run() {
    CanopyOverlap out;
    const double leaf_m2 = crossings_.leaf_area_m2();
    std::vector<double> own = crossings_.own_m2();
    const auto fraction = [&] {
      return leaf_m2 > 0 ? std::accumulate(own.begin(), own.end(), 0.0) / leaf_m2 : 0;
    };
    out.fraction = out.before = fraction();
    for (int k = 0; options_.at_most && k < options_.tries && out.fraction > *options_.at_most; ++k) {
      for (std::size_t i = 0; i < own.size(); ++i)
        if (own[i] > 0) try_again(i, k);
      own = crossings_.own_m2();
      out.fraction = fraction();
    }
    out.moved = moved_.size();
    return out;
  }

 private:
  void try_again(std::size_t i, int k) {
    const auto tries = static_cast<std::uint64_t>(options_.tries);
    Philox random(canopy_.seed, overlap_stream + i * tries + static_cast<std::uint64_t>(k));
    Placement there = canopy_.placements[i];
    if (!sites_[i].rotation) there.rotation = rotation_again(i, random);
    std::optional<Eigen::Vector2d> to;
    if (2 * k >= options_.tries && field_.freedom) to = field_.freedom->again(i, random);
    if (to) move_placement(*to, standing_, canopy_, there);
    if (!to && there.rotation == canopy_.placements[i].rotation) return;
    if (crossings_.crossing(i, there).sum() >= crossings_.crossing(i).sum()) return;
    crossings_.move(i, there);
    canopy_.placements[i] = there;
    if (to) field_.freedom->move(i, *to);
    moved_.insert(i);
  }
  double rotation_again(std::size_t i, Philox& random) const {
    if (sites_[i].plant) return random.uniform(0, 2 * pi);  // as place_plants turns them
    return source_->rotation(canopy_.placements[i].plant, random);
  }

  const CanopyOverlapOptions& options_;
  const std::vector<PlantingSite>& sites_;
  PlantingField& field_;
  const Standing& standing_;
  const PlantSource* source_;
  Canopy& canopy_;
  PlantCrossings crossings_;
  std::set<std::size_t> moved_;
};

}  // namespace

CanopyOverlapOptions read_overlap(const TomlValue& root) {
  CanopyOverlapOptions out;
  const TomlValue table = root.get("overlap");
  if (!table) return out;
  out.report = table.boolean_or("report", true);
  const TomlValue at_most = table.get("at_most"), tries = table.get("tries");
  if (at_most) out.at_most = at_most.number(0, 1);
  if (tries && !at_most) tries.reject("nothing is tried without at_most");
  constexpr long long most_tries = 10'000;
  if (tries) out.tries = static_cast<int>(tries.integer(1, most_tries));
  return out;
}

void handle_overlap(const TomlValue& root, const CanopyOverlapOptions& options,
                    const std::vector<PlantingSite>& sites, PlantingField& field, const Standing& standing,
                    const PlantSource* source, Canopy& canopy) {
  if (!options.report && !options.at_most) return;
  make_canopy_meshes(canopy);
  OverlapReducer reducer(options, sites, field, standing, source, canopy);
  constexpr double most_periods = 10;
  if (canopy.periodic && reducer.largest_radius_m() > most_periods * canopy.size_m.minCoeff())
    root.get("overlap").reject(fmt::format(
        "a plant of {:.3g} m across would be met by too many images of itself in a periodic domain of "
        "{:.6g} x {:.6g} m",
        2 * reducer.largest_radius_m(), canopy.size_m.x(), canopy.size_m.y()));
  const CanopyOverlap overlap = reducer.run();
  canopy.overlap = overlap;
  std::string note = fmt::format("overlap: {:.4g} of the leaf area is on triangles that cross other plants",
                                 overlap.fraction);
  if (overlap.moved > 0)
    note += fmt::format("; {:.4g} before {} of {} plants were turned or moved", overlap.before, overlap.moved,
                        canopy.placements.size());
  if (options.at_most && overlap.fraction > *options.at_most)
    note += fmt::format("; {:.4g} was asked for: allow more tries, more room or a lower density",
                        *options.at_most);
  canopy.notes.push_back(std::move(note));
}

}  // namespace bpms
