// Exports, read back by small readers written from the formats' own specifications.
#include "plant/mesh_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <map>
#include <sstream>

#include "core/json.h"
#include "plant/plant_mesh.h"
#include "tests/data.h"

namespace bpms {
namespace {

using enum ErrorKind;
using testing::ElementsAre;
using testing::HasSubstr;

Mesh grass() {
  return plant_mesh(read_plant(std::string(BPMS_SOURCE_DIR) + "/examples/plants/grass.bpms"), {1e-3});
}

template <class T>
T take(const std::string& bytes, std::size_t& at) {
  T out;
  std::memcpy(&out, bytes.data() + at, sizeof(T));
  at += sizeof(T);
  return out;
}

TEST(MeshFile, PlyHoldsEverything) {
  const Mesh mesh = grass();
  const std::vector<MeshFile> files = mesh_files("a/grass.ply", mesh, 7);
  ASSERT_EQ(files.size(), 1u);
  EXPECT_EQ(files[0].path, "a/grass.ply");
  const std::string& bytes = files[0].bytes;
  std::size_t at = bytes.find("end_header\n") + 11;
  const std::string header = bytes.substr(0, at);
  EXPECT_EQ(header.substr(0, 39), "ply\nformat binary_little_endian 1.0\ncom");
  EXPECT_THAT(
      header,
      HasSubstr(fmt::format(
          "element vertex {}\nproperty float x\nproperty float y\nproperty float z\nproperty float nx\n"
          "property float ny\nproperty float nz\nproperty float s\nproperty float t\n",
          mesh.positions_m.size())));
  EXPECT_THAT(header, HasSubstr(fmt::format(
                          "element face {}\nproperty list uchar int vertex_indices\nproperty int organ_id\n"
                          "property int material_id\nproperty int plant_id\n",
                          mesh.triangles.size())));
  EXPECT_THAT(header, HasSubstr("comment organ 4 l3 leaf leaf\n"));
  EXPECT_THAT(header, HasSubstr("comment material 1 leaf\n"));
  for (std::size_t i = 0; i < mesh.positions_m.size(); ++i) {
    for (int k = 0; k < 3; ++k) ASSERT_EQ(take<float>(bytes, at), mesh.positions_m[i][k]);
    for (int k = 0; k < 3; ++k) ASSERT_EQ(take<float>(bytes, at), mesh.normals[i][k]);
    for (int k = 0; k < 2; ++k) ASSERT_EQ(take<float>(bytes, at), mesh.uv[i][k]);
  }
  const std::map<std::string, int> material{{"stem", 0}, {"leaf", 1}, {"head", 2}};
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    ASSERT_EQ(take<std::uint8_t>(bytes, at), 3);
    for (const std::uint32_t vertex : mesh.triangles[t])
      ASSERT_EQ(take<std::int32_t>(bytes, at), static_cast<int>(vertex));
    const Mesh::Organ& organ = mesh.organs[mesh.organ_of_triangle[t]];
    ASSERT_EQ(take<std::int32_t>(bytes, at), organ.id);
    ASSERT_EQ(take<std::int32_t>(bytes, at), material.at(organ.material));
    ASSERT_EQ(take<std::int32_t>(bytes, at), 7);
  }
  EXPECT_EQ(at, bytes.size());
}

TEST(MeshFile, ObjGroupsOrgansAndNamesItsMaterialsRelatively) {
  const Mesh mesh = grass();
  const std::vector<MeshFile> files = mesh_files("some/where/grass.obj", mesh);
  ASSERT_EQ(files.size(), 2u);
  EXPECT_EQ(files[1].path, "some/where/grass.mtl");
  EXPECT_EQ(mesh_file_paths("some/where/grass.obj"),
            (std::vector<std::string>{files[0].path, files[1].path}));
  std::istringstream lines(files[0].bytes);
  std::vector<std::string> groups, materials;
  std::vector<Eigen::Vector3f> v, vn;
  std::vector<Eigen::Vector2f> vt;
  std::size_t faces = 0;
  std::string library, word;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream fields(line);
    fields >> word;
    if (word == "mtllib") fields >> library;
    if (word == "g")
      fields >> word, groups.push_back(word);
    else if (word == "usemtl")
      fields >> word, materials.push_back(word);
    else if (word == "v" || word == "vn") {
      Eigen::Vector3f p;
      fields >> p.x() >> p.y() >> p.z();
      (word == "v" ? v : vn).push_back(p);
    } else if (word == "vt") {
      Eigen::Vector2f p;
      fields >> p.x() >> p.y();
      vt.push_back(p);
    } else if (word == "f") {
      for (std::size_t k = 0; k < 3; ++k) {
        fields >> word;
        const std::string index = std::to_string(mesh.triangles[faces][k] + 1);
        ASSERT_EQ(word, index + "/" + index + "/" + index);
      }
      ++faces;
    }
  }
  EXPECT_EQ(library, "grass.mtl");
  EXPECT_THAT(groups, ElementsAre("s1", "l1", "l2", "s2", "l3", "h1"));
  EXPECT_THAT(materials, ElementsAre("stem", "leaf", "leaf", "stem", "leaf", "head"));
  EXPECT_EQ(faces, mesh.triangles.size());
  EXPECT_EQ(v, mesh.positions_m);
  EXPECT_EQ(vn, mesh.normals);
  EXPECT_EQ(vt, mesh.uv);
  for (const char* name : {"stem", "leaf", "head"})
    EXPECT_THAT(files[1].bytes, HasSubstr(std::string("newmtl ") + name + "\nKd "));
}

TEST(MeshFile, GlbIsValidAndYUp) {
  const Mesh mesh = grass();
  const std::string bytes = mesh_files("grass.glb", mesh)[0].bytes;
  std::size_t at = 0;
  EXPECT_EQ(bytes.substr(0, 4), "glTF");
  at = 4;
  EXPECT_EQ(take<std::uint32_t>(bytes, at), 2u);
  EXPECT_EQ(take<std::uint32_t>(bytes, at), bytes.size());
  const auto json_size = take<std::uint32_t>(bytes, at);
  EXPECT_EQ(json_size % 4, 0u);
  EXPECT_EQ(bytes.substr(at, 4), "JSON");
  at += 4;
  const Json document = Json::parse(bytes.substr(at, json_size));
  at += json_size;
  const auto binary_size = take<std::uint32_t>(bytes, at);
  EXPECT_EQ(bytes.substr(at, 4), std::string("BIN\0", 4));
  at += 4;
  EXPECT_EQ(at + binary_size, bytes.size());
  EXPECT_EQ(document["buffers"][0]["byteLength"], binary_size);
  EXPECT_EQ(document["asset"]["version"], "2.0");

  const auto value = [&](std::size_t accessor, std::size_t element) {
    const Json& a = document["accessors"][accessor];
    const Json& view = document["bufferViews"][a["bufferView"].get<std::size_t>()];
    const std::map<std::string, std::size_t> components{{"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}};
    const std::size_t count = components.at(a["type"]);
    EXPECT_EQ(view["byteLength"], a["count"].get<std::size_t>() * count * 4);
    EXPECT_EQ(view["byteOffset"].get<std::size_t>() % 4, 0u);
    return at + view["byteOffset"].get<std::size_t>() + element * count * 4;
  };
  std::size_t triangles = 0;
  std::vector<std::string> names;
  for (const Json& node : document["nodes"]) {
    if (!node.contains("mesh")) continue;
    names.push_back(node["name"]);
    const Json& primitive = document["meshes"][node["mesh"].get<std::size_t>()]["primitives"][0];
    const Mesh::Organ& organ = mesh.organs[node["extras"]["organ_id"].get<std::size_t>()];
    EXPECT_EQ(document["materials"][primitive["material"].get<std::size_t>()]["name"], organ.material);
    EXPECT_EQ(document["materials"][primitive["material"].get<std::size_t>()]["doubleSided"], true);
    const std::size_t positions = primitive["attributes"]["POSITION"];
    const std::size_t indices = primitive["indices"];
    const std::size_t vertex_count = document["accessors"][positions]["count"];
    Eigen::Vector3f low = Eigen::Vector3f::Constant(1e9f), high = -low;
    for (std::size_t i = 0; i < vertex_count; ++i) {
      std::size_t place = value(positions, i);
      Eigen::Vector3f p;
      for (int k = 0; k < 3; ++k) p[k] = take<float>(bytes, place);
      low = low.cwiseMin(p), high = high.cwiseMax(p);
    }
    for (int k = 0; k < 3; ++k) {
      EXPECT_EQ(document["accessors"][positions]["min"][static_cast<std::size_t>(k)].get<float>(), low[k]);
      EXPECT_EQ(document["accessors"][positions]["max"][static_cast<std::size_t>(k)].get<float>(), high[k]);
    }
    EXPECT_GE(low.y(), -0.005f);  // up is y: plants stand on y = 0 (a stem's lid may dip by its radius)
    double area = 0;
    const std::size_t count = document["accessors"][indices]["count"];
    for (std::size_t i = 0; i < count; i += 3) {
      Eigen::Vector3f corner[3];
      for (std::size_t k = 0; k < 3; ++k) {
        std::size_t place = value(indices, i + k);
        const auto vertex = take<std::uint32_t>(bytes, place);
        ASSERT_LT(vertex, vertex_count);
        place = value(positions, vertex);
        for (int c = 0; c < 3; ++c) corner[k][c] = take<float>(bytes, place);
      }
      area += static_cast<double>((corner[1] - corner[0]).cross(corner[2] - corner[0]).norm()) / 2;
    }
    EXPECT_NEAR(area, organ.area_m2, 1e-6 * organ.area_m2 + 1e-9);
    triangles += count / 3;
  }
  EXPECT_EQ(triangles, mesh.triangles.size());
  EXPECT_THAT(names, ElementsAre("s1", "l1", "l2", "s2", "l3", "h1"));
  // A rotation, not a mirror: the leaf that leans to +x and up (z) has its tip at +x and +y.
  const Json& root = document["nodes"][document["scenes"][0]["nodes"][0].get<std::size_t>()];
  EXPECT_EQ(root["children"].size(), mesh.organs.size());
}

TEST(MeshFile, GlbTurnsNorthToMinusZ) {
  const Mesh mesh = plant_mesh(
      parse_plant("l.bpms", "units m [+l] + { a_twist 90 } l { a_length 1 a_width 0.1 a_inclination 90 }"));
  const std::string bytes = mesh_files("l.glb", mesh)[0].bytes;
  std::size_t at = 12;
  const auto json_size = take<std::uint32_t>(bytes, at);
  const Json document = Json::parse(bytes.substr(20, json_size));
  const Json& low = document["accessors"][0]["min"];
  EXPECT_NEAR(low[2].get<double>(), -1, 1e-6);  // the tip lies to the north
  EXPECT_NEAR(document["accessors"][0]["max"][1].get<double>(), 0, 1e-6);
}

TEST(MeshFile, PlantsWithoutSurfaceAndUnknownKindsOfFiles) {
  const Mesh nothing = plant_mesh(parse_plant("s.bpms", "s"));
  EXPECT_EQ(nothing.organs.size(), 1u);
  for (const char* name : {"a.ply", "a.obj", "a.glb"})
    EXPECT_FALSE(mesh_files(name, nothing)[0].bytes.empty());
  const std::string glb = mesh_files("a.glb", nothing)[0].bytes;
  EXPECT_THAT(glb, testing::Not(HasSubstr("[]")));  // empty arrays are not valid glTF
  BPMS_EXPECT_ERROR(mesh_files("a.plyy", nothing), bad_input,
                    "a.plyy: unknown kind of mesh file '.plyy'; did you mean '.ply'?");
}

}  // namespace
}  // namespace bpms
