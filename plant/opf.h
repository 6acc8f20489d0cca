// Plants and stands of the AMAP family (Xplo, Simeo, Archimed): OPF, a plant's topology with a reference mesh
// and a 3 x 4 matrix for each organ (XML), and OPS, where such plants stand (text). Interfaces as public
// readers of the formats document them; docs/exchange.md says what is read and written.
#pragma once
#include <Eigen/Geometry>
#include <string>
#include <string_view>
#include <vector>

#include "plant/mesh.h"
#include "plant/mtg.h"

namespace bpms {

struct OpfOptions {
  double metres_per_unit = 0.01;  // OPF has no unit of its own; the family's programs write centimetres
};

struct OpfPlant {
  Mesh mesh;  // an organ for each node with a shape; its kind by the class's name, its attributes carried
              // along
  Mtg mtg;    // the topology; indices are the file's ids
  std::vector<std::int32_t> organ_of_vertex;  // -1: no surface
  std::vector<std::string> notes;
};

// A mesh, shape or material that is not there, a matrix that is not 12 numbers, attributes that are not of
// their type: bad_input with line and column.
OpfPlant read_opf(const std::string& path, const OpfOptions& options = {});
OpfPlant parse_opf(const std::string& path, std::string_view text, const OpfOptions& options = {});
// A reference mesh for each organ, identity matrices. `organ_of_vertex` as in OpfPlant.
std::string opf_text(const Mesh& mesh, const Mtg& mtg, const std::vector<std::int32_t>& organ_of_vertex,
                     const OpfOptions& options = {});

// The kind of organ that a class's name speaks of: "Leaf" -> "leaf", "Metamer" -> "stem"; "mesh" for others.
std::string kind_of_class(std::string_view name);

struct OpsRow {
  long long scene = 1, plant = 0;
  std::string file;  // as written, relative to the OPS file
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();
  double scale = 1;
  double lean_azimuth = 0;  // radians: direction of the lean, right-handed about z from x
  double lean = 0;          // radians from the vertical
  double twist = 0;         // radians about the plant's own axis
  std::string group;        // functional group, of the line "#[Archimed] NAME" above
  Eigen::Affine3d world_from_plant() const;
};

struct OpsScene {
  Eigen::Vector3d origin_m = Eigen::Vector3d::Zero();
  Eigen::Vector2d size_m = Eigen::Vector2d::Zero();  // 0: not given
  std::vector<OpsRow> rows;
};

OpsScene read_ops(const std::string& path);
OpsScene parse_ops(const std::string& path, std::string_view text);
std::string ops_text(const OpsScene& scene);

}  // namespace bpms
