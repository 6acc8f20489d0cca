// What L-systems and derived strings share: symbols that the turtle knows, settings, characters with places.
#pragma once
#include <string_view>

#include "plant/lsystem.h"

namespace bpms {

// Numbers of parameters that a turtle symbol may have; null: not one of the turtle's.
struct TurtleSymbol {
  char symbol;
  std::size_t least, most;
};
const TurtleSymbol* turtle_symbol(char symbol);
bool is_lsystem_letter(char c);

// Walks over a text by characters that know their place; # begins a comment, white space means nothing.
class LText {
 public:
  LText(std::string file, std::string_view text, int line = 1)
      : file_(std::move(file)), text_(text), line_(line) {}
  char peek();  // 0 at the end
  char take();
  bool arrow();  // is "->" next?
  bool done() { return peek() == 0; }
  SourceLocation here();  // of the next character
  // The next number or name at the place; empty when there is none.
  std::string_view number();
  std::string_view name();

 private:
  void skip();
  std::string file_;
  std::string_view text_;
  std::size_t at_ = 0;
  int line_ = 1, column_ = 1;
};

// A line like "angle 45": takes it and says yes, or leaves it.
bool read_lsetting(const std::string& file, std::string_view line, int number, LSettings& settings);
std::string lsettings_text(const LSettings& settings);

// Brackets and braces that must close in their order.
class LBrackets {
 public:
  void meet(char symbol, const SourceLocation& where);
  void finish(const char* what) const;

 private:
  std::vector<std::pair<char, SourceLocation>> open_;
};

}  // namespace bpms
