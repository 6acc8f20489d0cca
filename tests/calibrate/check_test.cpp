#include "calibrate/check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numeric>

#include "calibrate/adjustment/synthetic.h"
#include "calibrate/calibrate.h"
#include "calibrate/check_problem.h"
#include "core/random.h"
#include "core/units.h"
#include "tests/data.h"

namespace bpms {
namespace {

constexpr double noise_px = 0.1;
constexpr int calibration_frames = 25;

Observations frames_of(const Observations& all, int first, int count) {
  Observations out = all;
  std::erase_if(out.views, [&](const BoardView& view) {
    const int frame = std::stoi(view.frame);
    return frame < first || frame >= first + count;
  });
  return out;
}

// One pair of cameras: frames 1 to 25 calibrate it, those after are shots.
struct Bench {
  SyntheticCalibration scene;
  Rig rig;  // as calibrated: with errors of its own
  explicit Bench(int shots)
      : scene(synthetic_calibration({.frames = calibration_frames + shots, .seed = 4})) {
    rig = calibrate(frames_of(observe(scene, noise_px, 77), 1, calibration_frames), scene.target,
                    {.uncertainty = false})
              .rig;
    rig.residual_sigma_px = noise_px;  // p-values are to be exact
  }
};

// The true rig with errors drawn from the covariance of its calibration.
Rig drawn(const Rig& calibrated, const std::vector<Camera>& truth, Philox& random) {
  Rig out = calibrated;
  out.cameras = truth;
  const RigErrors errors = rig_errors_of(calibrated);
  Eigen::VectorXd z(errors.root.cols());
  for (double& x : z) x = random.normal();
  const Eigen::VectorXd d = errors.root * z;
  for (std::size_t i = 0; i < errors.rows.size(); ++i) {
    const RigErrors::Row& row = errors.rows[i];
    Camera& camera = out.cameras[static_cast<std::size_t>(row.camera)];
    const double by = d[static_cast<Eigen::Index>(i)];
    if (row.parameter >= 0)
      camera.parameters[static_cast<std::size_t>(row.parameter)] += by;
    else if (row.pose >= 3)
      camera.t_cam_from_rig_m[row.pose - 3] += by;
    else
      camera.r_cam_from_rig =
          rotation_from_vector(by * Eigen::Vector3d::Unit(row.pose)) * camera.r_cam_from_rig;
  }
  return out;
}

double kolmogorov_smirnov(std::vector<double> p) {
  std::sort(p.begin(), p.end());
  double out = 0;
  const auto n = static_cast<double>(p.size());
  for (std::size_t i = 0; i < p.size(); ++i)
    out = std::max({out, p[i] - static_cast<double>(i) / n, static_cast<double>(i + 1) / n - p[i]});
  return out * std::sqrt(n);
}
constexpr double ks_at_1_in_1000 = 1.95;  // of the limiting distribution

TEST(RigCheck, PValuesAreUniformWhenTheRigHolds) {
  constexpr int trials = 300;
  Bench bench(trials);
  // A rig ten times as uncertain as 25 frames leave it: its errors then count as much as the corners' noise
  // does, and p-values that forgot them would be far from uniform.
  bench.rig.covariance->matrix *= 100;
  Philox random(2);
  std::vector<double> whole, camera, scale;
  const Observations all = observe(bench.scene, noise_px, 31);
  for (int i = 0; i < trials; ++i) {
    const RigCheck c = check_rig(drawn(bench.rig, bench.scene.truth.cameras, random),
                                 frames_of(all, calibration_frames + 1 + i, 1), bench.scene.target);
    EXPECT_EQ(c.rig.dof, 2 * 2 * 54 - 6 - 2);
    whole.push_back(c.rig.p);
    camera.push_back(c.cameras[1].p);
    scale.push_back(c.scale->p);
  }
  for (const auto& [name, p] : {std::pair("rig", whole), {"camera", camera}, {"scale", scale}}) {
    const double ks = kolmogorov_smirnov(p);
    std::printf("%s: KS sqrt(n) D = %.3f, mean p %.3f\n", name, ks,
                std::accumulate(p.begin(), p.end(), 0.) / trials);
    EXPECT_LT(ks, ks_at_1_in_1000) << name;
  }
}

class RigCheckOfOneShot : public ::testing::Test {
 protected:
  RigCheckOfOneShot() : bench_(4) {}
  // What a shot of four frames says when the cameras are these.
  RigCheck check(const std::vector<Camera>& cameras, double square_m = 0.025) {
    SyntheticCalibration today = bench_.scene;
    today.truth.cameras = cameras;
    Target believed = bench_.scene.target;
    believed.square_m = square_m;
    return check_rig(bench_.rig, frames_of(observe(today, noise_px, 5), calibration_frames + 1, 4), believed);
  }
  std::vector<Camera> truth() const { return bench_.scene.truth.cameras; }
  Bench bench_;
};

TEST_F(RigCheckOfOneShot, HoldsWhenNothingChanged) {
  const RigCheck c = check(truth());
  EXPECT_TRUE(c.holds()) << c.rig.p;
  ASSERT_EQ(c.pairs.size(), 1u);
  // The noise of 216 corners, and the error of the calibrated rig, which is smaller.
  EXPECT_NEAR(c.pairs[0].rms_px, c.pairs[0].expected_px, 0.3 * c.pairs[0].expected_px);
  EXPECT_NEAR(c.scale->ratio, 1, 4 * c.scale->sigma);
  EXPECT_EQ(c.swapped, "");
}

TEST_F(RigCheckOfOneShot, FindsATurnedCamera) {
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<Camera> cameras = truth();
    cameras[1].r_cam_from_rig =
        rotation_from_vector(radians(0.1) * Eigen::Vector3d::Unit(axis)) * cameras[1].r_cam_from_rig;
    const RigCheck c = check(cameras);
    std::printf("0.1 degree about axis %d: p = %.2g\n", axis, c.rig.p);
    EXPECT_FALSE(c.rig.holds) << axis;
    for (const ChiSquareVerdict& camera : c.cameras) EXPECT_TRUE(camera.holds);  // its lens has not changed
  }
}

TEST_F(RigCheckOfOneShot, FindsAChangedFocalLength) {
  std::vector<Camera> cameras = truth();
  cameras[0].parameters[0] *= 1.002;
  cameras[0].parameters[1] *= 1.002;
  const RigCheck c = check(cameras);
  std::printf("focal length 0.2 %%: p = %.2g, cameras %.2g %.2g\n", c.rig.p, c.cameras[0].p, c.cameras[1].p);
  EXPECT_FALSE(c.rig.holds);
}

TEST_F(RigCheckOfOneShot, FindsAWrongSquare) {
  const RigCheck c = check(truth(), 0.0252);
  EXPECT_FALSE(c.holds());
  EXPECT_FALSE(c.scale->holds);
  EXPECT_NEAR(c.scale->ratio, 0.025 / 0.0252, 4 * c.scale->sigma);
}

TEST_F(RigCheckOfOneShot, FindsExchangedCameras) {
  Observations shot = frames_of(observe(bench_.scene, noise_px, 5), calibration_frames + 1, 2);
  std::swap(shot.cameras[0].name, shot.cameras[1].name);
  const RigCheck c = check_rig(bench_.rig, shot, bench_.scene.target);
  EXPECT_FALSE(c.holds());
  EXPECT_EQ(c.swapped, "cameraA and cameraB");
}

TEST_F(RigCheckOfOneShot, RefusesWhatDoesNotSuitTheRig) {
  Observations shot = frames_of(observe(bench_.scene, noise_px, 5), calibration_frames + 1, 1);
  Observations other = shot;
  other.cameras[1].name = "cameraC";
  BPMS_EXPECT_ERROR(check_rig(bench_.rig, other, bench_.scene.target), ErrorKind::bad_input,
                    "no camera 'cameraC'");
  other = shot;
  other.cameras[0].width_px = 320;
  BPMS_EXPECT_ERROR(check_rig(bench_.rig, other, bench_.scene.target), ErrorKind::bad_input, "320x480");
  Rig rig = bench_.rig;
  rig.residual_sigma_px = 0;
  BPMS_EXPECT_ERROR(check_rig(rig, shot, bench_.scene.target), ErrorKind::bad_input, "--corner-sigma");
}

// Upper tails from tables: 5 % points of 1, 10 and 100 degrees of freedom, and a closed form for 2.
TEST(RigCheck, TailOfChiSquare) {
  EXPECT_NEAR(chi_square_tail(3.841459, 1), 0.05, 1e-8);
  EXPECT_NEAR(chi_square_tail(18.307038, 10), 0.05, 1e-8);
  EXPECT_NEAR(chi_square_tail(124.342113, 100), 0.05, 1e-8);
  for (const double x : {0.1, 1.0, 7.0, 300.0})
    EXPECT_NEAR(chi_square_tail(x, 2) / std::exp(-x / 2), 1, 1e-12);
}

// The sample pairs: the rig from all frames but one holds in that one.
TEST(RigCheck, RealFramesLeftOut) {
  BPMS_NEED_DATA("calib_ref/corners_sub5.vnl");
  const Target target = parse_target("chessboard:9x6:25mm");
  const Observations all = read_corners(test::data_folder() + "/calib_ref/corners_sub5.vnl", 640, 480, 54);
  int held = 0, found = 0, shots = 0;
  for (const char* frame : {"01", "02", "03", "04", "05", "06", "07", "08", "09", "11", "12", "13", "14"}) {
    Observations rest = all, shot = all;
    std::erase_if(rest.views, [&](const BoardView& view) { return view.frame == frame; });
    std::erase_if(shot.views, [&](const BoardView& view) { return view.frame != frame; });
    const Rig calibrated = calibrate(rest, target).rig;
    const RigCheck c = check_rig(calibrated, shot, target);
    std::printf("frame %s: chi2 %.1f of %d, p = %.3g, scale %.5f +- %.5f\n", frame, c.rig.chi2, c.rig.dof,
                c.rig.p, c.scale->ratio, c.scale->sigma);
    held += c.holds();
    // The right camera knocked by half a degree since: 4.7 px. 0.1 degree passes here in most shots: the
    // errors that frames of this set have in common are as large, and one chi-square of 208 degrees is blunt.
    Rig knocked = calibrated;
    knocked.cameras[1].r_cam_from_rig =
        rotation_from_vector(radians(0.5) * Eigen::Vector3d::UnitX()) * knocked.cameras[1].r_cam_from_rig;
    const RigCheck after = check_rig(knocked, shot, target);
    std::printf("  knocked by 0.5 degree: p = %.2g\n", after.rig.p);
    found += !after.holds();
    ++shots;
  }
  EXPECT_EQ(held, shots);
  EXPECT_EQ(found, shots);
}

}  // namespace
}  // namespace bpms
