// What an organ's rows in Mesh::organs say beyond its triangles.
#pragma once
#include "plant/geometry/mesh_parts.h"
#include "plant/mesh.h"

namespace bpms {

// The attributes of an organ as its plant would be written, lengths with their unit.
Mesh::Organ::Named organ_parameters(const OrganAttributes& attributes, const std::string& unit);

// The dead part of a leaf, l > 1 - a_senescent, becomes a row of its own with the same id and label, behind
// the leaf's, which is the mesh's last; the leaf's triangles are those from `first_triangle` on. A leaf that
// is dead altogether keeps its one row. The rows' lengths are those of the parts.
void split_senescent(Mesh& mesh, std::size_t first_triangle, const OrganAttributes& leaf);

// The sphere at a stem's tip (a_joint), with U = 1: closed like the stem, its whole surface counts.
void add_joint(OrganMesh& stem_mesh, const OrganAttributes& stem, double tolerance_m);

}  // namespace bpms
