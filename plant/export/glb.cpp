// glTF 2.0 in one binary file: a node an organ, named; a double-sided material a material; y up, as glTF
// demands. Specification: Khronos glTF 2.0 (ISO/IEC 12113), sections 3.6 (accessors) and 4 (GLB).
#include "core/provenance.h"
#include "plant/export/glb_parts.h"

namespace bpms {

std::vector<MeshFile> glb_files(const std::string& path, const Mesh& mesh, int plant_id) {
  const MeshMaterials materials = mesh_materials(mesh);
  const std::vector<MeshOfOrgan> parts = split_by_organ(mesh);
  GlbBuffer buffer;
  Json nodes = Json::array(), meshes = Json::array(), children = Json::array();
  const Json looks = glb_materials(materials.names);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const Mesh::Organ& organ = mesh.organs[i];
    Json node{{"name", organ.label}};
    if (!parts[i].triangles.empty()) {
      meshes.push_back(
          {{"name", organ.label},
           {"primitives", Json::array({glb_primitive(buffer, mesh, parts[i], materials.of_organ[i])})}});
      node["mesh"] = meshes.size() - 1;
    }
    node["extras"] = glb_extras(organ);
    node["extras"]["plant_id"] = plant_id;
    children.push_back(nodes.size());
    nodes.push_back(node);
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
    document["accessors"] = buffer.accessors;
    document["bufferViews"] = buffer.views;
    document["buffers"] = Json::array({Json{{"byteLength", buffer.bytes.size()}}});
  }
  return {{path, glb_bytes(document, buffer.bytes)}};
}

}  // namespace bpms
