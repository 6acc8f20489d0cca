// The noun of the plant floor: a plant as a readable text (.bpms), its topology and the functions of its
// organs. Source: Lewis 1999 (BPMS paper) section 2; what the paper leaves open is decided in
// docs/plant_language.md. Frame: x east, y north, z up; lengths in metres and angles in radians here, the
// user's units only in the text.
#pragma once
#include <Eigen/Geometry>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/error.h"
#include "plant/organ_function.h"

namespace bpms {

enum class OrganKind { bud, stem, leaf, head, rotation, compound };  // letters b s l h + c
char letter(OrganKind kind);
std::string organ_name(OrganKind kind);  // "leaf"

// Names and values that the text carries along untouched: p_age_d 12 is {"age_d", "12"}.
using OrganProperties = std::vector<std::pair<std::string, std::string>>;

// The attribute block of an organ. Angles in radians, lengths in metres.
struct OrganAttributes {
  std::string material;
  std::string senescent_material;  // of the leaf's dead part; absent: "senescent"
  OrganProperties properties;
  double length_m = 0;
  double width_m = 0;
  double radius_m = 0;
  double senescent = 0;  // share of the leaf's length, from its tip
  double joint = 0;      // radius of a sphere at the stem's tip, in the stem's radii there; 0: none
  double inclination = 0, azimuth = 0, twist = 0;  // the constants a_..., applied before the functions
  std::unique_ptr<OrganFunction> f_inclination, f_azimuth, f_twist,
      f_curvature;                         // of l in [0,1], values in radians
  std::unique_ptr<OrganFunction> f_width;  // times width; absent = 1
  std::string section;                     // how a leaf looks across (plant/geometry/sections); empty: an arc
  double midrib_width = 0, midrib_height = 0;  // of the section raised_midrib, over the leaf's width
  OrganAttributes();
  OrganAttributes(const OrganAttributes&);
  OrganAttributes& operator=(const OrganAttributes&);
  OrganAttributes(OrganAttributes&&) noexcept;
  OrganAttributes& operator=(OrganAttributes&&) noexcept;
  ~OrganAttributes();
};

struct Block {  // "l 2 { ... }"
  OrganKind kind{};
  std::optional<int> number;  // absent: for every organ of this letter without a block of its own
  OrganAttributes attributes;
  int compound = -1;  // c: index into Plant::compounds
  SourceLocation where;
};

// One symbol of the word.
struct Symbol {
  enum class Type { open, close, organ } type{};
  OrganKind kind{};
  std::optional<int> label;  // l(1)
  int ordinal = 0;           // among its own letter, from 1, left to right
  int block = -1;            // index into blocks, -1: none (all defaults)
  SourceLocation where;
};

// A word and the blocks of its organs.
struct OrganWord {
  std::vector<Symbol> word;
  std::vector<Block> blocks;
};

// An organ made of organs (a compound leaf), its parameters filled in.
struct CompoundOrgan : OrganWord {
  std::string name;
};

struct Plant : OrganWord {
  std::string name;
  std::string unit = "cm";               // of the text it was read from; files are written in it
  std::vector<CompoundOrgan> compounds;  // one made of others stands behind them
  std::vector<std::string> warnings;     // located notes: blocks nothing uses, unlikely sizes, ...
  std::vector<std::string> inputs;       // files it was read from: its own first, then what it includes
};

struct PlantReadOptions {
  bool lenient = false;  // closes brackets that were left open, and says so in the warnings
  // Gives the text of an included file; absent: read_text.
  std::function<std::string(const std::string& path)> include = {};
};
Plant read_plant(const std::string& path, const PlantReadOptions& options = {});
Plant parse_plant(const std::string& path, std::string_view text, const PlantReadOptions& options = {});
std::string plant_text(const Plant& plant);

// An organ placed in the plant's frame. The organs of a compound one are placed each by itself: `base` maps
// the organ's own frame (x to the downward-facing side, y across, z along) to the plant's, constants a_...
// already applied.
struct PlacedOrgan {
  int symbol = 0;  // index into Plant::word; for a part of a compound organ, of that organ
  int id = 0;      // 0.. in order of the word; rotations and compound organs as such are not counted
  OrganKind kind{};
  std::string label;  // "l3", "s1"; within a compound organ "c1.l3"
  const OrganAttributes* attributes = nullptr;
  OrganProperties properties;  // its own and, where it lacks them, those of the compound organs around it
  Eigen::Isometry3d plant_from_organ = Eigen::Isometry3d::Identity();
};
std::vector<PlacedOrgan> place_organs(const Plant& plant);

}  // namespace bpms
