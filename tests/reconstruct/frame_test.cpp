#include "reconstruct/points/frame.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/data.h"
#include "tests/reconstruct/synthetic.h"

namespace bpms {
namespace {

TEST(Frame, UprightIsARotationWithUpOnTop) {
  Philox random(80);
  for (int trial = 0; trial < 100; ++trial) {
    const Eigen::Vector3d up(random.normal(), random.normal(), random.normal());
    const Eigen::Matrix3d r = upright(up);
    EXPECT_LT((r * r.transpose() - Eigen::Matrix3d::Identity()).norm(), 1e-14);
    EXPECT_NEAR(r.determinant(), 1, 1e-14);
    EXPECT_LT((r * up.normalized() - Eigen::Vector3d::UnitZ()).norm(), 1e-14);
  }
  // A level rig: x right stays x, y down becomes -z, z forward becomes y.
  Eigen::Matrix3d level;
  level << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  EXPECT_LT((upright({0, -3, 0}) - level).norm(), 1e-15);
  // Up along the rig's x: its z is what is made horizontal.
  EXPECT_LT((upright({1, 0, 0}) * Eigen::Vector3d::UnitZ() - Eigen::Vector3d::UnitX()).norm(), 1e-15);
}

TEST(Frame, PointsAndCovariancesTurnTogether) {
  Frame frame;
  frame.rotation = upright({0.1, -1, 0.2});
  frame.origin_m = {0.3, 0.2, 1.4};
  VectorPoint p;
  p.x_m = {0.1, 0.4, 1.5};
  p.covariance_m2 << 2e-6, 1e-7, 3e-7, 1e-7, 3e-6, -2e-7, 3e-7, -2e-7, 9e-6;
  const VectorPoint out = frame(p);
  // Mahalanobis distances from the origin do not depend on the frame.
  const Eigen::Vector3d before = p.x_m - frame.origin_m;
  EXPECT_NEAR(out.x_m.dot(out.covariance_m2.ldlt().solve(out.x_m)),
              before.dot(p.covariance_m2.ldlt().solve(before)), 1e-4);
  EXPECT_EQ(out.covariance_m2, out.covariance_m2.transpose());
  EXPECT_LT(frame.point(frame.origin_m).norm(), 1e-15);
}

TEST(Frame, UpOfTheImagesIsAgainstTheirY) {
  EXPECT_LT((image_up(test::parallel_rig()) + Eigen::Vector3d::UnitY()).norm(), 1e-15);
}

Vectors labelled() {
  const Rig rig = test::parallel_rig();
  std::vector<ImagePoint> rows;
  const auto add = [&](const std::string& organ, int point, const std::vector<Sighting>& sightings) {
    for (ImagePoint p : test::image_points(rig, point, sightings)) {
      p.label.organ = organ;
      rows.push_back(p);
    }
  };
  add("bud", 1, test::sight(rig, {0.01, 0.02, 1.5}, 0.5, nullptr));
  add("leaf", 1, test::sight(rig, {0, 0, 1.5}, 0.5, nullptr));
  add("leaf", 2, test::sight(rig, {0, 0, 1.4}, 0.5, nullptr));
  add("head", 1, {{0, {800, 600}, 0.5}});
  return reconstruct(rows, rig);
}

TEST(Frame, OriginIsTheOneLabelledPoint) {
  const Vectors vectors = labelled();
  EXPECT_LT((labelled_origin("organ=bud", vectors) - Eigen::Vector3d(0.01, 0.02, 1.5)).norm(), 1e-10);
  EXPECT_LT((labelled_origin("organ=leaf,point=2", vectors) - Eigen::Vector3d(0, 0, 1.4)).norm(), 1e-10);
  using enum ErrorKind;
  BPMS_EXPECT_ERROR(labelled_origin("organ=leaf", vectors), bad_input,
                    "midrib point 1 and plant 1 axis 1 rank 1 leaf midrib point 2");
  BPMS_EXPECT_ERROR(labelled_origin("organ=stem", vectors), bad_input, "--origin organ=stem: no point fits");
  BPMS_EXPECT_ERROR(labelled_origin("organ=head", vectors), bad_input, "was refused: seen in one image only");
  BPMS_EXPECT_ERROR(labelled_origin("orgn=bud", vectors), bad_input,
                    "unknown key 'orgn'; did you mean 'organ'?");
  BPMS_EXPECT_ERROR(labelled_origin("bud", vectors), bad_input, "expected KEY=VALUE");
}

}  // namespace
}  // namespace bpms
