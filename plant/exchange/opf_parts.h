// What an OPF file says, before its nodes become a mesh.
#pragma once
#include <map>

#include "plant/opf.h"

namespace bpms {

struct OpfReferenceMesh {
  std::vector<Eigen::Vector3d> points, normals;
  std::vector<Eigen::Vector2d> uv;
  std::vector<std::array<std::uint32_t, 3>> faces;
  double least_x = 0, most_x = 0;
  SourceLocation where;
};

struct OpfShape {
  std::string name;
  long long mesh = -1, material = -1;
  SourceLocation where;
};

struct OpfNode {  // a vertex with a shape
  std::size_t vertex = 0;
  long long shape = -1;
  Eigen::Matrix<double, 3, 4> matrix = Eigen::Matrix<double, 3, 4>::Identity();
  bool tapered = true;
  double down = 1, up = 1;  // factors across the x axis at its lower and its upper end
  SourceLocation where;
};

struct OpfParts {
  std::map<long long, OpfReferenceMesh> meshes;
  std::map<long long, std::string> materials;  // names; often empty
  std::map<long long, OpfShape> shapes;
  std::vector<OpfNode> nodes;
  Mtg mtg;
  std::vector<std::string> notes;
};

OpfParts parse_opf_parts(const std::string& path, std::string_view text);
// Checks that shapes have their meshes and materials, then places every node's copy.
void place_opf_nodes(const OpfParts& parts, const OpfOptions& options, OpfPlant& out);

}  // namespace bpms
