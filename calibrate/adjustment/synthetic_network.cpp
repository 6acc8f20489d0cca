#include "calibrate/adjustment/synthetic_network.h"

#include <Eigen/Geometry>

#include "calibrate/lenses/lens.h"
#include "core/random.h"
#include "core/units.h"

namespace bpms {
namespace {

constexpr int network_width_px = 640, network_height_px = 480;
constexpr double network_focal_px = 535;
constexpr double box_m = 0.6, tag_m = 0.08;

Camera network_camera(int index, const std::string& lens, Philox& random) {
  Camera camera;
  const LensChoice& choice = lens_choice(lens);
  camera.name = fmt::format("camera{}", static_cast<char>('A' + index));
  camera.model = choice.model;
  camera.constants = choice.constants;
  camera.width_px = network_width_px;
  camera.height_px = network_height_px;
  camera.parameters = {network_focal_px, network_focal_px + 1, 322, 241, -0.2, 0.05, 0.0008, -0.0005, 0.01};
  for (std::size_t i = 0; i < 4; ++i) camera.parameters[i] += random.uniform(-5, 5);
  camera.parameters.resize(static_cast<std::size_t>(choice.parameters));
  if (index > 0) {
    constexpr double apart_m = 0.12;
    const Eigen::Vector3d turn(0.02 * random.normal(), 0.05 * index, 0.02 * random.normal());
    camera.r_cam_from_rig = rotation_from_vector(turn);
    camera.t_cam_from_rig_m = {-apart_m * index, 0.002 * random.normal(), 0.002 * random.normal()};
  }
  return camera;
}

NetworkTarget flat_board(int index) {
  Target board;
  board.columns = 9, board.rows = 6, board.square_m = 0.025;
  NetworkTarget out;
  out.name = fmt::format("board {}", index + 1);
  out.points_m = board.points_m();
  out.bending = board.bending();
  return out;
}

// Tags on the floor and two walls of a box.
NetworkTarget tag_box() {
  NetworkTarget out;
  out.name = "frame";
  out.stands = true;
  for (int wall = 0; wall < 3; ++wall) {
    for (int k = 0; k < 4; ++k) {
      const double u = (k % 2 ? 0.65 : 0.1) * box_m, v = (k / 2 ? 0.65 : 0.1) * box_m;
      for (const auto& [du, dv] : {std::pair(0.0, 0.0), {tag_m, 0.0}, {tag_m, tag_m}, {0.0, tag_m}}) {
        Eigen::Vector3d x = Eigen::Vector3d::Zero();
        x[wall] = u + du, x[(wall + 1) % 3] = v + dv;
        out.points_m.push_back(x);
      }
    }
  }
  return out;
}

// Looks at the box from above its open sides.
Pose carried_rig(Philox& random) {
  const double azimuth = random.uniform(0.15, 1.4), height = random.uniform(0.3, 1.1);
  const Eigen::Vector3d towards(std::cos(azimuth) * std::cos(height), std::sin(azimuth) * std::cos(height),
                                std::sin(height));
  const Eigen::Vector3d centre = 0.35 * box_m * Eigen::Vector3d::Ones();
  const Eigen::Vector3d eye = centre + random.uniform(1.0, 1.6) * towards;
  Eigen::Matrix3d r;
  r.row(2) = -towards.transpose();
  r.row(0) = towards.cross(Eigen::Vector3d::UnitZ()).normalized().transpose();
  r.row(1) = r.row(2).cross(r.row(0));
  r = Eigen::AngleAxisd(random.uniform(-0.8, 0.8), Eigen::Vector3d::UnitZ()).toRotationMatrix() * r;
  const Pose out{r, -r * eye};
  return Pose{Eigen::Matrix3d::Identity(), {0.05 * random.normal(), 0.05 * random.normal(), 0}} * out;
}

Pose board_before_rig(Philox& random) {
  const double tilt = radians(random.uniform(10, 45)), towards = random.uniform(0, 2 * pi);
  const Eigen::Vector3d axis(std::cos(towards), std::sin(towards), 0);
  const Eigen::Matrix3d r = (Eigen::AngleAxisd(tilt, axis) *
                             Eigen::AngleAxisd(radians(random.uniform(-25, 25)), Eigen::Vector3d::UnitZ()))
                                .toRotationMatrix();
  const double z = random.uniform(0.4, 0.8);
  const Eigen::Vector3d centre(z * random.uniform(-0.3, 0.45), z * random.uniform(-0.25, 0.25), z);
  return {r, centre - r * Eigen::Vector3d(0.1, 0.0625, 0)};
}

bool inside(const Camera& camera, const Eigen::Vector2d& pixel) {
  constexpr double margin_px = 2;
  return (pixel.array() > margin_px).all() && pixel.x() < camera.width_px - 1 - margin_px &&
         pixel.y() < camera.height_px - 1 - margin_px;
}

void see(SyntheticNetwork& network) {
  BundleProblem& problem = network.problem;
  constexpr int fewest = 8;  // corners of a view
  int view = 0;
  for (int f = 0; f < problem.frames; ++f) {
    for (int c = 0; c < static_cast<int>(network.truth.cameras.size()); ++c) {
      const Camera& camera = network.truth.cameras[static_cast<std::size_t>(c)];
      for (int t = 0; t < static_cast<int>(problem.targets.size()); ++t) {
        const Pose place = rig_from_target(problem, network.truth, t, f);
        std::vector<CornerObservation> corners;
        for (int i = 0; i < static_cast<int>(problem.targets[static_cast<std::size_t>(t)].points_m.size());
             ++i) {
          const auto pixel =
              project(camera, camera.camera_from_rig(place * target_point(problem, network.truth, t, i)));
          if (pixel && inside(camera, *pixel)) corners.push_back({view, f, c, t, i, *pixel});
        }
        if (static_cast<int>(corners.size()) < fewest) continue;
        problem.corners.insert(problem.corners.end(), corners.begin(), corners.end());
        ++view;
      }
    }
  }
}

Eigen::Vector3d normal_vector(Philox& random) {
  const double x = random.normal(), y = random.normal(), z = random.normal();
  return {x, y, z};
}

}  // namespace

std::vector<Observations::ObservedCamera> SyntheticNetwork::cameras() const {
  std::vector<Observations::ObservedCamera> out;
  for (const Camera& camera : truth.cameras) out.push_back({camera.name, camera.width_px, camera.height_px});
  return out;
}

Observations NetworkMeasurement::observations() const {
  Observations out;
  for (const Camera& camera : truth.cameras)
    out.cameras.push_back({camera.name, camera.width_px, camera.height_px});
  for (const CornerObservation& corner : problem.corners) {
    const auto view = static_cast<std::size_t>(corner.view);
    if (out.views.size() <= view) {
      const std::string frame = fmt::format("{:04}", corner.frame + 1);
      const std::string& camera = out.cameras[static_cast<std::size_t>(corner.camera)].name;
      out.views.push_back({camera + frame, corner.camera, frame, {}, corner.target});
    }
    out.views[view].corners.push_back({corner.point, corner.pixel});
  }
  return out;
}

SyntheticNetwork synthetic_network(const SyntheticNetworkOptions& options) {
  SyntheticNetwork out;
  Philox random(options.seed);
  BundleProblem& problem = out.problem;
  problem.frames = options.frames;
  const bool table = options.table_step_rad != 0;
  problem.rig_moves = options.rig_moves || table;
  for (int f = 0; table && f < options.frames; ++f)
    problem.table_angles.push_back(f * options.table_step_rad);
  for (int k = 0; k < options.held_boards; ++k) problem.targets.push_back(flat_board(k));
  const std::size_t box = problem.targets.size();
  if (options.control_frame) {
    problem.targets.push_back(tag_box());
    NetworkTarget& target = problem.targets.back();
    target.known = options.known;
    problem.datum = static_cast<int>(box);
    if (options.known == PointsKnown::surveyed)
      target.covariance_m2.assign(target.points_m.size(),
                                  std::pow(options.survey_sigma_m, 2) * Eigen::Matrix3d::Identity());
    for (int k = 0; k < options.scale_bars; ++k) {
      const int a = k % 48, b = (k + 21) % 48;
      target.bars.push_back(
          {a, b,
           (target.points_m[static_cast<std::size_t>(a)] - target.points_m[static_cast<std::size_t>(b)])
               .norm(),
           options.survey_sigma_m});
    }
  }
  std::vector<Camera> cameras;
  for (int c = 0; c < options.cameras; ++c) cameras.push_back(network_camera(c, options.lens, random));
  out.truth = empty_state(problem, std::move(cameras));
  if (table) {
    // The axis leans a little towards the cameras, the board is tilted by 40 degrees beside it.
    out.truth.rig_from_world[0] = {rotation_from_vector({radians(105.0), 0, 0.03}), {-0.1, 0.1, 0.9}};
    problem.targets[0].stands = true;
    out.truth.world_from_target[0] = {{rotation_from_vector({radians(50.0), 0, 0}), {-0.1, 0.05, 0.03}}};
  }
  for (int f = 0; !table && f < options.frames; ++f) {
    const auto at = static_cast<std::size_t>(f);
    if (options.rig_moves) out.truth.rig_from_world[at] = carried_rig(random);
    for (std::size_t t = 0; t < box; ++t) {
      const Pose before = board_before_rig(random);
      out.truth.world_from_target[t][at] =
          options.rig_moves ? out.truth.rig_from_world[at].inverse() * before : before;
    }
  }
  if (options.control_frame && !problem.rig_moves) out.truth.world_from_target[box][0] = carried_rig(random);
  for (std::size_t t = 0; t < box; ++t) out.truth.bending_m[t] = {0.05e-3, -0.1e-3};
  see(out);
  return out;
}

NetworkMeasurement measured(const SyntheticNetwork& network, double sigma_px, std::uint64_t seed) {
  NetworkMeasurement out{network.problem, network.truth};
  Philox random(seed, 1);
  for (CornerObservation& corner : out.problem.corners) {
    const Eigen::Vector2d noise(random.normal(), random.normal());
    corner.pixel += sigma_px * noise;
  }
  for (std::size_t t = 0; t < out.problem.targets.size(); ++t) {
    NetworkTarget& target = out.problem.targets[t];
    for (ScaleBar& bar : target.bars) {
      const double error = random.normal();
      if (sigma_px > 0) bar.length_m += bar.sigma_m * error;
    }
    for (std::size_t i = 0; target.known != PointsKnown::exact && i < target.points_m.size(); ++i) {
      constexpr double roughly_m = 2e-3;  // how well the shape of a free frame is known
      const double sigma =
          target.known == PointsKnown::surveyed ? std::sqrt(target.covariance_m2[i](0, 0)) : roughly_m;
      const Eigen::Vector3d error = sigma_px > 0 || target.known != PointsKnown::surveyed
                                        ? (sigma * normal_vector(random)).eval()
                                        : Eigen::Vector3d::Zero();
      target.points_m[i] += error;
      out.truth.shifts_m[t][i] = -error;
    }
  }
  return out;
}

}  // namespace bpms
