// The parts of a glTF file: its one buffer, primitives, materials, what is carried along, the two chunks.
#pragma once
#include "core/json.h"
#include "plant/export/formats.h"

namespace bpms {

// The buffer with its views and accessors; every element is of 4-byte numbers, so all offsets stay aligned.
struct GlbBuffer {
  // Numbers as they lie in memory; `target` 0: neither vertices nor indices.
  std::size_t add(const void* data, std::size_t count, std::size_t components, const char* type,
                  int component_type, int target);
  std::size_t add_positions(const std::vector<Eigen::Vector3f>& positions);  // with least and largest
  std::size_t add_floats(const std::vector<float>& values, std::size_t components, const char* type);
  std::string bytes;
  Json views = Json::array();
  Json accessors = Json::array();
};

Eigen::Vector3f y_up(const Eigen::Vector3f& z_up);
Json glb_primitive(GlbBuffer& buffer, const Mesh& mesh, const MeshOfOrgan& part, std::uint32_t material);
Json glb_materials(const std::vector<std::string>& names);
Json glb_extras(const Mesh::Organ& organ);  // id, kind, sizes, what the plant carries along
std::string glb_bytes(const Json& document, std::string binary);

}  // namespace bpms
