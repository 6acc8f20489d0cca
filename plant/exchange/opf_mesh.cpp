// The surface of an OPF plant: each node's reference mesh is tapered across its x axis, then placed by the
// node's matrix.
#include <algorithm>
#include <set>

#include "plant/exchange/opf_parts.h"

namespace bpms {

std::string kind_of_class(std::string_view name) {
  std::string low(name);
  std::transform(low.begin(), low.end(), low.begin(), [](unsigned char c) { return std::tolower(c); });
  const auto has = [&](std::initializer_list<const char*> words) {
    return std::any_of(words.begin(), words.end(),
                       [&](const char* word) { return low.find(word) != std::string::npos; });
  };
  if (has({"leaf", "leaves", "feuille", "blade", "lamina"})) return "leaf";
  if (has({"fruit", "flower", "inflo", "spike", "panicle", "head"})) return "head";
  if (low == "bud") return "bud";
  if (has({"metamer", "internode", "stem", "axis", "trunk", "branch", "entrenoeud", "petiole", "rachis",
           "phytomer"}) ||
      low == "gu")
    return "stem";
  return "mesh";
}

namespace {

void check_opf_references(const OpfParts& parts) {
  for (const auto& [id, shape] : parts.shapes) {
    if (parts.meshes.count(shape.mesh) == 0)
      bad_input(shape.where, "shape {}: there is no mesh with Id {} in meshBDD", id, shape.mesh);
    if (parts.materials.count(shape.material) == 0)
      bad_input(shape.where, "shape {}: there is no material with Id {} in materialBDD", id, shape.material);
  }
  for (const OpfNode& node : parts.nodes)
    if (parts.shapes.count(node.shape) == 0)
      bad_input(node.where, "there is no shape with Id {} in shapeBDD", node.shape);
}

// A material's own name; else the kind of the organs that all have it, when it is one kind; else its number.
std::map<long long, std::string> opf_material_names(const OpfParts& parts) {
  std::map<long long, std::set<std::string>> kinds;
  for (const OpfNode& node : parts.nodes)
    kinds[parts.shapes.at(node.shape).material].insert(
        kind_of_class(parts.mtg.classes[parts.mtg.vertices[node.vertex].symbol].symbol));
  std::map<long long, std::string> out;
  std::set<std::string> taken;
  for (const auto& [id, name] : parts.materials) taken.insert(name);
  for (const auto& [id, name] : parts.materials) {
    std::string& mine = out[id];
    mine = name;
    if (mine.empty() && kinds[id].size() == 1 && taken.insert(*kinds[id].begin()).second)
      mine = *kinds[id].begin();
    if (mine.empty()) mine = fmt::format("material{}", id);
  }
  return out;
}

struct OpfPlacing {
  const OpfReferenceMesh& mesh;
  const OpfNode& node;
  double metres;

  double factor(double x) const {
    const double length = mesh.most_x - mesh.least_x;
    if (!node.tapered) return 1;
    return length > 0 ? node.down + (node.up - node.down) * (x - mesh.least_x) / length : node.down;
  }
  Eigen::Vector3d point(const Eigen::Vector3d& p) const {
    const double f = factor(p.x());
    return metres * (node.matrix * Eigen::Vector4d(p.x(), f * p.y(), f * p.z(), 1));
  }
  // Normals turn by the inverse transpose of how the place moves the surface.
  Eigen::Vector3d normal(const Eigen::Vector3d& p, const Eigen::Vector3d& n) const {
    const double length = mesh.most_x - mesh.least_x;
    const double rate = node.tapered && length > 0 ? (node.up - node.down) / length : 0;
    const double f = factor(p.x());
    Eigen::Matrix3d taper;
    taper << 1, 0, 0, rate * p.y(), f, 0, rate * p.z(), 0, f;
    const Eigen::Matrix3d whole = node.matrix.leftCols<3>() * taper;
    // The cofactors are det times the inverse transpose, and need no inverse.
    Eigen::Matrix3d cofactors;
    cofactors.col(0) = whole.col(1).cross(whole.col(2));
    cofactors.col(1) = whole.col(2).cross(whole.col(0));
    cofactors.col(2) = whole.col(0).cross(whole.col(1));
    const Eigen::Vector3d out = (mirrored() ? -1 : 1) * (cofactors * n);
    return out.norm() > 0 && out.allFinite() ? out.normalized() : Eigen::Vector3d::UnitZ();
  }
  bool mirrored() const { return node.matrix.leftCols<3>().determinant() < 0; }
};

}  // namespace

void place_opf_nodes(const OpfParts& parts, const OpfOptions& options, OpfPlant& out) {
  constexpr std::size_t most_vertices = 200'000'000;
  constexpr double farthest_m = 1e7;
  check_opf_references(parts);
  const std::map<long long, std::string> materials = opf_material_names(parts);
  out.organ_of_vertex.assign(parts.mtg.vertices.size(), -1);
  const auto length_feature = parts.mtg.feature("Length");
  for (const OpfNode& node : parts.nodes) {
    const OpfShape& shape = parts.shapes.at(node.shape);
    const OpfReferenceMesh& reference = parts.meshes.at(shape.mesh);
    const OpfPlacing place{reference, node, options.metres_per_unit};
    const auto first = static_cast<std::uint32_t>(out.mesh.positions_m.size());
    if (first + reference.points.size() > most_vertices)
      bad_input(node.where, "more than {} vertices", most_vertices);
    for (std::size_t i = 0; i < reference.points.size(); ++i) {
      const Eigen::Vector3d p = place.point(reference.points[i]);
      if (!(p.cwiseAbs().maxCoeff() < farthest_m))
        bad_input(node.where, "a point of this node lies beyond 1e7 m");
      out.mesh.positions_m.push_back(p.cast<float>());
      out.mesh.normals.push_back(place.normal(reference.points[i], reference.normals[i]).cast<float>());
      out.mesh.uv.push_back(reference.uv[i].cast<float>());
    }
    const auto index = static_cast<std::uint32_t>(out.mesh.organs.size());
    Mesh::Organ organ;
    organ.id = static_cast<int>(index);
    organ.label = parts.mtg.label(node.vertex);
    organ.kind = kind_of_class(parts.mtg.classes[parts.mtg.vertices[node.vertex].symbol].symbol);
    organ.material = materials.at(shape.material);
    organ.length_m = parts.mtg.number(node.vertex, length_feature).value_or(0) * options.metres_per_unit;
    for (const MtgValue& value : parts.mtg.vertices[node.vertex].values)
      organ.properties.emplace_back(parts.mtg.features[value.feature].name, value.text);
    const bool turned = place.mirrored();
    for (const auto& face : reference.faces) {
      out.mesh.triangles.push_back(
          {first + face[0], first + face[turned ? 2 : 1], first + face[turned ? 1 : 2]});
      const double area = triangle_area_m2(out.mesh, out.mesh.triangles.size() - 1);
      if (area == 0) {  // as in our own meshes: no surface, and no normal to shade it by
        out.mesh.triangles.pop_back();
        continue;
      }
      organ.area_m2 += area;
      out.mesh.organ_of_triangle.push_back(index);
    }
    out.mesh.organs.push_back(std::move(organ));
    out.organ_of_vertex[node.vertex] = static_cast<std::int32_t>(index);
  }
}

}  // namespace bpms
