// Surfaces from MTG columns: by hand, measured points, and the coffee tree whose geometry is known from its
// OPF.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/units.h"
#include "plant/mtg.h"
#include "plant/opf.h"
#include "plant/plant_mesh.h"
#include "tests/data.h"

namespace bpms {
namespace {

using enum ErrorKind;
using testing::HasSubstr;

Mtg with_columns(const std::string& columns, const std::string& rows) {
  std::string features, heads;
  std::istringstream names(columns);
  for (std::string name; names >> name;) features += name + "\tREAL\n", heads += "\t" + name;
  return parse_mtg("t.mtg",
                   "CODE:\tFORM-A\nCLASSES:\nSYMBOL\tSCALE\nP\t1\nA\t2\nU\t3\nLeaf\t3\nDESCRIPTION:"
                   "\nLEFT\tRIGHT\tRELTYPE\tMAX\n"
                   "FEATURES:\nNAME\tTYPE\n" +
                       features + "MTG:\nENTITY-CODE\t\t" + heads + "\n" + rows);
}
const Mesh::Organ& organ_named(const Mesh& mesh, const std::string& label) {
  for (const Mesh::Organ& organ : mesh.organs)
    if (organ.label == label) return organ;
  ADD_FAILURE() << "no " << label;
  return mesh.organs.at(0);
}

TEST(MtgGeometry, PointsMakeChains) {
  // The plant's point is where its trunk begins; U2 has none, so U3 reaches back to U1.
  const Mtg mtg = with_columns("XX YY ZZ TopDia BotDia",
                               "/P1\t\t\t0\t0\t10\n^/A1/U1\t\t\t0\t0\t30\t2\t3\n^<U2<U3\t\t\t0\t30\t70\t1\n"
                               "\t+A2/U4\t\t10\t30\t70\t0.5\n");
  std::vector<std::string> notes;
  const Mesh mesh = mtg_mesh(mtg, {}, notes);
  ASSERT_EQ(mesh.organs.size(), 3u);
  EXPECT_NEAR(organ_named(mesh, "U1").length_m, 0.20, 1e-12);
  EXPECT_NEAR(organ_named(mesh, "U3").length_m, 0.50, 1e-12);
  EXPECT_NEAR(organ_named(mesh, "U4").length_m, 0.10, 1e-12);
  // The branch is a cylinder of 0.5 cm with a lid; polygons as long as their circles (a lid of 12 sides
  // is 2.3 % short).
  EXPECT_NEAR(organ_named(mesh, "U4").area_m2, pi * 0.005 * 0.1 + pi * 0.0025 * 0.0025, 5e-7);
  float low = 1;
  for (const Eigen::Vector3f& p : mesh.positions_m) low = std::min(low, p.z());
  EXPECT_NEAR(low, 0.1, 1e-6);
  EXPECT_TRUE(notes.empty());
  // Ten times the unit, ten times the plant.
  std::vector<std::string> more;
  MtgGeometryOptions large{0.1, 0.1, 1e-4};
  EXPECT_NEAR(organ_named(mtg_mesh(mtg, large, more), "U3").length_m, 5.0, 1e-12);
}

TEST(MtgGeometry, WhatIsMissingIsAssumedAndNoted) {
  std::vector<std::string> notes;
  mtg_mesh(with_columns("XX YY ZZ", "/P1/A1/U1\t\t\t0\t0\t1\n^<U2\t\t\t0\t0\t5\n"), {}, notes);
  EXPECT_THAT(notes, testing::ElementsAre(HasSubstr("1 entities without a diameter"),
                                          HasSubstr("1 entities have a place")));
  notes.clear();
  mtg_mesh(with_columns("Length", "/P1/A1/U1\t\t\t10\n\t+A2/U1\t\t5\n"), {}, notes);
  EXPECT_THAT(notes,
              testing::Contains(HasSubstr("1 borne entities without YInsertionAngle lean by 45 degrees")));
  BPMS_EXPECT_ERROR(mtg_mesh(with_columns("age", "/P1/A1/U1\t\t\t1\n"), {}, notes), bad_input, "no geometry");
  BPMS_EXPECT_ERROR(mtg_mesh(with_columns("Length", "/P1/A1/U1\n"), {}, notes), bad_input, "no geometry");
  BPMS_EXPECT_ERROR(mtg_mesh(with_columns("XX YY ZZ", "/P1/A1/U1\t\t\t1e30\t0\t0\n"), {}, notes), bad_input,
                    "t.mtg:17: U1 lies beyond 1e7 m");
}

TEST(MtgGeometry, AnglesByHand) {
  // Rolled by 90 degrees from east to north, a branch leans by 60 from the tip's surface.
  std::vector<std::string> notes;
  const Mesh mesh =
      mtg_mesh(with_columns("Length Width XEuler YInsertionAngle",
                            "/P1/A1/U1\t\t\t10\t2\t90\n\t+A2/U2\t\t20\t1\t0\t60\n\t+Leaf1\t\t6\t3\t0\t90\n"),
               {}, notes);
  Eigen::Vector3d tip = Eigen::Vector3d::Zero();
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (const std::uint32_t v : mesh.triangles[t])
      if (mesh.organs[mesh.organ_of_triangle[t]].label == "U2" && mesh.uv[v] == Eigen::Vector2f(1, 0.5f))
        tip = mesh.positions_m[v].cast<double>();
  EXPECT_LT((tip - Eigen::Vector3d(0, 0.01 + 0.2 * std::sin(pi / 3), 0.1 + 0.1)).norm(), 1e-6);
  const Mesh::Organ& leaf = organ_named(mesh, "Leaf1");
  EXPECT_EQ(leaf.kind, "leaf");
  EXPECT_NEAR(leaf.area_m2, 2.0 / 3 * 18e-4, 1e-9);
}

TEST(MtgGeometry, MeasuredWalnutHasItsLengths) {
  BPMS_NEED_DATA("mtg-digitised/boutdenoylum2.mtg");
  const Mtg mtg = read_mtg(test::data_folder() + "/mtg-digitised/boutdenoylum2.mtg");
  std::vector<std::string> notes;
  const Mesh mesh = mtg_mesh(mtg, {0.01, 1e-4, 1e-3}, notes);
  // S that follow S, straight from the columns.
  double length = 0, made = 0;
  std::vector<std::string> labels;
  const auto point = [&](std::size_t v) {
    return Eigen::Vector3d(*mtg.number(v, mtg.feature("XX")), *mtg.number(v, mtg.feature("YY")),
                           *mtg.number(v, mtg.feature("ZZ")));
  };
  std::size_t organs = 0;
  for (std::size_t v = 0; v < mtg.vertices.size(); ++v) {
    const MtgVertex& vertex = mtg.vertices[v];
    if (mtg.scale(v) != 3 || vertex.edge != '<' || !mtg.number(v, mtg.feature("XX"))) continue;
    const auto parent = static_cast<std::size_t>(vertex.parent);
    if (!mtg.number(parent, mtg.feature("XX"))) continue;
    length += (point(v) - point(parent)).norm() * 0.01;
    organs += point(v) != point(parent) ? 1 : 0;
  }
  for (const Mesh::Organ& organ : mesh.organs) made += organ.length_m;
  EXPECT_GT(organs, 50u);
  EXPECT_GE(made, length - 1e-9);  // what is borne comes on top
  for (const std::string& note : notes) std::cout << note << "\n";
  std::cout << mesh.organs.size() << " organs, " << made << " m, of it in axes " << length << " m\n";
}

// The same tree as MTG and as OPF: axes laid out by angles must lie where the matrices put them.
TEST(MtgGeometry, CoffeeTreeStandsWhereItsOpfSays) {
  BPMS_NEED_DATA("mtg-digitised/coffee-opf");
  const std::string folder = test::data_folder() + "/mtg-digitised/coffee-opf/";
  std::vector<std::string> notes;
  const Mesh laid = mtg_mesh(read_mtg(folder + "coffee.mtg"), {}, notes);
  const Mesh truth = read_opf(folder + "coffee.opf").mesh;
  const auto middles = [](const Mesh& mesh, const std::string& kind) {
    std::vector<Eigen::Vector3d> sum(mesh.organs.size(), Eigen::Vector3d::Zero());
    std::vector<double> area(mesh.organs.size(), 0);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const double a = triangle_area_m2(mesh, t);
      for (const std::uint32_t v : mesh.triangles[t])
        sum[mesh.organ_of_triangle[t]] += a / 3 * mesh.positions_m[v].cast<double>();
      area[mesh.organ_of_triangle[t]] += a;
    }
    std::vector<Eigen::Vector3d> out;
    for (std::size_t i = 0; i < sum.size(); ++i)
      if (mesh.organs[i].kind == kind && area[i] > 0 && mesh.organs[i].length_m > 0)
        out.push_back(sum[i] / area[i]);
    return out;
  };
  for (const std::string kind : {"stem", "leaf"}) {
    const std::vector<Eigen::Vector3d> a = middles(laid, kind), b = middles(truth, kind);
    ASSERT_EQ(a.size(), b.size());
    std::vector<double> off;
    for (std::size_t i = 0; i < a.size(); ++i)
      off.push_back(std::hypot(a[i].z() - b[i].z(), a[i].head<2>().norm() - b[i].head<2>().norm()));
    std::sort(off.begin(), off.end());
    std::cout << kind << ": " << a.size() << ", off by median " << off[off.size() / 2] << " m, 90 % "
              << off[off.size() * 9 / 10] << " m, worst " << off.back() << " m\n";
    // The side on which each axis of a node stands is not in the columns, so places are compared by height
    // and distance from the trunk, where most of the axes must agree; those of second order start from the
    // others.
    if (kind == "stem") {
      EXPECT_LT(off[off.size() / 2], 1e-3);
    }
  }
}

TEST(PlantMtg, GrassAsGraph) {
  const Plant plant = read_plant(std::string(BPMS_SOURCE_DIR) + "/examples/plants/grass.bpms");
  Mesh mesh = plant_mesh(plant);
  mesh.organs[1].properties = {{"age_d", "12"}, {"cultivar", "Soissons"}};
  const Mtg mtg = plant_mtg(plant, mesh);
  // [s[+l][+l]s[+l]h]: one axis of two stems and a head, which bear three leaves.
  std::vector<std::string> said;
  for (std::size_t v = 0; v < mtg.vertices.size(); ++v) {
    const std::int32_t parent = mtg.vertices[v].parent;
    said.push_back((parent < 0 ? "" : mtg.label(static_cast<std::size_t>(parent))) + mtg.vertices[v].edge +
                   mtg.label(v));
  }
  EXPECT_THAT(said, testing::ElementsAre("/P1", "/A1", "/S1", "S1+L1", "S1+L2", "S1<S2", "S2+L3", "S2<H1"));
  const std::string text = mtg_text(mtg);
  const Mtg again = parse_mtg("grass.mtg", text);
  EXPECT_TRUE(again.same_as(mtg));
  EXPECT_EQ(mtg_text(again), text);
  EXPECT_EQ(*again.text(3, *again.feature("cultivar")), "Soissons");
  EXPECT_EQ(*again.text(3, *again.feature("Label")), "l1");
  EXPECT_NEAR(*again.number(3, again.feature("Area")) * 1e-4, mesh.organs[1].area_m2, 1e-9);
  EXPECT_NEAR(*again.number(5, again.feature("ZZ")), 20, 1e-9);  // stems of 12 and 8 cm
  EXPECT_NEAR(*again.number(2, again.feature("TopDia")), 0.4, 1e-9);
  std::vector<std::string> notes;
  EXPECT_NEAR(organ_named(mtg_mesh(again, {}, notes), "S2").length_m, 0.08, 1e-9);
}

TEST(PlantMtg, BracketsWithStemsAreAxes) {
  const Plant plant = read_plant(std::string(BPMS_SOURCE_DIR) +
                                 "/examples/plants/figure1_leaves.bpms");  // [bsb[+l][+l][+sb[...]]]
  const Mtg mtg = plant_mtg(plant, plant_mesh(plant));
  int axes = 0, borne = 0;
  for (std::size_t v = 0; v < mtg.vertices.size(); ++v) {
    axes += mtg.scale(v) == 2 ? 1 : 0;
    borne += mtg.scale(v) == 2 && mtg.vertices[v].edge == '+' ? 1 : 0;
  }
  EXPECT_EQ(axes, 3);
  EXPECT_EQ(borne, 2);
  EXPECT_TRUE(parse_mtg("f.mtg", mtg_text(mtg)).same_as(mtg));
}

}  // namespace
}  // namespace bpms
