// A multiscale tree graph: a plant's topology at several scales at once, as field teams digitise it (Godin
// and Caraglio 1998, J. Theor. Biol. 191). A vertex is an entity: its class (a symbol that belongs to a
// scale), its index, the vertex before it at its own scale (`<` follows it, `+` is borne by it) and the
// vertex of the next coarser scale that it is part of (`/`). The file is the text form FORM-A of AMAPmod:
// sections CODE, CLASSES, DESCRIPTION, FEATURES and MTG, columns separated by tabs. docs/exchange.md says
// what is read and written.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "plant/mesh.h"
#include "plant/plant.h"

namespace bpms {

struct MtgClass {
  std::string symbol;  // "U", "Metamer"
  int scale = 0;       // 0: the scene; finer scales have larger numbers
  std::string decomposition = "FREE", indexation = "FREE", definition = "EXPLICIT";
};

struct MtgRelation {  // a row of DESCRIPTION: what may follow (<) or be borne by (+) what
  std::string left;
  std::vector<std::string> right;
  char edge = '<';
  std::string most = "?";  // how many; "?": any number
};

struct MtgFeature {
  std::string name;
  std::string type;  // INT, REAL, ALPHA, BOOLEAN, DD/MM/YY, ...
};

struct MtgValue {
  std::uint32_t feature = 0;
  std::string text;  // as written; it is of the feature's type
};

struct MtgVertex {
  std::uint32_t symbol = 0;   // index into Mtg::classes
  int index = -1;             // -1: none
  char edge = '/';            // to the parent: '<' or '+'; '/': no parent
  std::int32_t parent = -1;   // at the same scale
  std::int32_t complex = -1;  // what it is part of
  std::int32_t after =
      -1;        // what it was said to follow or to be borne by, perhaps at a finer scale; -1 with '/'
  int line = 0;  // of the file; 0: not from a file
  std::vector<MtgValue> values = {};
};

struct Mtg {
  std::vector<MtgClass> classes;
  std::vector<MtgRelation> relations;
  std::vector<MtgFeature> features;
  std::vector<std::uint32_t> columns;  // features in the order of the entity table
  std::vector<MtgVertex> vertices;     // parents and complexes before what hangs on them
  std::string file;
  std::vector<std::string> notes;  // what was converted or is odd, with its place

  int scale(std::size_t vertex) const { return classes[vertices[vertex].symbol].scale; }
  std::string label(std::size_t vertex) const;  // "U94"
  std::optional<std::uint32_t> feature(std::string_view name) const;
  const std::string* text(std::size_t vertex, std::uint32_t feature) const;  // null: no value
  std::optional<double> number(std::size_t vertex, std::optional<std::uint32_t> feature) const;
  // For writers: the class or feature of this name, made where it is not there yet.
  std::uint32_t class_number(const std::string& symbol, int at_scale);
  std::uint32_t feature_number(const std::string& name, const std::string& type);
  void set(std::size_t vertex, std::uint32_t feature, std::string value);
  // The same graph with the same values, whatever the order of the vertices in memory; lines do not count.
  bool same_as(const Mtg& other) const;
};

// Mistakes are bad_input with line and column. Latin-1 and CRLF are converted, and noted.
Mtg read_mtg(const std::string& path);
Mtg parse_mtg(const std::string& path, std::string_view text);
// Reading what was written gives the same graph, writing that again the same bytes. bad_input for a graph
// that the form cannot say (a component that neither follows nor is borne by what its complex does).
std::string mtg_text(const Mtg& mtg);

struct MtgGeometryOptions {
  double metres_per_unit = 0.01;           // of lengths and coordinates: field habit is cm
  double metres_per_diameter_unit = 0.01;  // of TopDia, BotDia, Width
  double tolerance_m = 1e-4;
};
// A surface as far as the columns allow: entities with XX YY ZZ (their far ends) become chains of frusta
// from the entity before, TopDia and BotDia their diameters; entities with Length and angles (XEuler,
// XInsertionAngle, YInsertionAngle in degrees) are laid out one after the other; leaves with Length and
// Width become blades. Notes say what was assumed. bad_input when there is neither.
// `organ_of_vertex`: where asked for, each entity's organ, -1 for none.
Mesh mtg_mesh(const Mtg& mtg, const MtgGeometryOptions& options, std::vector<std::string>& notes,
              std::vector<std::int32_t>* organ_of_vertex = nullptr);

// A plant at the scales P plant, A axis, then its organs B S L H by their ordinals; columns: XX YY ZZ (far
// ends, cm), Length, Width, Radius (cm), TopDia BotDia (cm, stems), Area (cm2), Material, Label and what the
// organs carry along. `mesh` is the plant's own.
Mtg plant_mtg(const Plant& plant, const Mesh& mesh);

}  // namespace bpms
