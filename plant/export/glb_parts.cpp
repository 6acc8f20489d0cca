#include "plant/export/glb_parts.h"

#include <bit>
#include <cstring>
#include <limits>

namespace bpms {
namespace {

static_assert(std::endian::native == std::endian::little, "the bytes are written as they lie in memory");

enum Glb { vertex_target = 34962, index_target = 34963, float_type = 5126, unsigned_type = 5125 };

void append_word(std::string& bytes, std::uint32_t word) {
  char raw[sizeof(word)];
  std::memcpy(raw, &word, sizeof(word));
  bytes.append(raw, sizeof(word));
}

}  // namespace

Eigen::Vector3f y_up(const Eigen::Vector3f& z_up) {
  return {z_up.x(), z_up.z(), -z_up.y()};
}

std::size_t GlbBuffer::add(const void* data, std::size_t count, std::size_t components, const char* type,
                           int component_type, int target) {
  const std::size_t offset = bytes.size();
  bytes.append(static_cast<const char*>(data), sizeof(std::uint32_t) * components * count);
  Json view{{"buffer", 0}, {"byteOffset", offset}, {"byteLength", bytes.size() - offset}};
  if (target != 0) view["target"] = target;
  views.push_back(view);
  accessors.push_back({{"bufferView", views.size() - 1},
                       {"componentType", component_type},
                       {"count", type == std::string("SCALAR") ? components * count : count},
                       {"type", type}});
  return accessors.size() - 1;
}

std::size_t GlbBuffer::add_positions(const std::vector<Eigen::Vector3f>& positions) {
  const std::size_t accessor = add(positions.data(), positions.size(), 3, "VEC3", float_type, vertex_target);
  Eigen::Vector3f low = positions.front();
  Eigen::Vector3f high = low;
  for (const Eigen::Vector3f& p : positions) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  accessors[accessor]["min"] = {low.x(), low.y(), low.z()};
  accessors[accessor]["max"] = {high.x(), high.y(), high.z()};
  return accessor;
}

std::size_t GlbBuffer::add_floats(const std::vector<float>& values, std::size_t components,
                                  const char* type) {
  return add(values.data(), values.size() / components, components, type, float_type, 0);
}

Json glb_primitive(GlbBuffer& buffer, const Mesh& mesh, const MeshOfOrgan& part, std::uint32_t material) {
  std::vector<Eigen::Vector3f> positions, normals;
  std::vector<Eigen::Vector2f> uv;
  for (const std::uint32_t vertex : part.vertices) {
    positions.push_back(y_up(mesh.positions_m[vertex]));
    normals.push_back(y_up(mesh.normals[vertex]));
    uv.emplace_back(mesh.uv[vertex].x(), 1 - mesh.uv[vertex].y());  // glTF counts V from the top
  }
  Json attributes{
      {"POSITION", buffer.add_positions(positions)},
      {"NORMAL", buffer.add(normals.data(), normals.size(), 3, "VEC3", float_type, vertex_target)},
      {"TEXCOORD_0", buffer.add(uv.data(), uv.size(), 2, "VEC2", float_type, vertex_target)}};
  const std::size_t indices =
      buffer.add(part.triangles.data(), part.triangles.size(), 3, "SCALAR", unsigned_type, index_target);
  return {{"attributes", attributes}, {"indices", indices}, {"material", material}};
}

Json glb_materials(const std::vector<std::string>& names) {
  Json out = Json::array();
  for (const std::string& name : names) {
    const Eigen::Vector3f colour = viewer_colour(name);
    out.push_back({{"name", name},
                   {"doubleSided", true},
                   {"pbrMetallicRoughness",
                    {{"baseColorFactor", {colour.x(), colour.y(), colour.z(), 1.0}},
                     {"metallicFactor", 0.0},
                     {"roughnessFactor", 0.8}}}});
  }
  return out;
}

Json glb_extras(const Mesh::Organ& organ) {
  Json out{{"organ_id", organ.id},
           {"kind", organ.kind},
           {"material", organ.material},
           {"length_m", organ.length_m},
           {"area_m2", organ.area_m2}};
  for (const auto& property : organ.properties) out["properties"][property.first] = property.second;
  return out;
}

std::string glb_bytes(const Json& document, std::string binary) {
  std::string text = document.dump(-1, ' ', false, Json::error_handler_t::replace);
  text.resize((text.size() + 3) / 4 * 4, ' ');
  binary.resize((binary.size() + 3) / 4 * 4, '\0');
  const std::size_t chunks = 8 + text.size() + (binary.empty() ? 0 : 8 + binary.size());
  if (chunks > std::numeric_limits<std::uint32_t>::max() - 12)
    throw Error(ErrorKind::bad_input, "a GLB file holds 4 GiB at most: write PLY, or fewer plants");
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

}  // namespace bpms
