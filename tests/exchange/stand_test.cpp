// Stands as files: read back by Assimp and by hand, areas and counts against the stand itself.
#include "plant/stand_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <map>
#include <set>

#include "core/atomic_file.h"
#include "core/json.h"
#include "core/text.h"
#include "plant/plant_file.h"
#include "plant/plant_mesh.h"
#include "scene/importers/mesh_file.h"
#include "tests/data.h"

namespace bpms {
namespace {

using enum ErrorKind;
using testing::HasSubstr;

const std::string plants_folder = std::string(BPMS_SOURCE_DIR) + "/examples/plants/";

Stand small_stand() {
  Stand out;
  for (const char* name : {"grass", "figure2_90"}) {
    out.files.push_back(plants_folder + name + ".bpms");
    out.names.emplace_back(name);
    out.meshes.push_back(std::make_shared<const Mesh>(plant_mesh(read_plant(out.files.back()), {1e-3})));
  }
  for (int i = 0; i < 7; ++i) {
    OpsRow row;
    row.plant = i + 1;
    row.file = out.files[static_cast<std::size_t>(i % 2)];
    row.position_m = {0.3 * i, -0.2 * i, 0.05 * i};
    row.scale = 1 + 0.1 * i;
    row.twist = 0.7 * i;
    row.lean = 0.05 * i;
    row.lean_azimuth = i;
    row.group = out.names[static_cast<std::size_t>(i % 2)];
    out.items.push_back({static_cast<std::uint32_t>(i % 2), row.world_from_plant()});
    out.places.rows.push_back(row);
  }
  return out;
}

struct Sums {
  std::size_t triangles = 0;
  double area_m2 = 0;
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();  // area times place
  std::map<std::string, double> material_area_m2;
};
void add(const Mesh& mesh, const Eigen::Affine3d& place, Sums& out) {
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    std::array<Eigen::Vector3d, 3> p;
    for (std::size_t k = 0; k < 3; ++k) p[k] = place * mesh.positions_m[mesh.triangles[t][k]].cast<double>();
    const double area = (p[1] - p[0]).cross(p[2] - p[0]).norm() / 2;
    ++out.triangles;
    out.area_m2 += area;
    out.moment += area / 3 * (p[0] + p[1] + p[2]);
    out.material_area_m2[mesh.organs[mesh.organ_of_triangle[t]].material] += area;
  }
}
Sums sums(const Stand& stand) {
  Sums out;
  for (const StandItem& item : stand.items) add(*stand.meshes[item.mesh], item.world_from_plant, out);
  return out;
}

class StandFiles : public testing::TestWithParam<const char*> {};

TEST_P(StandFiles, AssimpReadsTheWholeStandBack) {
  const test::TemporaryFolder folder;
  const Stand stand = small_stand();
  const std::string path = folder / ("stand" + std::string(GetParam()));
  write_stand(path, stand);
  const std::shared_ptr<const Mesh> read = read_mesh_file(path, 1, mesh_file_is_y_up(path));
  Sums got;
  add(*read, Eigen::Affine3d::Identity(), got);
  const Sums wanted = sums(stand);
  EXPECT_EQ(got.triangles, wanted.triangles);
  // Coordinates of some metres in floats: 1e-7 of triangles of millimetres.
  EXPECT_NEAR(got.area_m2 / wanted.area_m2, 1, 1e-4);
  EXPECT_LT((got.moment - wanted.moment).norm(), 1e-4 * wanted.moment.norm());
  if (std::string(GetParam()) == ".ply") return;  // Assimp drops what faces carry
  for (const auto& [name, area] : wanted.material_area_m2)
    EXPECT_NEAR(got.material_area_m2[name] / area, 1, 1e-4) << name;
}
INSTANTIATE_TEST_SUITE_P(Formats, StandFiles, testing::Values(".glb", ".obj", ".ply"),
                         [](const auto& format) { return std::string(format.param).substr(1); });

Json glb_document(const std::string& bytes) {
  std::uint32_t size = 0;
  std::memcpy(&size, bytes.data() + 12, 4);
  return Json::parse(bytes.substr(20, size));
}

TEST(StandGlb, KeepsEachPlantOnceAndNamesItsOrgans) {
  const test::TemporaryFolder folder;
  Stand stand = small_stand();
  write_stand(folder / "a.glb", stand);
  const Json document = glb_document(read_file(folder / "a.glb"));
  EXPECT_EQ(document["meshes"].size(), 2u);
  EXPECT_EQ(document["nodes"].size(), 8u);  // seven clones and the stand
  EXPECT_FALSE(document.contains("extensionsUsed"));
  std::set<std::string> organs;
  for (const Json& primitive : document["meshes"][0]["primitives"])
    organs.insert(primitive["extras"]["name"]);
  EXPECT_EQ(organs, (std::set<std::string>{"s1", "l1", "l2", "s2", "l3", "h1"}));
  // Ten times the clones, not ten times the bytes.
  const std::size_t small = read_file(folder / "a.glb").size();
  for (int k = 0; k < 63; ++k) stand.items.push_back(stand.items[static_cast<std::size_t>(k % 7)]);
  write_stand(folder / "b.glb", stand);
  EXPECT_LT(read_file(folder / "b.glb").size(), small + 63 * 300);
}

TEST(StandGlb, ManyClonesAreInstanced) {
  const test::TemporaryFolder folder;
  const Stand stand = small_stand();
  write_stand(folder / "a.glb", stand, {false, 3});
  const std::string bytes = read_file(folder / "a.glb");
  const Json document = glb_document(bytes);
  EXPECT_EQ(document["extensionsRequired"], Json::array({"EXT_mesh_gpu_instancing"}));
  std::uint32_t json_size = 0;
  std::memcpy(&json_size, bytes.data() + 12, 4);
  const char* binary = bytes.data() + 20 + json_size + 8;
  const auto floats = [&](std::size_t accessor, std::size_t first, float* out, std::size_t count) {
    const Json& view =
        document["bufferViews"][document["accessors"][accessor]["bufferView"].get<std::size_t>()];
    std::memcpy(out, binary + view["byteOffset"].get<std::size_t>() + 4 * first, 4 * count);
  };
  std::vector<Eigen::Affine3d> places;
  for (const Json& node : document["nodes"]) {
    if (!node.contains("extensions")) continue;
    const Json& attributes = node["extensions"]["EXT_mesh_gpu_instancing"]["attributes"];
    const std::size_t count = document["accessors"][attributes["TRANSLATION"].get<std::size_t>()]["count"];
    for (std::size_t i = 0; i < count; ++i) {
      Eigen::Vector3f t;
      Eigen::Vector4f q;
      float s = 0;
      floats(attributes["TRANSLATION"], 3 * i, t.data(), 3);
      floats(attributes["ROTATION"], 4 * i, q.data(), 4);
      floats(attributes["SCALE"], 3 * i, &s, 1);
      const Eigen::Quaterniond turn(q.w(), q.x(), q.y(), q.z());
      Eigen::Matrix3d z_up;  // (x, y, z) of glTF is (x, -z, y)
      z_up << 1, 0, 0, 0, 0, -1, 0, 1, 0;
      Eigen::Affine3d place =
          Eigen::Translation3d(z_up * t.cast<double>()) *
          Eigen::Affine3d(Eigen::Matrix3d(z_up * (s * turn.toRotationMatrix()) * z_up.transpose()));
      places.push_back(place);
    }
  }
  ASSERT_EQ(places.size(), stand.items.size());
  // Clones of one kind after those of the other.
  std::vector<std::size_t> order{0, 2, 4, 6, 1, 3, 5};
  for (std::size_t i = 0; i < order.size(); ++i)
    EXPECT_LT((places[i].matrix() - stand.items[order[i]].world_from_plant.matrix()).cwiseAbs().maxCoeff(),
              1e-6);
}

TEST(StandPly, FacesKnowTheirPlantAndOrgan) {
  const test::TemporaryFolder folder;
  const Stand stand = small_stand();
  write_stand(folder / "a.ply", stand);
  const std::string bytes = read_file(folder / "a.ply");
  const std::size_t header = bytes.find("end_header\n") + 11;
  std::size_t vertices = 0, faces = 0;
  for (const StandItem& item : stand.items) {
    vertices += stand.meshes[item.mesh]->positions_m.size();
    faces += stand.meshes[item.mesh]->triangles.size();
  }
  ASSERT_EQ(bytes.size(), header + 32 * vertices + 25 * faces);
  std::int32_t last[6];
  std::memcpy(last, bytes.data() + bytes.size() - 24, 24);
  EXPECT_EQ(last[5], 6);  // the seventh plant
  EXPECT_EQ(last[3], stand.meshes[0]->organs[stand.meshes[0]->organ_of_triangle.back()].id);
  EXPECT_EQ(last[0], static_cast<std::int32_t>(vertices - stand.meshes[0]->positions_m.size() +
                                               stand.meshes[0]->triangles.back()[0]));
  EXPECT_THAT(bytes.substr(0, header), HasSubstr("comment organ 0 4 l3 leaf leaf\n"));
  EXPECT_THAT(bytes.substr(0, header), HasSubstr("comment plant 6 0\n"));
}

TEST(StandOps, PlacesComeBack) {
  const test::TemporaryFolder folder;
  const Stand stand = small_stand();
  write_stand(folder / "a.ops", stand);
  const Stand again = ops_stand(folder / "a.ops", [](const std::string& file) {
    PlantFileOptions options;
    options.tolerance_m = 1e-3;
    return std::make_shared<const Mesh>(read_plant_file(file, options).mesh);
  });
  ASSERT_EQ(again.items.size(), stand.items.size());
  for (std::size_t i = 0; i < stand.items.size(); ++i)
    EXPECT_LT((again.items[i].world_from_plant.matrix() - stand.items[i].world_from_plant.matrix()).norm(),
              1e-12);
  EXPECT_NEAR(sums(again).area_m2, sums(stand).area_m2, 1e-12);
  BPMS_EXPECT_ERROR(write_stand(folder / "a.stl", stand), bad_input,
                    "unknown kind of file for a stand '.stl'");
  BPMS_EXPECT_ERROR(write_stand(folder / "a.ops", stand), bad_input, "exists already");
}

TEST(PlantFiles, EveryKindIsReadAndWritten) {
  const test::TemporaryFolder folder;
  const PlantFile grass = read_plant_file(plants_folder + "grass.bpms");
  for (const char* kind : {".mtg", ".opf"}) {
    const std::string path = folder / ("grass" + std::string(kind));
    for (const MeshFile& file : plant_files(path, grass)) write_file(file.path, file.bytes, false);
    const PlantFile again = read_plant_file(path);
    EXPECT_EQ(again.mtg.vertices.size(), grass.mtg.vertices.size());
    if (std::string(kind) == ".mtg") continue;
    Sums got, wanted;
    add(again.mesh, Eigen::Affine3d::Identity(), got);
    add(grass.mesh, Eigen::Affine3d::Identity(), wanted);
    EXPECT_EQ(got.triangles, wanted.triangles);
    EXPECT_NEAR(got.area_m2, wanted.area_m2, 1e-12);
    EXPECT_EQ(got.material_area_m2.size(), wanted.material_area_m2.size());
  }
  const std::string lsystems = std::string(BPMS_SOURCE_DIR) + "/examples/lsystem/";
  PlantFileOptions six;
  six.steps = 6;
  const PlantFile honda = read_plant_file(lsystems + "honda.lsys", six);
  const std::string string = plant_files("h.lstr", honda)[0].bytes;
  EXPECT_THAT(read_text(lsystems + "honda.lstr"), HasSubstr(string));
  EXPECT_EQ(read_plant_file(lsystems + "honda.lstr").mesh.positions_m, honda.mesh.positions_m);
  BPMS_EXPECT_ERROR(plant_files("g.lstr", grass), bad_input, "a derived string comes of an L-system");
  BPMS_EXPECT_ERROR(read_plant_file("x.lsyz"), bad_input, "did you mean '.lsys'?");
}

TEST(PlantFiles, TopologyAloneIsReadWhereItIsAskedFor) {
  const test::TemporaryFolder folder;
  const std::string path = folder.write(
      "t.mtg",
      "CODE:\tFORM-A\nCLASSES:\nSYMBOL\tSCALE\nP\t1\nDESCRIPTION:\nFEATURES:\nMTG:\nENTITY-CODE\n/P1\n");
  BPMS_EXPECT_ERROR(read_plant_file(path), bad_input, "no geometry: expected columns XX YY ZZ, or Length");
  PlantFileOptions reading;
  reading.topology_alone = true;
  const PlantFile plant = read_plant_file(path, reading);
  EXPECT_EQ(plant.mtg.vertices.size(), 1u);
  EXPECT_THAT(plant.notes, testing::ElementsAre(HasSubstr("topology alone")));
}

TEST(MeshFiles, PropertiesAreCarriedIntoGlbAndPly) {
  Mesh mesh = plant_mesh(read_plant(plants_folder + "grass.bpms"), {1e-3});
  mesh.organs[1].properties = {{"age_d", "12"}, {"cultivar", "line\nbreak"}};
  const Json document = glb_document(mesh_files("a.glb", mesh)[0].bytes);
  EXPECT_EQ(document["nodes"][1]["extras"]["properties"]["age_d"], "12");
  const std::string ply = mesh_files("a.ply", mesh)[0].bytes;
  EXPECT_THAT(ply, HasSubstr("comment property 1 age_d 12\ncomment property 1 cultivar line break\n"));
}

}  // namespace
}  // namespace bpms
