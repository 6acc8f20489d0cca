// OPF and OPS: a measured coffee tree against its own attributes, matrices by hand, mistakes by their place.
#include "plant/opf.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

#include "core/text.h"
#include "core/units.h"
#include "plant/exchange/opf_parts.h"
#include "tests/data.h"

namespace bpms {
namespace {

using enum ErrorKind;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Pair;

// A square in the x-y plane from x = 0 to 1, tapered and placed.
const char* const small_opf =
    "<?xml version=\"1.0\"?>\n<opf version=\"2.0\">\n<meshBDD>\n<mesh Id=\"3\">\n"
    "<points>0 -0.5 0 1 -0.5 0 1 0.5 0 0 0.5 0</points>\n"
    "<normals>0 0 1 0 0 1 0 0 1 0 0 1</normals>\n"
    "<faces><face Id=\"0\">0 1 2</face>\n<face Id=\"1\">0 2 3</face></faces>\n</mesh>\n</meshBDD>\n"
    "<materialBDD><material Id=\"7\"><diffuse>0 1 0 1</diffuse></material></materialBDD>\n"
    "<shapeBDD><shape Id=\"1\"><name>blade</name><meshIndex>3</meshIndex>\n"
    "<materialIndex>7</materialIndex></shape></shapeBDD>\n"
    "<attributeBDD><attribute name=\"Length\" class=\"Double\"/></attributeBDD>\n"
    "<topology class=\"Plant\" scale=\"1\" id=\"1\">\n"
    "<decomp class=\"Stem\" scale=\"2\" id=\"2\">\n<Length>20</Length>\n"
    "<branch class=\"Leaf\" scale=\"2\" id=\"3\">\n<Length>12.5</Length>\n"
    "<geometry class=\"Mesh\"><shapeIndex>1</shapeIndex>\n"
    "<mat>0 -4 0 100\n10 0 0 0\n0 0 1 50</mat>\n<dUp>0.5</dUp><dDwn>1</dDwn></geometry>\n"
    "</branch>\n</decomp>\n<follow class=\"Stem\" scale=\"2\" id=\"4\"/>\n</topology>\n</opf>\n";

TEST(Opf, MatrixTaperAndTopologyByHand) {
  const OpfPlant plant = parse_opf("t.opf", small_opf);
  ASSERT_EQ(plant.mesh.organs.size(), 1u);
  const Mesh::Organ& leaf = plant.mesh.organs[0];
  EXPECT_EQ(leaf.label, "Leaf3");
  EXPECT_EQ(leaf.kind, "leaf");
  EXPECT_EQ(leaf.material, "leaf");
  EXPECT_DOUBLE_EQ(leaf.length_m, 0.125);
  EXPECT_THAT(leaf.properties, ElementsAre(Pair("Length", "12.5")));
  // (x, y) -> (100 - 4 f y, 10 x, 50) cm with f from 1 to 1/2: a trapezium of 10 by (4 + 2) / 2 cm.
  EXPECT_NEAR(leaf.area_m2, 30e-4, 3e-3 * 4e-6);  // coordinates of 1 m in floats: 6e-8 of 2 cm, a few times
  const Eigen::Vector3f& tip = plant.mesh.positions_m[2];  // (1, 1/2)
  EXPECT_NEAR((tip - Eigen::Vector3f(0.99f, 0.1f, 0.5f)).norm(), 0, 1e-7);
  EXPECT_NEAR(plant.mesh.normals[2].z(), 1, 1e-6);
  ASSERT_EQ(plant.mtg.vertices.size(), 4u);
  const auto& v = plant.mtg.vertices;
  EXPECT_EQ(v[1].complex, 0);
  EXPECT_EQ(v[2].parent, 1);
  EXPECT_EQ(v[2].edge, '+');
  EXPECT_EQ(v[3].parent, 1);
  EXPECT_EQ(v[3].edge, '<');
  EXPECT_THAT(plant.organ_of_vertex, ElementsAre(-1, -1, 0, -1));
  EXPECT_THAT(plant.notes, IsEmpty());
}

TEST(Opf, MirroredMatricesKeepTheSideOfTheNormals) {
  std::string text = small_opf;
  text.replace(text.find("0 -4 0 100"), 10, "0 4 0 100");
  const Mesh mesh = parse_opf("t.opf", text).mesh;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Eigen::Vector3f n =
        (mesh.positions_m[b] - mesh.positions_m[a]).cross(mesh.positions_m[c] - mesh.positions_m[a]);
    EXPECT_GT(n.dot(mesh.normals[a]), 0);
  }
}

TEST(Opf, MistakesAreLocated) {
  for (const auto& [from, to, says] : std::vector<std::array<std::string, 3>>{
           {"<meshIndex>3", "<meshIndex>4", "t.opf:12:11: shape 1: there is no mesh with Id 4"},
           {"<materialIndex>7", "<materialIndex>8", "t.opf:12:11: shape 1: there is no material with Id 8"},
           {"<shapeIndex>1", "<shapeIndex>2", "t.opf:20:1: there is no shape with Id 2"},
           {"0 0 1 50", "0 0 1", "t.opf:21:6: mat has 11 numbers, expected 12"},
           {"0 0 1 50", "0 0 1 x", "t.opf:21:6: found 'x' in mat"},
           {"<dUp>0.5", "<dUp>nan", "found 'nan' in dUp"},
           {"<Length>20", "<Length>long",
            "t.opf:17:9: found 'long' in <Length>, expected a value of type REAL"},
           {"\">0 1 2<", "\">0 1 4<", "t.opf:7:21: corner 4 of a face, but there are 4 points"},
           {"\">0 1 2<", "\">0 1<", "a face of 2 corners"},
           {"0 0.5 0</points>", "0 0.5</points>", "11 numbers in points"},
           {"0 0 1</normals>", "</normals>", "t.opf:4:1: mesh 3 has 4 points, but 3 normals"},
           {"class=\"Leaf\" scale=\"2\"", "class=\"Leaf\" scale=\"0\"", "<branch class=\"Leaf\">"},
           {"class=\"Leaf\" scale=\"2\"", "class=\"Stem\" scale=\"3\"", "at scale 3, but before at scale 2"},
           {"class=\"Leaf\" ", "", "t.opf:18:1: <branch> needs class"},
           {"</branch>", "</branc>", "t.opf:25:3: not well-formed XML"},
           {"<opf version=\"2.0\">", "<html>", "t.opf:2:1: found <html>, expected <opf>"},
           {"<opf ", "<!DOCTYPE opf [<!ENTITY a \"b\">]><opf ", "the entity 'a' is declared"}}) {
    std::string text = small_opf;
    text.replace(text.find(from), from.size(), to);
    BPMS_EXPECT_ERROR(parse_opf("t.opf", text), bad_input, says);
  }
  std::string deep = "<opf><topology class=\"A\" scale=\"1\" id=\"1\">";
  for (int k = 0; k < 20'000; ++k) deep += "<branch class=\"A\" scale=\"1\" id=\"1\">";
  BPMS_EXPECT_ERROR(parse_opf("t.opf", deep), bad_input, "nested more than 10000 deep");
}

void expect_same_surface(const Mesh& a, const Mesh& b) {
  ASSERT_EQ(a.triangles.size(), b.triangles.size());
  for (std::size_t t = 0; t < a.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k)
      ASSERT_EQ(a.positions_m[a.triangles[t][k]], b.positions_m[b.triangles[t][k]]) << t;
  for (std::size_t t = 0; t < a.triangles.size(); ++t) {  // organs without triangles are not written
    const Mesh::Organ& mine = a.organs[a.organ_of_triangle[t]];
    const Mesh::Organ& other = b.organs[b.organ_of_triangle[t]];
    ASSERT_EQ(mine.material, other.material);
    ASSERT_EQ(mine.kind, other.kind);
    ASSERT_EQ(mine.properties, other.properties);
  }
}

TEST(Opf, WritingAndReadingGivesTheSamePlant) {
  const OpfPlant plant = parse_opf("t.opf", small_opf);
  const std::string written = opf_text(plant.mesh, plant.mtg, plant.organ_of_vertex);
  const OpfPlant again = parse_opf("again.opf", written);
  expect_same_surface(plant.mesh, again.mesh);
  EXPECT_TRUE(again.mtg.same_as(plant.mtg));
  EXPECT_EQ(opf_text(again.mesh, again.mtg, again.organ_of_vertex), written);
}

TEST(Opf, CoffeeTreeAgreesWithItsOwnAttributes) {
  BPMS_NEED_DATA("mtg-digitised/coffee-opf/coffee.opf");
  const std::string path = test::data_folder() + "/mtg-digitised/coffee-opf/coffee.opf";
  const OpfPlant plant = read_opf(path);
  std::map<std::string, int> nodes, organs;
  for (const MtgVertex& v : plant.mtg.vertices) ++nodes[plant.mtg.classes[v.symbol].symbol];
  EXPECT_THAT(nodes, ElementsAre(Pair("Axis", 158), Pair("Individual", 1), Pair("Leaf", 2179),
                                 Pair("Metamer", 1853)));
  std::map<std::string, double> area;
  for (const Mesh::Organ& organ : plant.mesh.organs) {
    ++organs[organ.kind];
    area[organ.kind] += organ.area_m2;
  }
  EXPECT_THAT(organs, ElementsAre(Pair("leaf", 2179), Pair("stem", 1853)));
  // Matrices and tapers hold what the attributes say: a metamer is a frustum of 25 sides of its Length,
  // between its Width and the next one's; a leaf the reference blade stretched by Length along and Width
  // across.
  const OpfParts parts = parse_opf_parts(path, read_text(path));
  const OpfReferenceMesh& blade = parts.meshes.at(1);
  double wall = 0, blades = 0;
  for (const OpfNode& node : parts.nodes) {
    const double length = parts.mtg.number(node.vertex, parts.mtg.feature("Length")).value_or(0);
    const double width = parts.mtg.number(node.vertex, parts.mtg.feature("Width")).value_or(0);
    if (node.shape == 0) wall += 25 * std::sin(pi / 25) * (node.down + node.up) / 2 * length * 1e-4;
    const Eigen::Vector3d stretch(length, width, width);
    for (const auto& [a, b, c] : blade.faces) {
      const Eigen::Vector3d p = blade.points[a].cwiseProduct(stretch);
      const Eigen::Vector3d ab = blade.points[b].cwiseProduct(stretch) - p;
      const Eigen::Vector3d ac = blade.points[c].cwiseProduct(stretch) - p;
      if (node.shape == 1) blades += ab.cross(ac).norm() / 2 * 1e-4;
    }
  }
  EXPECT_NEAR(area["leaf"] / blades, 1, 1e-5);  // matrices are given in floats
  EXPECT_NEAR(area["stem"] / wall, 1, 2e-3);    // the slant of the walls
  const OpfPlant again = parse_opf("again.opf", opf_text(plant.mesh, plant.mtg, plant.organ_of_vertex));
  EXPECT_EQ(plant.mtg.vertices.size(), again.mtg.vertices.size());
  EXPECT_TRUE(parse_mtg("a", mtg_text(plant.mtg)).same_as(plant.mtg));
  expect_same_surface(plant.mesh, again.mesh);
}

TEST(Opf, TopologyIsThatOfTheMtgOfTheSameTree) {
  BPMS_NEED_DATA("mtg-digitised/coffee-opf");
  const std::string folder = test::data_folder() + "/mtg-digitised/coffee-opf/";
  const Mtg opf = read_opf(folder + "coffee.opf").mtg, mtg = read_mtg(folder + "coffee.mtg");
  // Each relation as classes and edge; how many there are of each.
  const auto relations = [](const Mtg& of) {
    std::map<std::string, int> out;
    for (const MtgVertex& v : of.vertices) {
      const auto name = [&](std::int32_t other) {
        return other < 0 ? std::string("-")
                         : of.classes[of.vertices[static_cast<std::size_t>(other)].symbol].symbol;
      };
      if (of.classes[v.symbol].symbol != "Scene" && of.classes[v.symbol].symbol != "Individual")
        ++out[name(v.parent) + v.edge + of.classes[v.symbol].symbol + " in " + name(v.complex)];
    }
    return out;
  };
  EXPECT_EQ(relations(opf), relations(mtg));
}

const char* const small_ops =
    "# a stand\nT 0 0 0 2 1 flat\n#[Archimed] coffee\n#sceneId plantId "
    "...\n1\t1\ta.opf\t0.5\t0.25\t0\t1\t0\t0\t0\n"
    "#[Archimed] shade tree\n1 2 b.opf 1 0.5 0.1 1.5 0.5 0.25 1.57\n-1 1 1\n";

TEST(Ops, RowsGroupsAndPlot) {
  const OpsScene scene = parse_ops("s.ops", small_ops);
  EXPECT_EQ(scene.size_m, Eigen::Vector2d(2, 1));
  ASSERT_EQ(scene.rows.size(), 2u);
  EXPECT_EQ(scene.rows[0].group, "coffee");
  EXPECT_EQ(scene.rows[1].group, "shade tree");
  EXPECT_EQ(scene.rows[1].file, "b.opf");
  // The plant's axis leans by 0.25 towards 0.5, whatever its twist; the twist turns about that axis.
  const Eigen::Affine3d place = scene.rows[1].world_from_plant();
  const Eigen::Vector3d axis = place.linear() * Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d wanted(std::sin(0.25) * std::cos(0.5), std::sin(0.25) * std::sin(0.5),
                               std::cos(0.25));
  EXPECT_LT((axis - 1.5 * wanted).norm(), 1e-12);
  OpsRow upright = scene.rows[1];
  upright.lean = 0;
  const Eigen::Vector3d x = upright.world_from_plant().linear() * Eigen::Vector3d::UnitX();
  EXPECT_LT((x - 1.5 * Eigen::Vector3d(std::cos(1.57), std::sin(1.57), 0)).norm(), 1e-12);
  EXPECT_EQ(place.translation(), Eigen::Vector3d(1, 0.5, 0.1));
  const std::string written = ops_text(scene);
  EXPECT_EQ(ops_text(parse_ops("again.ops", written)), written);
}

TEST(Ops, MistakesAreLocated) {
  for (const auto& [from, to, says] : std::vector<std::array<std::string, 3>>{
           {"0.5 0.1 1.5", "0.5 0.1", "s.ops:7:1: 9 columns, expected 10"},
           {"0.1 1.5", "0.1 -1.5", "s.ops:7:21: scale -1.5"},
           {"0.25 1.57", "0.25 east", "s.ops:7:34: found 'east', expected stemTwist in radians"},
           {"1 2 b", "1 two b", "s.ops:7:3: found 'two', expected plantId"},
           {"2 1 flat", "0 1 flat", "s.ops:2:9: expected a size above 0"},
           {"flat", "dem.asc", "s.ops:2:13: terrain 'dem.asc' is not read"}}) {
    std::string text = small_ops;
    text.replace(text.find(from), from.size(), to);
    BPMS_EXPECT_ERROR(parse_ops("s.ops", text), bad_input, says);
  }
  BPMS_EXPECT_ERROR(parse_ops("s.ops", "# nothing\n"), bad_input, "no plants");
}

}  // namespace
}  // namespace bpms
