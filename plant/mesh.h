// A triangle mesh with what must not get lost on the way: organ, material, (U, V), normals.
#pragma once
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace bpms {

struct Mesh {
  std::vector<Eigen::Vector3f> positions_m;
  std::vector<Eigen::Vector3f> normals;  // unit, per vertex: on a leaf, towards its upper face
  std::vector<Eigen::Vector2f> uv;       // U along the length, V across
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<std::uint32_t> organ_of_triangle;  // index into organs
  struct Organ {
    int id = 0;
    std::string label;  // "l3"
    std::string kind;   // "leaf"
    std::string material;
    double length_m = 0;
    double area_m2 = 0;  // one-sided for leaves, total surface for the rest
    using Named = std::vector<std::pair<std::string, std::string>>;
    Named properties = {};  // what the plant text carries along: {"age_d", "12"}
    Named parameters =
        {};                // the attributes as written, {"a_length", "10 cm"}; only where they were asked for
    double volume_m3 = 0;  // of bodies; 0 for sheets
    Eigen::Vector3d centroid_m = Eigen::Vector3d::Zero();  // of the volume; of a sheet: of its area
  };
  std::vector<Organ> organs;
};

double triangle_area_m2(const Mesh& mesh, std::size_t triangle);

}  // namespace bpms
