// What the HTML viewer shows, as one JSON document: each prototype once, as triangles with 16-bit coordinates
// in its own box; its instances as poses; parts with their names, sizes and parameters; colourings with their
// legends. Binary arrays are base64, little-endian. Read by workbench/src/viewer/data.ts.
#pragma once
#include <cstdint>
#include <string>

#include "core/json.h"
#include "scene/pictures/colouring.h"

namespace bpms {

// A prototype as triangles, ordered by part; parts share no vertices. Discs become hexagons of their area,
// shapes facets.
struct PartMesh {
  std::vector<Eigen::Vector3f> positions_m;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<std::uint32_t> first_triangle, first_vertex;  // of each part, and the end
};
PartMesh part_mesh(const Prototype& prototype, const PictureParts& parts);

std::uint64_t drawn_triangles(const Scene& scene);  // of all instances

// Of a scene as picture_subject() makes it; `colour` is the colouring to begin with.
Json viewer_document(const Scene& scene, const std::string& title, const std::string& colour);

}  // namespace bpms
