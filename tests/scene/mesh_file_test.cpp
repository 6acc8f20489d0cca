// Meshes of other programs: a glTF with a hierarchy of nodes, and sizes that are noted.
#include "scene/importers/mesh_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>

#include "core/error.h"
#include "scene/intersect/intersector.h"
#include "scene/scene.h"
#include "tests/data.h"

namespace bpms {
namespace {

std::string base64(const std::string& bytes) {
  static const char* const letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t word = 0;
    for (std::size_t k = 0; k < 3; ++k)
      word = word << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k)
      out += i + k <= bytes.size() ? letters[word >> (18 - 6 * k) & 63u] : '=';
  }
  return out;
}

template <class T>
void append(std::string& out, std::initializer_list<T> values) {
  for (const T value : values) {
    char raw[sizeof(T)];
    std::memcpy(raw, &value, sizeof(T));
    out.append(raw, sizeof(T));
  }
}

// One right triangle in the plane z = 0 (glTF: y up), its normal towards +z, on two nodes below a parent: one
// turned upright to face the sky, one mirrored in x.
std::string gltf() {
  std::string buffer;
  append<float>(buffer, {0, 0, 0, 2, 0, 0, 0, 1, 0});  // positions
  append<float>(buffer, {0, 0, 1, 0, 0, 1, 0, 0, 1});  // normals
  append<float>(buffer, {0, 0, 1, 0, 0, 0.25f});       // (u, v), v downwards
  append<std::uint16_t>(buffer, {0, 1, 2});
  const char* view = R"({{"buffer":0,"byteOffset":{},"byteLength":{}}})";
  const char* accessor = R"({{"bufferView":{},"componentType":{},"count":3,"type":"{}"{}}})";
  std::string text = R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],
"nodes":[{"name":"plant","translation":[0,5,0],"scale":[2,2,2],"children":[1,2]},
{"name":"lying","rotation":[-0.70710678,0,0,0.70710678],"mesh":0},
{"name":"mirrored","translation":[10,0,0],"scale":[-1,1,1],"mesh":0}],
"materials":[{"name":"my_leaf"}],
"meshes":[{"name":"blade","primitives":[{"attributes":{"POSITION":0,"NORMAL":1,"TEXCOORD_0":2},"indices":3,"material":0}]}],
)";
  text += fmt::format(
      "\"buffers\":[{{\"byteLength\":{},\"uri\":\"data:application/octet-stream;base64,{}\"}}],\n",
      buffer.size(), base64(buffer));
  text += "\"bufferViews\":[" + fmt::format(fmt::runtime(view), 0, 36) + "," +
          fmt::format(fmt::runtime(view), 36, 36) + "," + fmt::format(fmt::runtime(view), 72, 24) + "," +
          fmt::format(fmt::runtime(view), 96, 6) + "],\n";
  text += "\"accessors\":[" +
          fmt::format(fmt::runtime(accessor), 0, 5126, "VEC3", ",\"min\":[0,0,0],\"max\":[2,1,0]") + "," +
          fmt::format(fmt::runtime(accessor), 1, 5126, "VEC3", "") + "," +
          fmt::format(fmt::runtime(accessor), 2, 5126, "VEC2", "") + "," +
          fmt::format(fmt::runtime(accessor), 3, 5123, "SCALAR", "") + "]}\n";
  return text;
}

TEST(MeshFile, TakesAHierarchyOfNodesWithYUp) {
  const test::TemporaryFolder folder;
  folder.write("plant.gltf", gltf());
  const Scene scene = read_scene_geometry(TomlDocument::read(folder.write(
      "scene.toml",
      "[domain]\nboundary = \"open\"\n[materials.green]\n[prototypes.plant]\nmesh = \"plant.gltf\"\n"
      "materials = { my_leaf = \"green\" }\n[[instances]]\nprototype = \"plant\"\npositions = [[0, 0, "
      "0]]\n")));
  const Mesh& mesh = *scene.prototypes[0].mesh;
  ASSERT_EQ(mesh.triangles.size(), 2u);
  EXPECT_EQ(mesh.organs[0].kind, "leaf");
  EXPECT_NEAR(mesh.organs[0].area_m2, 4, 1e-6);  // 1 m2, twice as long and as wide
  const Intersector intersector(scene);
  // glTF's y is our z, its z our -y. The lying one: (x, y, 0) -> (x, 0, -y) in the file, up to (4, -2) at
  // height 5 * 1 (the parent's translation) here: x in [0, 4], y in [0, 2], facing up.
  Hit hit;
  ASSERT_EQ(intersector.intersect({{0.5f, 0.25f, 20}, {0, 0, -1}, 1e30f, {}}, hit), Escape::hit);
  EXPECT_NEAR(hit.position.z(), 5, 1e-5);
  EXPECT_TRUE(hit.front);
  EXPECT_NEAR(hit.geometric_normal.z(), 1, 1e-5);
  EXPECT_NEAR(hit.uv.x(), 0.5 / 4, 1e-5);
  EXPECT_NEAR(hit.uv.y(), 1 - 0.25 * 0.25 / 2, 1e-5);  // V runs upwards: 1 - v
  EXPECT_EQ(intersector.intersect({{0.5f, -0.25f, 20}, {0, 0, -1}, 1e30f, {}}, hit), Escape::bottom);
  // The mirrored one stands in the plane y = 0 from x = 20 to 16, facing -y still.
  ASSERT_EQ(intersector.intersect({{19, -5, 5.5f}, {0, 1, 0}, 1e30f, {}}, hit), Escape::hit);
  EXPECT_TRUE(hit.front);
  EXPECT_NEAR(hit.position.y(), 0, 1e-5);
  EXPECT_NEAR(hit.geometric_normal.y(), -1, 1e-5);
  EXPECT_NEAR(hit.dp_du.x(), -4, 1e-4);
  EXPECT_NE(intersector.intersect({{21, -5, 5.5f}, {0, 1, 0}, 1e30f, {}}, hit), Escape::hit);
}

TEST(MeshFile, TurnsFacesOfMirroredNodesWithoutNormals) {
  std::string text = gltf();
  const std::string normals = "\"NORMAL\":1,";
  text.erase(text.find(normals), normals.size());
  const test::TemporaryFolder folder;
  const auto mesh = read_mesh_file(folder.write("plant.gltf", text), 1, true);
  ASSERT_TRUE(mesh->normals.empty());
  ASSERT_EQ(mesh->triangles.size(), 2u);
  const auto normal = [&](std::size_t k) {
    const auto& [a, b, c] = mesh->triangles[k];
    const Eigen::Vector3f& p = mesh->positions_m[a];
    return Eigen::Vector3f((mesh->positions_m[b] - p).cross(mesh->positions_m[c] - p).normalized());
  };
  EXPECT_LT((normal(0) - Eigen::Vector3f(0, 0, 1)).norm(), 1e-5);
  EXPECT_LT((normal(1) - Eigen::Vector3f(0, -1, 0)).norm(), 1e-5);
}

TEST(MeshFile, SaysWhichFaceOfAnObjNamesWhatIsNotThere) {
  const std::string sound = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\n";
  const auto refused = [&](const std::string& faces) {
    try {
      parse_mesh("a.obj", sound + faces, 1, false);
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(refused("f 1//1 2//1 3//1\n"), "");
  EXPECT_EQ(refused("f -3//-1 -2//-1 -1//-1\n"), "");
  EXPECT_EQ(refused("f 1 2 4\nv 1 1 0\n"), "");  // stands further down
  const auto at = [](const char* place, const char* what) {
    return ::testing::AllOf(::testing::HasSubstr(place), ::testing::HasSubstr(what));
  };
  EXPECT_THAT(refused("f 1 2 7\n"), at("a.obj:5:7", "number 7 of the vertices, expected 1 to 3 or -1 to -3"));
  EXPECT_THAT(refused("f 1 2 3\nf 1 0 3\n"), at("a.obj:6:5", "number 0 of the vertices"));
  EXPECT_THAT(refused("f 1 2 -4\n"), at("a.obj:5:7", "number -4"));
  EXPECT_THAT(refused("f 1//1 2//1 3//2\n"), at("a.obj:5:13", "number 2 of the normals, expected 1 to 1"));
  EXPECT_THAT(refused("f 1/1 2/1 3/1\n"), at("a.obj:5:3", "number 1 of the texture coordinates"));
  EXPECT_THAT(refused("f 1 2 x\n"), at("a.obj:5:7", "'x' in a face"));
  EXPECT_THAT(refused("f 1 2 3//1/1\n"), at("a.obj:5:7", "expected vertex/texture/normal"));
}

TEST(MeshFile, KnowsWhichWayIsUp) {
  EXPECT_TRUE(mesh_file_is_y_up("a/b.GLB"));
  EXPECT_TRUE(mesh_file_is_y_up("b.gltf"));
  EXPECT_FALSE(mesh_file_is_y_up("b.obj"));
  EXPECT_FALSE(mesh_file_is_y_up("b.ply"));
}

TEST(SceneNotes, NameSizesThatNoLeafHas) {
  const test::TemporaryFolder folder;
  folder.write("leaf.obj", "o leaf1\nv 0 0 0\nv 2 0 0\nv 0 1 0\nf 1 2 3\n");
  folder.write("fine.obj", "o stem\nv 0 0 0\nv 2 0 0\nv 0 1 0\nf 1 2 3\n");
  const auto notes = [&](const std::string& file, const std::string& scale, const std::string& size) {
    return read_scene_geometry(
               TomlDocument::read(folder.write(
                   "scene.toml", "[domain]\nsize_m = [" + size +
                                     ", 10]\n[materials.green]\n[prototypes.plant]\nmesh = \"" + file +
                                     "\"\nmaterial = \"green\"\n[[instances]]\nprototype = \"plant\"\n"
                                     "positions = [[0, 0, 0]]\nscale = " +
                                     scale + "\n")))
        .notes;
  };
  EXPECT_TRUE(notes("leaf.obj", "1", "10").empty());
  EXPECT_THAT(notes("leaf.obj", "6", "10"),
              ::testing::ElementsAre("prototype 'plant' has a leaf of 12 m: check its unit"));
  EXPECT_TRUE(notes("fine.obj", "6", "10").empty());
  EXPECT_THAT(notes("leaf.obj", "1e-6", "1"), ::testing::Contains(::testing::HasSubstr("a leaf of 2e-06 m")));
  EXPECT_THAT(
      notes("fine.obj", "1e-6", "100"),
      ::testing::ElementsAre("prototype 'plant' stands 2e-06 m wide in a domain of 100 m, a million times as "
                             "wide: check its unit"));
}

TEST(SceneNotes, NothingAtAllIsRefused) {
  BPMS_EXPECT_ERROR(read_scene_geometry(TomlDocument::parse("s.toml", "[domain]\nsize_m = [1, 1]\n")),
                    ErrorKind::bad_input, "an empty scene");
  BPMS_EXPECT_ERROR(
      read_scene_geometry(TomlDocument::parse("s.toml", "[domain]\nsize_m = [1, 1]\n[grund]\n")),
      ErrorKind::bad_input, "grund");
}

}  // namespace
}  // namespace bpms
