// Whether the faces of a Wavefront OBJ name vertices, texture coordinates and normals that are there: indices
// count from 1, or backwards from the last one read so far (-1). Assimp says neither which face is wrong, nor
// that a normal is missing.
#pragma once
#include <string>
#include <string_view>

namespace bpms {
// bad_input with line and column at the first index that names nothing.
void check_obj_indices(const std::string& path, std::string_view text);
}  // namespace bpms
