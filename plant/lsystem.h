// Parametric L-systems and the strings that they derive, as in Prusinkiewicz and Lindenmayer, The Algorithmic
// Beauty of Plants (1990), chapters 1 and 2: a module is a one-letter symbol with numbers in parentheses;
// every step rewrites all modules at once; a turtle draws the result. docs/exchange.md has the text forms
// (.lsys, .lstr), the symbols, and what is left open in the book.
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "plant/mesh.h"
#include "plant/mtg.h"

namespace bpms {

struct LSettings {
  std::string unit = "cm", width_unit = "cm";      // of lengths, and of widths, which are diameters
  double angle_deg = 90, length = 1, width = 0.1;  // of symbols without a parameter
};

struct LModule {
  char symbol = 0;
  std::uint8_t count = 0;   // of parameters
  std::uint32_t first = 0;  // index into LString::parameters
};

struct LString {
  std::string file;
  LSettings settings;
  std::vector<LModule> modules;
  std::vector<double> parameters;
  std::vector<std::string> notes;
};

// A number or a formula of parameters, as a program in postfix order.
struct LFormula {
  struct Step {
    char what = '#';  // '#' number, '@' parameter, else an operator
    double number = 0;
    std::uint32_t parameter = 0;
  };
  std::vector<Step> steps;
  double value(const double* parameters) const;
};

struct LRule {
  char symbol = 0;
  std::size_t parameters = 0;
  std::optional<LFormula> condition;
  struct Module {
    char symbol = 0;
    std::vector<LFormula> parameters;
  };
  std::vector<Module> successor;
  SourceLocation where;
};

struct LSystem {
  std::string file;
  LSettings settings;
  int steps = 0;
  SourceLocation steps_where;
  std::vector<LRule> rules;  // tried in this order
  std::vector<LRule::Module> axiom;
};

// Mistakes (brackets, numbers of parameters, symbols that nothing rewrites or draws) are bad_input with line
// and column.
LSystem read_lsystem(const std::string& path);
LSystem parse_lsystem(const std::string& path, std::string_view text);
// `steps`: instead of the file's. bad_input when more than 5e6 modules or a number that is not finite arise.
LString derive(const LSystem& system, std::optional<int> steps = {});

LString read_lstring(const std::string& path);
LString parse_lstring(const std::string& path, std::string_view text);
// Reading it gives the same modules with the same numbers.
std::string lstring_text(const LString& string);

struct TurtlePlant {
  Mesh mesh;  // stems as chains of frusta, leaves as polygons
  Mtg mtg;    // P plant, A axis, S segment and L leaf
  std::vector<std::int32_t> organ_of_vertex;
};
TurtlePlant turtle(const LString& string, double tolerance_m = 1e-4);

}  // namespace bpms
