// What a picture's colours mean: a category of each part, or a number of it on a scale.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "scene/pictures/colours.h"
#include "scene/pictures/subject.h"

namespace bpms {

struct Colouring {
  std::string name;   // "material", "length"
  std::string title;  // "length, m"
  struct Entry {
    std::string label;
    Rgb colour;
  };
  std::vector<Entry> entries;               // of categories, in order of first appearance
  bool is_scale = false;                    // else categories
  double low = 0, high = 0;                 // of the scale
  bool some_without_value = false;          // parts that have no such number, drawn in grey
  std::vector<std::vector<Rgb>> colour_of;  // [prototype][part]
  // [prototype][part]: the entry, or the number (not a number where there is none).
  std::vector<std::vector<double>> value_of;
};

// `parts` of each prototype of the scene. Names: organ, material, kind, plant; length, area, height,
// leaf_inclination; and any property that plants carry along and that is a number somewhere. An unknown one
// is bad_input with what there is.
Colouring make_colouring(const Scene& scene, const std::vector<PictureParts>& parts, const std::string& name);
// All that this scene has something to say about.
std::vector<std::string> known_colourings(const Scene& scene, const std::vector<PictureParts>& parts);

}  // namespace bpms
