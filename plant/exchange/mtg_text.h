// The parts of reading an MTG file: lines and cells that know their place, the head, the entity codes.
#pragma once
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "plant/mtg.h"

namespace bpms {

struct MtgCell {
  std::string_view text;  // without spaces around it
  int column = 0;         // in bytes, from 1
};

// The file line by line; comments (# at the beginning of a cell) and carriage returns taken off.
class MtgLines {
 public:
  MtgLines(std::string file, std::string_view text) : file_(std::move(file)), rest_(text) {}
  bool next();  // the next line, blank ones too
  bool blank() const;
  // Cut at tabs; in the head (`spaces`) at white space of any kind.
  std::vector<MtgCell> cells(bool spaces) const;
  int number() const { return number_; }
  SourceLocation where(int column = 0) const { return {file_, number_, column}; }
  SourceLocation where(const MtgCell& cell) const { return {file_, number_, cell.column}; }

 private:
  std::string file_;
  std::string_view rest_, line_;
  int number_ = 0;
};

// CODE, CLASSES, DESCRIPTION, FEATURES up to the line of the column heads; `topology` becomes the number of
// columns that hold entity codes.
void read_mtg_head(MtgLines& lines, Mtg& mtg, std::size_t& topology);
// The entity table.
void read_mtg_entities(MtgLines& lines, std::size_t topology, Mtg& mtg);
// Is the text a value of this type? Types that are not known take anything.
bool is_mtg_value(std::string_view type, std::string_view text);
const std::vector<std::string>& mtg_types();

}  // namespace bpms
