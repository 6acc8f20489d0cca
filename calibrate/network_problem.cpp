#include "calibrate/network_problem.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "core/text.h"

namespace bpms {
namespace {

constexpr int enough_views = 3;

// "; skipped left3.png: no whole chessboard found", the first few.
std::string skipped_words(const Observations& observations) {
  constexpr std::size_t most = 3;
  std::string out;
  const auto& skipped = observations.skipped;
  for (std::size_t i = 0; i < std::min(most, skipped.size()); ++i)
    out += fmt::format("; skipped {}: {}", skipped[i].image, skipped[i].reason);
  if (skipped.size() > most) out += fmt::format("; and {} more", skipped.size() - most);
  return out;
}

NetworkTarget network_target(const Target& target, const CalibrateOptions& options) {
  NetworkTarget out;
  out.name = target.name.empty() ? target.kind : target.name;
  out.points_m = target.points_m();
  std::vector<Eigen::Vector2d> bending = target.bending();
  const bool bends = std::any_of(bending.begin(), bending.end(), [](const auto& b) { return b.norm() > 0; });
  if (options.board_warp && bends && !target.stands) out.bending = std::move(bending);
  out.stands = target.stands;
  out.covariance_m2 = target.covariance_m2;
  out.bars = target.scale_bars;
  if (options.free_points && target.stands)
    out.known = PointsKnown::free;
  else if (!out.covariance_m2.empty())
    out.known = PointsKnown::surveyed;
  return out;
}

// Where nothing else can give: a length between points that are taken as exact must be what it is.
void require_bars(const NetworkTarget& target) {
  if (target.known != PointsKnown::exact) return;
  for (const ScaleBar& bar : target.bars) {
    const double length =
        (target.points_m[static_cast<std::size_t>(bar.a)] - target.points_m[static_cast<std::size_t>(bar.b)])
            .norm();
    constexpr double sigmas = 4;
    if (std::abs(length - bar.length_m) > sigmas * bar.sigma_m)
      bad_input({},
                "the scale bar between points {} and {} of the {} is {:.6g} m +- {:.2g} m, the target says "
                "{:.6g} m: "
                "its squares or tags are {:.3g} times as large as given",
                bar.a, bar.b, target.name, bar.length_m, bar.sigma_m, length, bar.length_m / length);
  }
}

}  // namespace

// Frames in order of their numbers, "9" before "10".
std::vector<std::string> frame_names(const Observations& observations) {
  std::set<std::pair<long long, std::string>> sorted;
  for (const BoardView& view : observations.views)
    sorted.emplace(parse_integer(view.frame).value_or(0), view.frame);
  std::vector<std::string> out;
  for (const auto& [number, name] : sorted) out.push_back(name);
  return out;
}

void require_views(const Observations& observations, bool one_will_do) {
  const int fewest = one_will_do ? 1 : enough_views;
  if (observations.views.empty()) {
    const auto& skipped = observations.skipped;
    if (skipped.empty()) bad_input({}, "no usable view of the target");
    bad_input({}, "no usable view of the target among {} images; the first, {}: {}", skipped.size(),
              skipped.front().image, skipped.front().reason);
  }
  for (std::size_t c = 0; c < observations.cameras.size(); ++c) {
    const auto views =
        std::count_if(observations.views.begin(), observations.views.end(),
                      [&](const BoardView& view) { return view.camera == static_cast<int>(c); });
    if (views < fewest)
      bad_input({}, "camera {} has {} usable view{} of the target, at least {} are needed{}",
                in_quotes(observations.cameras[c].name), views, views == 1 ? "" : "s", fewest,
                skipped_words(observations));
  }
}

BundleProblem network_problem(const Observations& observations, const std::vector<Target>& targets,
                              const std::vector<std::string>& frames, const CalibrateOptions& options) {
  BundleProblem out;
  for (const Target& target : targets) {
    out.targets.push_back(network_target(target, options));
    require_bars(out.targets.back());
  }
  out.rig_moves = options.rig_moves || options.table_step_rad != 0;
  if (options.table_step_rad != 0) {
    for (NetworkTarget& target : out.targets) target.stands = true;  // on the table
  } else if (options.rig_moves) {
    const auto datum = std::find_if(targets.begin(), targets.end(), [](const Target& t) { return t.stands; });
    if (datum == targets.end())
      bad_input({}, "a rig that moves needs a target that stands (stands = true in its file)");
    out.datum = static_cast<int>(datum - targets.begin());
  }
  out.frames = static_cast<int>(frames.size());
  if (options.table_step_rad != 0) {
    for (const std::string& name : frames)
      out.table_angles.push_back(options.table_step_rad *
                                 static_cast<double>(parse_integer(name).value_or(0)));
  }
  out.held.resize(observations.cameras.size());
  for (std::size_t c = 0; c < out.held.size(); ++c) {
    const auto views = std::count_if(observations.views.begin(), observations.views.end(),
                                     [&](const BoardView& v) { return v.camera == static_cast<int>(c); });
    if (views < enough_views) out.held[c] = {2, 3};
  }
  std::map<std::string, int> frame_index;
  for (const std::string& name : frames) frame_index.emplace(name, static_cast<int>(frame_index.size()));
  for (std::size_t v = 0; v < observations.views.size(); ++v) {
    const BoardView& view = observations.views[v];
    const int frame = frame_index.at(view.frame);
    for (const ImageCorner& corner : view.corners) {
      if (corner.point < 0 || corner.point >= targets[static_cast<std::size_t>(view.target)].size())
        bad_input({view.image}, "corner {} is not on the target", corner.point);
      out.corners.push_back(
          {static_cast<int>(v), frame, view.camera, view.target, corner.point, corner.pixel});
    }
  }
  return out;
}

}  // namespace bpms
