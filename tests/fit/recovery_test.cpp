// Noise-free leaves come back exactly; what is fitted survives the plant's text.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "fit/plant_assembly.h"
#include "fit/report.h"
#include "plant/leaf_frame.h"
#include "tests/data.h"
#include "tests/fit/leaf.h"

namespace bpms {
namespace {

using test::angles;
using test::arching_leaf;
using test::exactly;
using enum ErrorKind;

void expect_functions_agree(const OrganFit& fit, const SyntheticLeaf& leaf, double tolerance) {
  const auto compare = [&](const char* name, const std::unique_ptr<OrganFunction>& truth, double unit) {
    ASSERT_TRUE(fit.functions.contains(name)) << name;
    for (int k = 0; k <= 10; ++k)
      EXPECT_NEAR(fit.functions.at(name).value(k / 10.0), unit * truth->value(k / 10.0), tolerance * unit)
          << name << " " << k;
  };
  compare("inclination", leaf.organ.f_inclination, 1);
  compare("azimuth", leaf.organ.f_azimuth, 1);
  if (leaf.edge_points == 0) return;
  compare("twist", leaf.organ.f_twist, 1);
  compare("width", leaf.organ.f_width, leaf.organ.width_m);
}

TEST(Recovery, NoiseFreeLeavesOfEveryKind) {
  struct Case {
    const char* request;
    std::unique_ptr<OrganFunction> inclination, azimuth;
  };
  std::vector<Case> cases;
  cases.push_back(
      {"inclination=p:2,azimuth=p:1,twist=p:1,width=p:2", angles('p', {15, 40, 30}), angles('p', {-10, 20})});
  cases.push_back({"inclination=f:3,azimuth=f:1,twist=p:1,width=p:2", angles('f', {50, -30, 5, 3}),
                   angles('f', {0, 12})});
  cases.push_back({"inclination=n:4,azimuth=n:3,twist=p:1,width=p:2",
                   angles('n', {0, 10, 1.0 / 3, 25, 2.0 / 3, 60, 1, 110}),
                   angles('n', {0, -10, 0.5, 10, 1, -10})});
  cases.push_back({"inclination=s:5,azimuth=p:1,twist=p:1,width=p:2",
                   angles('s', {0, 10, 0.25, 20, 0.5, 60, 0.75, 80, 1, 130}), angles('p', {-8, 16})});
  for (Case& c : cases) {
    SyntheticLeaf leaf = arching_leaf();
    leaf.organ.f_inclination = std::move(c.inclination);
    leaf.organ.f_azimuth = std::move(c.azimuth);
    leaf.edge_points = 10;
    Philox random(3);
    const OrganFit fit = fit_organ(measure(leaf, {}, random), exactly(c.request));
    ASSERT_TRUE(fit.ok()) << c.request << fit.failure;
    EXPECT_NEAR(fit.length_m, leaf.organ.length_m, 1e-7) << c.request;
    EXPECT_NEAR(fit.direction, leaf.direction, 1e-6) << c.request;
    EXPECT_LT((fit.base_m - leaf.base_m).norm(), 1e-7) << c.request;
    expect_functions_agree(fit, leaf, 1e-6);
    EXPECT_LT(fit.rms_m, 1e-3);  // at equal arc length: chords are shorter than the leaf
  }
}

TEST(Recovery, AllDirectionsAndTallLeaves) {
  for (int k = 0; k < 12; ++k) {
    SyntheticLeaf leaf = arching_leaf();
    leaf.direction = radians(-180 + 30 * k + 1);
    leaf.organ.f_inclination = angles('p', {5.0 + k, 20.0 + 10 * k});
    Philox random(4, static_cast<std::uint64_t>(k));
    const OrganFit fit = fit_organ(measure(leaf, {}, random), exactly("inclination=p:1,azimuth=p:1"));
    ASSERT_TRUE(fit.ok()) << k << fit.failure;
    EXPECT_NEAR(fit.direction, leaf.direction, 1e-6) << k;
    expect_functions_agree(fit, leaf, 1e-6);
  }
}

TEST(Recovery, KnownDirectionKeepsTheMeanOfTheAzimuth) {
  SyntheticLeaf leaf = arching_leaf();
  leaf.organ.f_azimuth = angles('p', {5, 20});
  Philox random(5);
  FitOptions options = exactly("inclination=p:2,azimuth=p:1");
  options.direction = leaf.direction;
  const OrganFit fit = fit_organ(measure(leaf, {}, random), options);
  ASSERT_TRUE(fit.ok());
  expect_functions_agree(fit, leaf, 1e-6);
}

TEST(Recovery, AnUprightStemHasTwoAnglesFromTheVertical) {
  SyntheticLeaf stem = arching_leaf();
  stem.organ.f_inclination = angles('p', {2, -6});
  stem.organ.f_azimuth = angles('p', {-3, 4});
  stem.direction = 0;
  Philox random(6);
  MeasuredOrgan measured = measure(stem, {}, random);
  measured.organ = "stem";
  const OrganFit fit = fit_organ(measured, exactly("inclination=p:1,azimuth=p:1"));
  ASSERT_TRUE(fit.ok());
  expect_functions_agree(fit, stem, 1e-6);
}

TEST(Recovery, SwappedEdgesArePutRight) {
  SyntheticLeaf leaf = arching_leaf();
  leaf.edge_points = 8;
  Philox random(7);
  MeasuredOrgan measured = measure(leaf, {}, random);
  std::swap(measured.edge_left, measured.edge_right);
  const OrganFit fit = fit_organ(measured, exactly("inclination=p:2,azimuth=p:1,twist=p:1,width=p:2"));
  ASSERT_TRUE(fit.ok());
  EXPECT_TRUE(fit.edges_swapped);
  expect_functions_agree(fit, leaf, 1e-6);
}

TEST(Edges, DoNotBendTheMidribAndBadOnesAreLeftOut) {
  SyntheticLeaf leaf = arching_leaf();
  leaf.edge_points = 12;
  Philox random(16);
  MeasuredOrgan organ = measure(leaf, {.sigma_m = 2e-4}, random);
  MeasuredOrgan alone = organ;
  alone.edge_left.clear();
  alone.edge_right.clear();
  organ.edge_left[4].x_m.z() += 0.02;
  // A thick leaf: the edges lie 3 mm below the ruled surface; and one point of the sheath below the first of
  // the midrib.
  for (auto* edge : {&organ.edge_left, &organ.edge_right})
    for (VectorPoint& p : *edge) p.x_m.z() -= 0.003;
  organ.edge_right.insert(organ.edge_right.begin(), organ.edge_right[0]);
  organ.edge_right[0].point = 0;
  organ.edge_right[0].x_m = leaf.base_m + Eigen::Vector3d(0.003, 0.003, -0.03);
  const FitOptions options = exactly("inclination=p:2,azimuth=p:1,twist=p:1,width=p:2");
  const OrganFit fit = fit_organ(organ, options), midrib_only = fit_organ(alone, options);
  ASSERT_TRUE(fit.ok());
  EXPECT_EQ(fit.length_m, midrib_only.length_m);
  EXPECT_EQ(fit.functions.at("inclination").coefficients,
            midrib_only.functions.at("inclination").coefficients);
  EXPECT_THAT(fit.notes, ::testing::Contains(::testing::HasSubstr("edge points left out")));
  ASSERT_TRUE(fit.edge_chi2_per_dof.has_value());
  EXPECT_GT(*fit.edge_chi2_per_dof, 3);
  EXPECT_NEAR(fit.width_m, leaf.organ.width_m * 0.968,
              5 * fit.width_sigma_m + 0.002);  // the widest: 0.6 + 1.8^2 / 8.8
}

TEST(Plant, WhatIsWrittenRebuildsTheFittedMidribs) {
  std::vector<MeasuredOrgan> organs;
  for (int k = 0; k < 3; ++k) {
    SyntheticLeaf leaf = arching_leaf();
    leaf.direction = radians(120 * k);
    leaf.base_m = {0.001 * k, 0.002, 0.01};
    leaf.edge_points = 8;
    Philox random(8, static_cast<std::uint64_t>(k));
    organs.push_back(measure(leaf, {.sigma_m = 1e-3}, random));
    organs.back().rank = k + 1;
  }
  const std::vector<OrganFit> fits = fit_organs(organs, exactly("auto"));
  const FittedPlant fitted = assemble_plant("1", fits, {0, 1, 2}, {});
  const Plant read = parse_plant("written.bpms", plant_text(fitted.plant));
  EXPECT_EQ(plant_text(read), plant_text(fitted.plant));
  const std::vector<PlacedOrgan> placed = place_organs(read);
  ASSERT_EQ(placed.size(), 3u);
  for (std::size_t k = 0; k < 3; ++k) {
    std::vector<double> l;
    for (std::size_t i = 0; i < fits[k].fitted_m.size(); ++i)
      l.push_back(static_cast<double>(i) / static_cast<double>(fits[k].fitted_m.size() - 1));
    const std::vector<MidribPoint> rebuilt = midrib(*placed[k].attributes, l);
    for (std::size_t i = 0; i < l.size(); ++i) {
      const Eigen::Vector3d there = placed[k].plant_from_organ * rebuilt[i].x_m;
      EXPECT_LT((there - (fits[k].fitted_m[i] - fits[k].base_m)).norm(), 1e-9);
    }
    EXPECT_NEAR(placed[k].attributes->width_m * placed[k].attributes->f_width->value(0.5),
                fits[k].functions.at("width").value(0.5), 1e-9);
  }
  const Json report = fit_report(fits, {fitted});
  EXPECT_EQ(report["summary"]["failed"], 0);
  EXPECT_EQ(report["organs"][1]["id"], 1);
  // The base offsets are from the mean of the bases, which were 1 mm apart; the points are good to some
  // millimetres.
  EXPECT_NEAR(report["organs"][2]["base_offset_m"][0].get<double>(), 0.001, 0.005);
}

TEST(Plant, MeasuredBasesAreKept) {
  std::vector<MeasuredOrgan> organs;
  for (int k = 0; k < 3; ++k) {
    SyntheticLeaf leaf = arching_leaf();
    leaf.direction = radians(100 * k);
    leaf.base_m = {0.01 * k, 0.02, 0.03 * k - 0.02};
    Philox random(15, static_cast<std::uint64_t>(k));
    organs.push_back(measure(leaf, {}, random));
  }
  const std::vector<OrganFit> fits = fit_organs(organs, exactly("inclination=p:2,azimuth=p:1"));
  AssemblyOptions options;
  options.bud_m = Eigen::Vector3d(0, 0.01, 0.005);
  options.measured_bases = true;
  const FittedPlant fitted = assemble_plant("1", fits, {0, 1, 2}, options);
  EXPECT_EQ(fitted.origin_m, *options.bud_m);
  const Plant read = parse_plant("written.bpms", plant_text(fitted.plant));
  const std::vector<PlacedOrgan> placed = place_organs(read);
  for (std::size_t k = 0; k < 3; ++k) {
    const PlacedOrgan& organ = placed[static_cast<std::size_t>(fitted.ids[k])];
    EXPECT_EQ(organ.kind, OrganKind::leaf);
    const Eigen::Vector3d tip = organ.plant_from_organ * midrib(*organ.attributes, {1.0})[0].x_m;
    EXPECT_LT((fitted.origin_m + tip - fits[k].fitted_m.back()).norm(), 1e-9);
  }
}

TEST(Fit, WhatCannotBeFittedSaysWhy) {
  Philox random(9);
  SyntheticLeaf leaf = arching_leaf();
  leaf.midrib_points = 3;
  EXPECT_THAT(fit_organ(measure(leaf, {}, random), {}).failure, ::testing::HasSubstr("3 midrib points"));
  leaf.midrib_points = 6;
  MeasuredOrgan organ = measure(leaf, {}, random);
  for (VectorPoint& p : organ.midrib) p.x_m = organ.midrib[0].x_m;
  EXPECT_THAT(fit_organ(organ, {}).failure, ::testing::HasSubstr("1 midrib points in different places"));
  organ = measure(leaf, {}, random);
  organ.midrib[2].covariance_m2.setZero();
  BPMS_EXPECT_ERROR(fit_organ(organ, {}), bad_input, "has no covariance");
  organ.midrib[2].x_m.x() = std::nan("");
  BPMS_EXPECT_ERROR(fit_organ(organ, {}), bad_input, "not a number");
  EXPECT_THAT(fit_organ({}, {}).failure, ::testing::HasSubstr("0 midrib points"));
  const OrganFit failed = fit_organ({}, {});
  EXPECT_TRUE(fit_report({failed}, {})["organs"][0]["rms_m"].is_null());
}

TEST(Fit, FewPointsLowerTheOrder) {
  Philox random(10);
  SyntheticLeaf leaf = arching_leaf();
  leaf.midrib_points = 4;
  const OrganFit fit = fit_organ(measure(leaf, {}, random), exactly("p:5"));
  ASSERT_TRUE(fit.ok());
  EXPECT_LT(fit.functions.at("inclination").choice.order, 5);
  EXPECT_THAT(fit.notes, ::testing::Contains(::testing::HasSubstr("too few points")));
}

}  // namespace
}  // namespace bpms
