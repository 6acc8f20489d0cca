#include "calibrate/adjustment/synthetic.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "calibrate/lenses/enrich.h"
#include "calibrate/lenses/lens.h"
#include "core/random.h"
#include "core/units.h"

namespace bpms {
namespace {

constexpr int width_px = 640, height_px = 480;
constexpr double baseline_m = 0.083;

Camera make_camera(int index, const LensChoice& lens, double focal_px, Philox& random) {
  Camera camera;
  camera.name = fmt::format("camera{}", static_cast<char>('A' + index));
  camera.width_px = width_px;
  camera.height_px = height_px;
  // The lenses of a real webcam pair; the rational model needs a denominator to be determined at all.
  camera.parameters = {focal_px, focal_px + 1, 322, 241, -0.28, 0.09, 0.0008, -0.0005, 0.02};
  if (lens.model != "brown_conrady" || lens.parameters == 12)
    camera.parameters = {focal_px, focal_px + 1, 322, 241, 0.6, 0.3, 0.0008, -0.0005, 0.1, 0.9, 0.5, 0.2};
  if (lens.model == "fisheye")
    camera.parameters = {focal_px, focal_px + 1, 322, 241, 0.03, -0.01, 0.004, -0.001};
  for (int i = 0; i < 4; ++i) camera.parameters[static_cast<std::size_t>(i)] += random.uniform(-5, 5);
  if (lens.model == "fisheye") camera.model = lens.model;
  if (lens.model == "splined_stereographic") {
    camera = enriched(camera, lens);  // and waves that no formula has
    for (std::size_t i = 4; i < camera.parameters.size(); ++i)
      camera.parameters[i] += 0.004 * std::sin(0.9 * static_cast<double>(i) + index);
  }
  camera.parameters.resize(static_cast<std::size_t>(lens.parameters));
  if (index > 0) {
    const Eigen::Vector3d turn(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    camera.r_cam_from_rig = rotation_from_vector(radians(1.5) * turn);
    camera.t_cam_from_rig_m = {-baseline_m * index, 0.001 * random.normal(), 0.001 * random.normal()};
  }
  return camera;
}

Pose held_board(const Target& target, double focal_px, Philox& random) {
  const double tilt = radians(random.uniform(10, 40)), towards = random.uniform(0, 2 * pi);
  const Eigen::Vector3d axis(std::cos(towards), std::sin(towards), 0);
  const Eigen::Matrix3d r = (Eigen::AngleAxisd(tilt, axis) *
                             Eigen::AngleAxisd(radians(random.uniform(-25, 25)), Eigen::Vector3d::UnitZ()))
                                .toRotationMatrix();
  const Eigen::Vector3d middle(0.5 * (target.columns - 1) * target.square_m,
                               0.5 * (target.rows - 1) * target.square_m, 0);
  const double z = random.uniform(0.35, 0.6);
  const double right = z / focal_px * random.uniform(-190, 240),
               down = z / focal_px * random.uniform(-135, 135);
  const Eigen::Vector3d centre(right, down, z);
  return {r, centre - r * middle};
}

bool whole_in_every_image(const BundleProblem& board, const BundleState& state, int frame) {
  for (std::size_t c = 0; c < state.cameras.size(); ++c) {
    for (int i = 0; i < static_cast<int>(board.targets[0].points_m.size()); ++i) {
      const Eigen::Vector3d x = rig_from_target(board, state, 0, frame) * target_point(board, state, 0, i);
      const auto pixel = project(state.cameras[c], state.cameras[c].camera_from_rig(x));
      constexpr double margin_px = 2;
      if (!pixel || !((pixel->array() > margin_px).all() && pixel->x() < width_px - 1 - margin_px &&
                      pixel->y() < height_px - 1 - margin_px))
        return false;
    }
  }
  return true;
}

}  // namespace

BundleProblem SyntheticCalibration::problem() const {
  BundleProblem out;
  out.targets.emplace_back();
  out.targets[0].name = "board";
  out.targets[0].points_m = target.points_m();
  out.targets[0].bending = target.bending();
  out.frames = static_cast<int>(truth.world_from_target.empty() ? 0 : truth.world_from_target[0].size());
  return out;
}

SyntheticCalibration synthetic_calibration(const SyntheticOptions& options) {
  SyntheticCalibration out;
  out.target.columns = 9;
  out.target.rows = 6;
  out.target.square_m = 0.025;
  Philox random(options.seed);
  std::vector<Camera> cameras;
  for (int c = 0; c < options.cameras; ++c)
    cameras.push_back(make_camera(c, lens_choice(options.lens), options.focal_px, random));
  BundleProblem board = out.problem();
  board.frames = options.frames;
  out.truth = empty_state(board, std::move(cameras));
  out.truth.bending_m[0] = options.bending_m;
  for (int f = 0; f < options.frames; ++f) {
    constexpr int most_trials = 100'000;
    int trial = 0;
    do {
      if (++trial > most_trials)
        throw Error(ErrorKind::numeric, "no place for the board that all cameras see");
      out.truth.world_from_target[0][static_cast<std::size_t>(f)] =
          held_board(out.target, options.focal_px, random);
    } while (!whole_in_every_image(board, out.truth, f));
  }
  return out;
}

Observations observe(const SyntheticCalibration& scene, double sigma_px, std::uint64_t seed) {
  Observations out;
  const BundleProblem board = scene.problem();
  Philox random(seed, 1);
  for (std::size_t c = 0; c < scene.truth.cameras.size(); ++c) {
    const Camera& camera = scene.truth.cameras[c];
    out.cameras.push_back({camera.name, camera.width_px, camera.height_px});
    for (std::size_t f = 0; f < scene.truth.world_from_target[0].size(); ++f) {
      const std::string frame = fmt::format("{:02}", f + 1);
      BoardView view{camera.name + frame, static_cast<int>(c), frame, {}};
      for (int i = 0; i < scene.target.size(); ++i) {
        const Eigen::Vector3d x =
            scene.truth.world_from_target[0][f] * target_point(board, scene.truth, 0, i);
        const Eigen::Vector2d noise(random.normal(), random.normal());
        view.corners.push_back({i, *project(camera, camera.camera_from_rig(x)) + sigma_px * noise});
      }
      out.views.push_back(std::move(view));
    }
  }
  return out;
}

}  // namespace bpms
