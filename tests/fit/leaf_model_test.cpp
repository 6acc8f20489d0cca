#include "fit/leaf_model.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "core/units.h"
#include "plant/leaf_frame.h"

namespace bpms {
namespace {

TEST(FunctionBasis, IsOrthonormalAndStartsWithTheConstant) {
  for (const FunctionChoice choice : {FunctionChoice{'p', 5}, {'f', 4}, {'n', 5}, {'s', 6}, {'p', 0}}) {
    const FunctionBasis basis(choice, true);
    constexpr int steps = 20000;
    Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(basis.size(), basis.size());
    Eigen::VectorXd phi(basis.size());
    for (int k = 0; k < steps; ++k) {
      basis.values((k + 0.5) / steps, phi.data());
      gram += phi * phi.transpose() / steps;
      EXPECT_NEAR(phi[0], 1, 1e-12);
    }
    // The midpoint rule with 20000 steps is good to about 1e-8.
    EXPECT_LT((gram - Eigen::MatrixXd::Identity(basis.size(), basis.size())).cwiseAbs().maxCoeff(), 1e-6)
        << choice.str();
    EXPECT_EQ(FunctionBasis(choice, false).size(), basis.size() - 1);
  }
}

LeafModel bent_model(Eigen::VectorXd& parameters) {
  LeafModelShape shape;
  shape.inclination = FunctionBasis({'s', 4}, true);
  shape.azimuth = FunctionBasis({'n', 3}, false);
  shape.twist = FunctionBasis({'p', 1}, true);
  shape.width = FunctionBasis({'f', 2}, true);
  shape.base_axes = {0, 1, 2};
  LeafModel model(shape);
  parameters.resize(model.parameters());
  parameters << 0.9, 0.4, 0.1, -0.2, 0.3, 0.8, 0.5, -0.2, 0.1, 0.2, -0.1, 0.3, 0.4, 0.1, 0.03, 0.02;
  return model;
}

TEST(LeafModel, DerivativesAgreeWithDifferences) {
  Eigen::VectorXd parameters;
  LeafModel model = bent_model(parameters);
  constexpr double step = 1e-6;
  for (const LeafCurve curve : {LeafCurve::midrib, LeafCurve::edge_left, LeafCurve::edge_right}) {
    for (const double l : {0.0, 0.13, 0.5, 0.77, 1.0}) {
      LeafModel::Point at, high, low;
      model.set(parameters, true);
      model.point(curve, l, true, at);
      for (Eigen::Index k = 0; k < parameters.size(); ++k) {
        Eigen::VectorXd changed = parameters;
        changed[k] += step;
        model.set(changed, false);
        model.point(curve, l, false, high);
        changed[k] -= 2 * step;
        model.set(changed, false);
        model.point(curve, l, false, low);
        // Central differences: error of order step^2 and 1e-16 / step.
        EXPECT_LT((at.jacobian.col(k) - (high.x - low.x) / (2 * step)).norm(), 1e-8)
            << "parameter " << k << " l " << l;
      }
      if (l > 0 && l < 1 && l != 0.5) {  // at the knot the edge has a corner
        model.set(parameters, false);
        model.point(curve, l + step, false, high);
        model.point(curve, l - step, false, low);
        EXPECT_LT((at.tangent - (high.x - low.x) / (2 * step)).norm(), 1e-6);
      }
    }
  }
}

TEST(LeafModel, AgreesWithTheGeometryOfThePlant) {
  Eigen::VectorXd parameters;
  LeafModel model = bent_model(parameters);
  model.set(parameters, false);
  OrganAttributes organ;
  const auto function = [&](const FunctionBasis& basis, int at) {
    return basis.function(degrees(1) * (basis.transform() * parameters.segment(at, basis.size())),
                          radians(1));
  };
  organ.length_m = parameters[0];
  organ.f_inclination = function(model.shape().inclination, model.at_inclination());
  organ.f_azimuth = function(model.shape().azimuth, model.at_azimuth());
  organ.f_twist = function(model.shape().twist, model.at_twist());
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(parameters[1], Eigen::Vector3d::UnitZ()).toRotationMatrix();
  for (const MidribPoint& p : midrib(organ, {0, 0.2, 0.5, 0.9, 1})) {
    LeafModel::Point ours, edge;
    model.point(LeafCurve::midrib, p.l, false, ours);
    model.point(LeafCurve::edge_left, p.l, false, edge);
    // plant/leaf_frame.h promises 1e-9 of the length.
    EXPECT_LT((ours.x - parameters.segment<3>(2) - turn * p.x_m).norm(), 1e-9);
    EXPECT_LT((edge.x - ours.x).normalized().cross(turn * p.frame.col(1)).norm(), 1e-12);
  }
}

}  // namespace
}  // namespace bpms
