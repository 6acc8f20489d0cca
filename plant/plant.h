// The noun of the plant floor: a plant as a readable text (.bpms), its topology and the functions of its
// organs. Source: Lewis 1999 (BPMS paper) section 2; what the paper leaves open is decided in
// docs/plant_language.md. Frame: x east, y north, z up; lengths in metres and angles in radians here, the
// user's units only in the text.
#pragma once
#include <Eigen/Geometry>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/error.h"
#include "plant/organ_function.h"

namespace bpms {

enum class OrganKind { bud, stem, leaf, head, rotation };  // letters b s l h +
char letter(OrganKind kind);
std::string organ_name(OrganKind kind);  // "leaf"

// The attribute block of an organ. Angles in radians, lengths in metres.
struct OrganAttributes {
  std::string material;
  double length_m = 0;
  double width_m = 0;
  double radius_m = 0;
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
  SourceLocation where;
};

// One symbol of the word.
struct Symbol {
  enum class Type { open, close, organ } type{};
  OrganKind kind{};
  std::optional<int> label;  // l(1)
  int ordinal = 0;           // among its own letter, from 1, left to right
  int block = -1;            // index into Plant::blocks, -1: none (all defaults)
  SourceLocation where;
};

struct Plant {
  std::string name;
  std::string unit = "cm";  // of the text it was read from; files are written in it
  std::vector<Symbol> word;
  std::vector<Block> blocks;
  std::vector<std::string>
      warnings;  // located notes: blocks nothing uses, organs without a block, ambiguous numbers
};

struct PlantReadOptions {
  bool lenient = false;  // closes brackets that were left open, and says so in the warnings
};
Plant read_plant(const std::string& path, const PlantReadOptions& options = {});
Plant parse_plant(const std::string& path, std::string_view text, const PlantReadOptions& options = {});
std::string plant_text(const Plant& plant);

// An organ placed in the plant's frame: `base` maps the organ's own frame (x to the downward-facing side, y
// across, z along) to the plant's, constants a_... already applied.
struct PlacedOrgan {
  int symbol = 0;  // index into Plant::word
  int id = 0;      // 0.. in order of the word, rotations not counted
  OrganKind kind{};
  std::string label;  // "l3", "s1"
  const OrganAttributes* attributes = nullptr;
  Eigen::Isometry3d plant_from_organ = Eigen::Isometry3d::Identity();
};
std::vector<PlacedOrgan> place_organs(const Plant& plant);

}  // namespace bpms
