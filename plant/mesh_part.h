// A part of a mesh: the triangles of some of its organs, and the vertices that they use.
#pragma once
#include <functional>

#include "plant/mesh.h"

namespace bpms {
// Keeps the rows of all organs; `wanted` is asked with the index into them (0 where triangles have no
// organs).
Mesh mesh_part(const Mesh& mesh, const std::function<bool(std::uint32_t organ)>& wanted);
}  // namespace bpms
