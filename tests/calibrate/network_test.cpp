// Networks of every kind against a known truth, without noise: from nothing to the exact answer.
#include <gtest/gtest.h>

#include "tests/calibrate/errors.h"
#include "tests/calibrate/solved_network.h"

namespace bpms {
namespace {

struct NetworkCase {
  const char* name;
  SyntheticNetworkOptions options;
};
class NoiseFreeNetwork : public ::testing::TestWithParam<NetworkCase> {};

TEST_P(NoiseFreeNetwork, IsFoundFromNothing) {
  const SyntheticNetwork network = synthetic_network(GetParam().options);
  const NetworkMeasurement measurement = measured(network, 0, 1);
  const test::SolvedNetwork solved = test::solve(network, measurement.problem);
  // What was surveyed or measured with a bar is exact here; the datum of free points turns nothing in the
  // rig.
  EXPECT_LT(solved.equations.rms_px(), 1e-8);
  const Eigen::VectorXd off = test::errors(solved.state.cameras, network.truth.cameras);
  for (Eigen::Index i = 0; i < off.size(); ++i)
    EXPECT_LT(std::abs(off[i]), 1e-6) << solved.equations.order[static_cast<std::size_t>(i)];
  for (const CornerObservation& corner : solved.problem.corners) EXPECT_TRUE(corner.used);
  if (GetParam().options.table_step_rad != 0) {
    const TurntableAxis found = turntable_axis(solved.state.rig_from_world[0]),
                        true_axis = turntable_axis(network.truth.rig_from_world[0]);
    EXPECT_LT((found.direction - true_axis.direction).norm(), 1e-8);
    EXPECT_LT((found.point_m - true_axis.point_m).norm(), 1e-8);
  }
  if (!GetParam().options.rig_moves || GetParam().options.known == PointsKnown::free) return;
  for (std::size_t f = 0; f < network.truth.rig_from_world.size(); ++f) {
    EXPECT_LT((solved.state.rig_from_world[f].t_m - network.truth.rig_from_world[f].t_m).norm(), 1e-7);
    EXPECT_LT((solved.state.rig_from_world[f].r - network.truth.rig_from_world[f].r).norm(), 1e-7);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Kinds, NoiseFreeNetwork,
    ::testing::Values(
        NetworkCase{"TwoBoardsHeld", {.held_boards = 2}},
        NetworkCase{"FourCamerasPartlySeen", {.cameras = 4, .frames = 25}},
        NetworkCase{"CarriedAroundAFrame", {.rig_moves = true, .held_boards = 0, .control_frame = true}},
        NetworkCase{"OneCameraCarried",
                    {.cameras = 1, .rig_moves = true, .held_boards = 0, .control_frame = true}},
        NetworkCase{"CarriedWithABoardHeld", {.rig_moves = true, .control_frame = true}},
        NetworkCase{"StandingBeforeAFrameAndABoard", {.control_frame = true}},
        NetworkCase{
            "SurveyedFrame",
            {.rig_moves = true, .held_boards = 0, .control_frame = true, .known = PointsKnown::surveyed}},
        NetworkCase{"Turntable", {.frames = 12, .table_step_rad = 0.12}},
        NetworkCase{"TurntableAllTheWayRound", {.frames = 24, .table_step_rad = 0.26}},
        NetworkCase{"TurntableTheOtherWay", {.cameras = 1, .frames = 12, .table_step_rad = -0.12}},
        NetworkCase{"FreeFrameWithBars",
                    {.rig_moves = true,
                     .held_boards = 0,
                     .control_frame = true,
                     .known = PointsKnown::free,
                     .scale_bars = 4}}),
    [](const auto& of) { return of.param.name; });

// Where no target ties a camera to the others there is no relative pose, and it is said which.
TEST(Network, SaysWhichCameraIsApart) {
  const SyntheticNetwork network = synthetic_network({.cameras = 3});
  BundleProblem problem = network.problem;
  for (CornerObservation& corner : problem.corners)
    if (corner.camera == 2) corner.frame += problem.frames;
  problem.frames *= 2;
  try {
    initial_estimate(problem, network.cameras(), lens_choice("brown4"));
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("cameraC"), std::string::npos) << error.what();
  }
}

// A frame in which a carried rig sees only a board that nothing else places: it is set aside, not guessed.
TEST(Network, SetsFramesAsideThatNothingPlaces) {
  const SyntheticNetwork network = synthetic_network({.rig_moves = true, .control_frame = true});
  BundleProblem problem = network.problem;
  std::erase_if(problem.corners, [](const CornerObservation& c) { return c.frame == 3 && c.target == 1; });
  const test::SolvedNetwork solved = test::solve(network, problem);
  for (const CornerObservation& corner : solved.problem.corners) {
    EXPECT_EQ(corner.placed, corner.frame != 3) << corner.frame;
    EXPECT_EQ(corner.used, corner.frame != 3) << corner.frame;
  }
  EXPECT_LT(solved.equations.rms_px(), 1e-8);
}

}  // namespace
}  // namespace bpms
