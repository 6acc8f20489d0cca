// The structure report of scenes whose structure is known.
#include "scene/structure/structure.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/csv.h"
#include "core/random.h"
#include "core/units.h"
#include "plant/plant_mesh.h"
#include "scene/geometry/random_discs.h"
#include "scene/importers/plants.h"
#include "scene/structure/facets.h"
#include "scene/structure/structure_report.h"

namespace bpms {
namespace {

StructureOptions with_rays(std::uint32_t rays) {
  StructureOptions out;
  out.gaps.rays = rays;
  return out;
}

TEST(Structure, OfRandomDiscsIsWhatTheyWereMadeWith) {
  RandomDiscs what;
  what.lai = 3;
  what.size_m = {10, 10};
  what.angles = LeafAngles::planophile;
  what.bottom_m = 0.05;
  const Scene scene = random_disc_scene(what);
  const CanopyStructure structure = canopy_structure(scene, with_rays(1u << 13));
  EXPECT_NEAR(structure.lai, 3, 1e-3);
  EXPECT_EQ(structure.lai, structure.pai);
  EXPECT_NEAR(structure.height_m, 2, 0.06);
  const double n = static_cast<double>(scene.prototypes[0].discs.size());
  const FacetOrientation& leaves = structure.surface.leaves;
  EXPECT_NEAR(degrees(leaves.mean_inclination()), 26.76, 4 * 18.50 / std::sqrt(n));
  for (const double zenith : {0.0, 0.7, 1.5})
    EXPECT_NEAR(leaves.g(zenith), g_function(what.angles, zenith), 4 * 0.4 / std::sqrt(n));
  EXPECT_NEAR(structure.surface.materials.at("leaf").leaf_m2, 300, 0.1);
  // The centres lie evenly between bottom and top: so does the leaf area, but for half a radius.
  const HeightProfile& profile = structure.surface.leaf_profile;
  double sum = 0;
  for (std::size_t k = 0; k < profile.layers(); ++k) sum += profile.area(k);
  EXPECT_NEAR(sum, structure.surface.leaf_area_m2, 1e-9 * sum);
  for (std::size_t k = 1; k + 1 < profile.layers(); ++k)
    EXPECT_NEAR(profile.area(k) / sum, (profile.border(k + 1) - profile.border(k)) / 1.95,
                4 * std::sqrt(0.05 / n) + 1e-4);
  for (const Clumping& row : structure.clumping)
    EXPECT_NEAR(row.leaves->value, 1, 0.1) << row.zenith_deg;  // one canopy's own spread
}

// Upright cylinders and discs, both placed at random: the whole is random too, with the areas and G of both.
TEST(Structure, ClumpingOfRandomLeavesAndStemsIsOneForEach) {
  constexpr int canopies = 12;
  const std::vector<double> zenith_deg{0, 30, 57.5};
  std::vector<double> leaves(3), plant(3), leaves2(3), plant2(3);
  for (int c = 0; c < canopies; ++c) {
    RandomDiscs what;
    what.lai = 1;
    what.size_m = {6, 6};
    what.bottom_m = what.radius_m;
    what.seed = 40 + static_cast<std::uint64_t>(c);
    Scene scene = random_disc_scene(what);
    Philox random(what.seed, 9);
    for (int k = 0; k < 500; ++k) {
      const double x = random.uniform(-3, 3), y = random.uniform(-3, 3);
      scene.prototypes[0].shapes.push_back(cylinder({x, y, 0}, {x, y, 1}, 0.02, 0.02));
    }
    StructureOptions options = with_rays(1u << 13);
    options.zenith_deg = zenith_deg;
    const CanopyStructure structure = canopy_structure(scene, options);
    // Half of a closed cylinder's surface: pi r (l + r).
    EXPECT_NEAR(structure.pai - structure.lai, 500 * pi * 0.02 * 1.02 / 36, 1e-6);
    ASSERT_EQ(structure.clumping.size(), 3u);
    for (std::size_t k = 0; k < 3; ++k) {
      const double l = structure.clumping[k].leaves->value, p = structure.clumping[k].plant->value;
      leaves[k] += l / canopies, leaves2[k] += l * l / canopies;
      plant[k] += p / canopies, plant2[k] += p * p / canopies;
    }
  }
  for (std::size_t k = 0; k < 3; ++k) {
    const auto se = [&](double mean, double squares) {
      return std::sqrt((squares - mean * mean) / (canopies - 1));
    };
    EXPECT_NEAR(leaves[k], 1, 4 * se(leaves[k], leaves2[k])) << k;
    EXPECT_NEAR(plant[k], 1, 4 * se(plant[k], plant2[k])) << k;
    EXPECT_LT(se(plant[k], plant2[k]), 0.02);
  }
}

TEST(Structure, ClumpingHalvesWhenEveryLeafIsHiddenByAnother) {
  // The same leaves once more in the same places: twice the leaf area behind the same gaps.
  RandomDiscs what;
  what.size_m = {4, 4};
  Scene scene = random_disc_scene(what);
  const CanopyStructure once = canopy_structure(scene, with_rays(1u << 12));
  scene.instances.push_back(scene.instances[0]);
  const CanopyStructure twice = canopy_structure(scene, with_rays(1u << 12));
  ASSERT_EQ(once.clumping.size(), twice.clumping.size());
  ASSERT_GT(once.clumping.size(), 5u);
  for (std::size_t k = 0; k < once.clumping.size(); ++k)
    EXPECT_NEAR(twice.clumping[k].leaves->value, 0.5 * once.clumping[k].leaves->value,
                0.01 * once.clumping[k].leaves->value);
  EXPECT_NEAR(twice.lai, 2 * once.lai, 1e-9);
}

Scene many_plants(std::size_t count) {
  Scene scene;
  scene.domain.size_m = {4, 4};
  MaterialNames names(scene);
  scene.prototypes.push_back(
      plant_prototype(read_plant(std::string(BPMS_SOURCE_DIR) + "/examples/plants/grass.bpms"), "grass", "",
                      nullptr, {}, names));
  Philox random(4);
  for (std::size_t k = 0; k < count; ++k)
    scene.instances.push_back({0,
                               {random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(0, 0.1)},
                               2 * pi * random.uniform(),
                               random.uniform(0.5, 1.5)});
  return scene;
}

// Prototypes summed once and then placed, against facets that are looked at one by one.
TEST(SurfaceSums, OfManyInstancesAreThoseOfTheirFacets) {
  Scene scene = many_plants(60);
  scene.instances[7].rotation = Rotation::about_axes(1, 0.4, 0.2);
  const double height = 1;
  const SurfaceSums one = surface_sums(scene, {}, {.height_m = height, .layers = 10});
  const SurfaceSums all =
      surface_sums(scene, {}, {.height_m = height, .layers = 10, .most_turned = 0, .most_raised = 0});
  EXPECT_NEAR(all.leaf_area_m2, one.leaf_area_m2, 1e-9);
  EXPECT_NEAR(all.stem_area_m2, one.stem_area_m2, 1e-9);
  EXPECT_GT(one.stem_area_m2, 0);
  EXPECT_NEAR(one.leaves.area(), one.leaf_area_m2, 1e-6 * one.leaf_area_m2);
  EXPECT_NEAR(all.leaves.area(), one.leaf_area_m2, 1e-6 * one.leaf_area_m2);
  for (const double zenith : {0.0, 0.6, 1.2}) {
    EXPECT_NEAR(all.leaf_g(zenith), one.leaf_g(zenith), 1e-4);
    EXPECT_NEAR(all.plant_g(zenith), one.plant_g(zenith), 1e-4);
    // Turns in steps of 2 degrees.
    for (const double azimuth : {0.3, 2.0})
      EXPECT_NEAR(all.leaf_g(zenith, azimuth), one.leaf_g(zenith, azimuth), 2e-3);
  }
  for (std::size_t k = 0; k < 10; ++k)
    EXPECT_NEAR(all.leaf_profile.area(k), one.leaf_profile.area(k), 2e-3 * one.leaf_area_m2) << k;
}

TEST(SurfaceSums, HeightsAreAboveTheTerrain) {
  // Leaves 0.5 m above a slope of 1 in 2.
  Terrain terrain;
  terrain.columns = terrain.rows = 5;
  terrain.low_m = {-2, -2};
  for (int row = 0; row < 5; ++row)
    for (int column = 0; column < 5; ++column) terrain.heights_m.push_back(0.5F * static_cast<float>(column));
  make_terrain_mesh(terrain, false);
  Scene scene;
  scene.domain.periodic = false;
  scene.materials = {"leaf"};
  Prototype& discs = scene.prototypes.emplace_back();
  for (int k = 0; k < 7; ++k) {
    const float x = -1.5F + 0.5F * static_cast<float>(k);
    discs.discs.push_back({{x, 0, 1 + 0.5F * x + 0.55F}, 0.01F, {0, 0, 1}});
  }
  scene.instances.emplace_back();
  Ground ground;
  ground.terrain = std::make_shared<const Terrain>(terrain);
  const SurfaceSums sums = surface_sums(scene, ground, {.height_m = 1, .layers = 10});
  EXPECT_NEAR(sums.leaf_profile.area(5), 7 * pi * 1e-4, 1e-9);
}

// Closed shapes: half their surface times G is their shadow (Cauchy's for a sphere).
TEST(SurfaceSums, ProjectionsOfShapesAreTheirShadows) {
  Scene scene;
  scene.materials = {"bark"};
  scene.prototypes.emplace_back().shapes.push_back(cylinder({0, 0, 0}, {0, 0, 2}, 0.3, 0.3));
  scene.instances.emplace_back();
  const SurfaceSums stem = surface_sums(scene, {}, {.height_m = 2});
  EXPECT_NEAR(stem.other_area_m2, 2 * pi * 0.3 * 2.3, 1e-6);
  for (const double zenith : {0.0, 0.5, 1.2, 1.5}) {
    const double shadow = pi * 0.09 * std::cos(zenith) + 2 * 0.3 * 2 * std::sin(zenith);
    EXPECT_NEAR(stem.plant_area_m2() * stem.plant_g(zenith), shadow, 2e-3 * shadow);
  }
  scene.prototypes[0].shapes = {sphere({0, 0, 1}, 0.5)};
  const SurfaceSums ball = surface_sums(scene, {}, {.height_m = 2});
  EXPECT_NEAR(ball.other_area_m2, pi, 1e-6);
  EXPECT_NEAR(ball.plant_g(0.8), 0.5, 1e-3);
}

TEST(Structure, TellsOrgansSpeciesAndPlants) {
  Scene scene = many_plants(5);
  scene.instances[4].plant = scene.instances[3].plant = 77;  // one plant of two parts
  const CanopyStructure structure = canopy_structure(scene, with_rays(1u << 10));
  const Mesh& mesh = *scene.prototypes[0].mesh;
  ASSERT_EQ(structure.tables.organs.size(), mesh.organs.size());
  for (std::size_t k = 0; k < mesh.organs.size(); ++k) {
    const OrganRow& row = structure.tables.organs[k];
    EXPECT_EQ(row.label, mesh.organs[k].label);
    EXPECT_NEAR(row.area_m2, mesh.organs[k].area_m2, 1e-5 * row.area_m2);
    EXPECT_EQ(row.inclination_deg.has_value(), row.kind == "leaf");
    EXPECT_LT(row.low_m, row.high_m);
  }
  ASSERT_EQ(structure.tables.species.size(), 1u);
  EXPECT_EQ(structure.tables.species[0].count, 5u);
  EXPECT_NEAR(structure.tables.species[0].leaf_area_m2, structure.surface.leaf_area_m2, 1e-9);
  ASSERT_EQ(structure.tables.plants.size(), 4u);
  double sum = 0;
  for (const PlantRow& row : structure.tables.plants) sum += row.leaf_area_m2;
  EXPECT_NEAR(sum, structure.surface.leaf_area_m2, 1e-9);
  EXPECT_EQ(structure.tables.plants[3].plant, 77u);
  EXPECT_GT(structure.tables.plants[0].height_m, 0.1);
}

TEST(Structure, WithoutLeavesSaysSo) {
  Scene scene;
  scene.domain.size_m = {2, 2};
  scene.materials = {"bark"};
  scene.prototypes.emplace_back().shapes.push_back(cylinder({0, 0, 0}, {0, 0, 1}, 0.3, 0.3));
  scene.instances.emplace_back();
  const CanopyStructure structure = canopy_structure(scene, with_rays(1u << 10));
  EXPECT_EQ(structure.lai, 0);
  ASSERT_EQ(structure.notes.size(), 1u);
  EXPECT_NE(structure.notes[0].find("no leaves"), std::string::npos);
  const Json json = structure_json({&scene, &structure, {}, {}, {}, {}});
  EXPECT_TRUE(json.at("leaf_angle").at("mean_deg").is_null());
  EXPECT_TRUE(json.at("g_function")[0].at("g").is_null());
  EXPECT_TRUE(json.at("clumping")[0].at("leaves").is_null());
  EXPECT_TRUE(json.at("clumping")[0].at("plant").is_number());
  EXPECT_TRUE(json.at("effective_lai").at("leaves").at("miller").is_object());
  EXPECT_EQ(json.at("gap_fraction")[0].at("leaves"), 1);
}

TEST(Structure, NotesWhatLiesBelowTheGround) {
  Scene scene = many_plants(3);
  scene.ground = Ground{0.3, 0};
  const CanopyStructure structure = canopy_structure(scene, with_rays(1u << 10));
  ASSERT_FALSE(structure.notes.empty());
  EXPECT_NE(structure.notes[0].find("below the ground"), std::string::npos);
  double above = 0;
  for (std::size_t k = 0; k < structure.surface.leaf_profile.layers(); ++k)
    above += structure.surface.leaf_profile.area(k);
  EXPECT_GT(structure.leaf_area_below_ground_m2(), 0);
  EXPECT_NEAR(above + structure.leaf_area_below_ground_m2(), structure.surface.leaf_area_m2, 1e-6);
}

TEST(StructureReport, TableHoldsTheReportsNumbers) {
  const Scene scene = many_plants(3);
  StructureOptions options = with_rays(1u << 10);
  options.sectors = 4;
  const CanopyStructure structure = canopy_structure(scene, options);
  StructureReport report{&scene, &structure, {{"red", {{"leaf", {0.1, 0.05}}}}}, {}, {}, {}};
  report.scattering = scattering_tables(structure.surface, report.bands, {0, 30});
  ASSERT_EQ(report.scattering.size(), 2u);
  EXPECT_NEAR(report.scattering[1].integral, 0.15 * structure.surface.leaf_g(radians(30)), 1e-9);
  const CsvTable table = CsvTable::parse("t.csv", structure_csv(report));
  double area = 0;
  int sectors = 0;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const auto quantity = table.text(row, table.require("quantity")),
               of = table.text(row, table.require("of"));
    if (quantity == "lai" && of == "canopy") {
      EXPECT_NEAR(table.number(row, table.require("value")), structure.lai, 1e-6 * structure.lai);
    }
    if (quantity == "leaf_area_m2" && of == "plant") area += table.number(row, table.require("value"));
    if (quantity == "gap_fraction" && of == "sector") ++sectors;
  }
  EXPECT_NEAR(area, structure.surface.leaf_area_m2, 1e-6 * area);
  EXPECT_EQ(sectors, 4 * static_cast<int>(structure.gaps.size()));
  EXPECT_EQ(structure_json(report).at("area_scattering").at("tables").size(), 2u);
}

TEST(StructureReport, AzimuthsAreInTheScenesConvention) {
  Domain compass, mathematical;
  mathematical.azimuth_north_clockwise = false;
  EXPECT_NEAR(azimuth_in_convention_deg(0, compass), 90, 1e-9);  // east
  EXPECT_NEAR(azimuth_in_convention_deg(pi / 2, compass), 0, 1e-9);
  EXPECT_NEAR(azimuth_in_convention_deg(pi, compass), 270, 1e-9);
  EXPECT_NEAR(azimuth_in_convention_deg(-pi / 2, mathematical), 270, 1e-9);
  std::vector<AngleBin> bins;
  for (int k = 0; k < 4; ++k) bins.push_back({90.0 * k, 90.0 * k + 90, k == 0 ? 1.0 : 0.0, 0});
  const std::vector<AngleBin> out = azimuth_bins_in_convention(bins, compass);
  ASSERT_EQ(out.size(), 4u);
  EXPECT_NEAR(out[0].from_deg, 0, 1e-9);  // between east and north either way
  EXPECT_EQ(out[0].probability, 1);
}

}  // namespace
}  // namespace bpms
