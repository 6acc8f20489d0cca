// What a picture or the viewer shows: the scene in a file, taken out of its endless repetition, its ground a
// piece of surface like any other. A part is the least thing with a colour and a name of its own: an organ,
// all discs of one material, a shape. Metres, z up, x east, y north.
#pragma once
#include <string>
#include <vector>

#include "scene/intersect/intersector.h"
#include "scene/scene.h"

namespace bpms {

inline constexpr const char* ground_kind = "ground";

// The same to be looked at from outside: an open domain, one period of it; a ground plane becomes a sheet as
// large as the domain (or a little larger than what stands on it), terrain its own mesh. Both are the last
// prototype and instance, of kind "ground". bad_input where there is nothing to see.
Scene picture_subject(Scene scene, const std::string& path);

// A part as it stands in its prototype's frame, before an instance scales it.
struct PicturePart {
  std::string label, kind, material;
  double length_m = 0;         // not a number where there is none
  double area_m2 = 0;          // one-sided for leaves and discs, total surface for the rest
  double height_m = 0;         // mean height of its surface above the prototype's origin
  double inclination_deg = 0;  // mean angle of its facets from the horizontal, 0..90; by area, as the height
  Mesh::Organ::Named properties, parameters;
};

// Parts of a prototype: its organs first, then its discs by material, then its shapes.
struct PictureParts {
  std::vector<PicturePart> parts;
  std::vector<std::uint32_t> part_of_disc;
  std::uint32_t first_shape = 0;
};
PictureParts picture_parts(const Scene& scene, const Prototype& prototype);

// The part of the prototype that a ray met.
std::uint32_t part_of_hit(const PictureParts& parts, const Scene& scene, const Hit& hit);

}  // namespace bpms
