// glTF 2.0 in one binary file: a node an organ, named; a double-sided material a material; y up, as glTF
// demands. Specification: Khronos glTF 2.0 (ISO/IEC 12113), sections 3.6 (accessors) and 4 (GLB).
#include <bit>
#include <cstring>

#include "core/json.h"
#include "core/provenance.h"
#include "plant/export/formats.h"

namespace bpms {
namespace {

static_assert(std::endian::native == std::endian::little, "the bytes are written as they lie in memory");

enum Glb { vertex_target = 34962, index_target = 34963, float_type = 5126, unsigned_type = 5125 };

Eigen::Vector3f y_up(const Eigen::Vector3f& v) {
  return {v.x(), v.z(), -v.y()};
}

void append_word(std::string& bytes, std::uint32_t word) {
  char raw[sizeof(word)];
  std::memcpy(raw, &word, sizeof(word));
  bytes.append(raw, sizeof(word));
}

// The buffer with its views and accessors; every element is of 4-byte numbers, so all offsets stay aligned.
class Buffer {
 public:
  template <class Element>
  std::size_t add(const std::vector<Element>& elements, int components, const char* type, int component_type,
                  int target) {
    const std::size_t offset = bytes_.size();
    for (const Element& element : elements)
      bytes_.append(reinterpret_cast<const char*>(element.data()),
                    sizeof(std::uint32_t) * static_cast<std::size_t>(components));
    views_.push_back(
        {{"buffer", 0}, {"byteOffset", offset}, {"byteLength", bytes_.size() - offset}, {"target", target}});
    accessors_.push_back({{"bufferView", views_.size() - 1},
                          {"componentType", component_type},
                          {"count", elements.size()},
                          {"type", type}});
    return accessors_.size() - 1;
  }
  std::size_t add_positions(const std::vector<Eigen::Vector3f>& positions) {
    const std::size_t accessor = add(positions, 3, "VEC3", float_type, vertex_target);
    Eigen::Vector3f low = positions.front();
    Eigen::Vector3f high = low;
    for (const Eigen::Vector3f& p : positions) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
    accessors_[accessor]["min"] = {low.x(), low.y(), low.z()};
    accessors_[accessor]["max"] = {high.x(), high.y(), high.z()};
    return accessor;
  }
  std::size_t add_indices(const std::vector<std::array<std::uint32_t, 3>>& triangles) {
    const std::size_t accessor = add(triangles, 3, "SCALAR", unsigned_type, index_target);
    accessors_[accessor]["count"] = 3 * triangles.size();
    return accessor;
  }
  std::string bytes_;
  Json views_ = Json::array();
  Json accessors_ = Json::array();
};

Json primitive(Buffer& buffer, const Mesh& mesh, const MeshOfOrgan& part, std::uint32_t material) {
  std::vector<Eigen::Vector3f> positions, normals;
  std::vector<Eigen::Vector2f> uv;
  for (const std::uint32_t vertex : part.vertices) {
    positions.push_back(y_up(mesh.positions_m[vertex]));
    normals.push_back(y_up(mesh.normals[vertex]));
    uv.emplace_back(mesh.uv[vertex].x(), 1 - mesh.uv[vertex].y());  // glTF counts V from the top
  }
  Json attributes{{"POSITION", buffer.add_positions(positions)},
                  {"NORMAL", buffer.add(normals, 3, "VEC3", float_type, vertex_target)},
                  {"TEXCOORD_0", buffer.add(uv, 2, "VEC2", float_type, vertex_target)}};
  return {
      {"attributes", attributes}, {"indices", buffer.add_indices(part.triangles)}, {"material", material}};
}

std::string glb(const Json& document, std::string binary) {
  std::string text = document.dump();
  text.resize((text.size() + 3) / 4 * 4, ' ');
  binary.resize((binary.size() + 3) / 4 * 4, '\0');
  const std::size_t chunks = 8 + text.size() + (binary.empty() ? 0 : 8 + binary.size());
  std::string out = "glTF";
  append_word(out, 2);
  append_word(out, static_cast<std::uint32_t>(12 + chunks));
  append_word(out, static_cast<std::uint32_t>(text.size()));
  out += "JSON" + text;
  if (!binary.empty()) {
    append_word(out, static_cast<std::uint32_t>(binary.size()));
    out += std::string("BIN\0", 4) + binary;
  }
  return out;
}

}  // namespace

std::vector<MeshFile> glb_files(const std::string& path, const Mesh& mesh, int plant_id) {
  const MeshMaterials materials = mesh_materials(mesh);
  const std::vector<MeshOfOrgan> parts = split_by_organ(mesh);
  Buffer buffer;
  Json nodes = Json::array(), meshes = Json::array(), children = Json::array(), looks = Json::array();
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const Mesh::Organ& organ = mesh.organs[i];
    Json node{{"name", organ.label}};
    if (!parts[i].triangles.empty()) {
      meshes.push_back(
          {{"name", organ.label},
           {"primitives", Json::array({primitive(buffer, mesh, parts[i], materials.of_organ[i])})}});
      node["mesh"] = meshes.size() - 1;
    }
    node["extras"] = {{"organ_id", organ.id}, {"kind", organ.kind},         {"material", organ.material},
                      {"plant_id", plant_id}, {"length_m", organ.length_m}, {"area_m2", organ.area_m2}};
    children.push_back(nodes.size());
    nodes.push_back(node);
  }
  for (const std::string& name : materials.names) {
    const Eigen::Vector3f colour = viewer_colour(name);
    looks.push_back({{"name", name},
                     {"doubleSided", true},
                     {"pbrMetallicRoughness",
                      {{"baseColorFactor", {colour.x(), colour.y(), colour.z(), 1.0}},
                       {"metallicFactor", 0.0},
                       {"roughnessFactor", 0.8}}}});
  }
  Json root{{"name", fmt::format("plant{}", plant_id)}};
  if (!children.empty()) root["children"] = children;  // empty arrays are not valid glTF
  nodes.push_back(root);
  Json document{{"asset", {{"version", "2.0"}, {"generator", "bpms " + version()}}},
                {"scene", 0},
                {"scenes", Json::array({Json{{"nodes", Json::array({nodes.size() - 1})}}})},
                {"nodes", nodes}};
  if (!looks.empty()) document["materials"] = looks;
  if (!meshes.empty()) {
    document["meshes"] = meshes;
    document["accessors"] = buffer.accessors_;
    document["bufferViews"] = buffer.views_;
    document["buffers"] = Json::array({Json{{"byteLength", buffer.bytes_.size()}}});
  }
  return {{path, glb(document, buffer.bytes_)}};
}

}  // namespace bpms
