// The head of an MTG file: which classes there are, what may follow what, which columns of which type.
#include <algorithm>
#include <cctype>

#include "core/nearest.h"
#include "core/text.h"
#include "plant/exchange/mtg_text.h"

namespace bpms {

bool MtgLines::next() {
  if (rest_.empty()) return false;
  const std::size_t end = std::min(rest_.find('\n'), rest_.size());
  line_ = rest_.substr(0, end);
  rest_.remove_prefix(std::min(end + 1, rest_.size()));
  if (line_.ends_with('\r')) line_.remove_suffix(1);
  ++number_;
  for (std::size_t at = line_.find('#'); at != std::string_view::npos; at = line_.find('#', at + 1)) {
    if (at == 0 || line_[at - 1] == '\t') {
      line_ = line_.substr(0, at);
      break;
    }
  }
  return true;
}

bool MtgLines::blank() const {
  return line_.find_first_not_of(" \t\r") == std::string_view::npos;
}

std::vector<MtgCell> MtgLines::cells(bool spaces) const {
  const std::string_view separators = spaces ? " \t" : "\t";
  std::vector<MtgCell> out;
  for (std::size_t begin = 0; begin <= line_.size();) {
    const std::size_t end = std::min(line_.find_first_of(separators, begin), line_.size());
    std::size_t from = begin, to = end;
    while (from < to && (line_[from] == ' ' || line_[from] == '\r')) ++from;
    while (to > from && (line_[to - 1] == ' ' || line_[to - 1] == '\r')) --to;
    if (spaces && to > from && line_[from] == '#') break;
    if (!spaces || to > from) out.push_back({line_.substr(from, to - from), static_cast<int>(from) + 1});
    begin = end + 1;
  }
  return out;
}

namespace {

std::string in_capitals(std::string_view text) {
  std::string out(text);
  std::transform(out.begin(), out.end(), out.begin(), [](unsigned char c) { return std::toupper(c); });
  return out;
}

class MtgHead {
 public:
  MtgHead(MtgLines& lines, Mtg& mtg) : lines_(lines), mtg_(mtg) {}

  void read(std::size_t& topology) {
    read_code();
    expect("CLASSES");
    read_rows([&](const std::vector<MtgCell>& row) { add_class(row); }, "SYMBOL", "SCALE", "DESCRIPTION");
    if (mtg_.classes.empty())
      bad_input(lines_.where(), "no classes above this line, expected rows `SYMBOL SCALE ...`");
    read_rows([&](const std::vector<MtgCell>& row) { add_relation(row); }, "LEFT", "RIGHT", "FEATURES");
    read_rows([&](const std::vector<MtgCell>& row) { add_feature(row); }, "NAME", "TYPE", "MTG");
    read_heads(topology);
  }

 private:
  // The next line with something in it.
  std::vector<MtgCell> row(const char* expected) {
    while (lines_.next()) {
      std::vector<MtgCell> cells = lines_.cells(true);
      if (!cells.empty()) return cells;  // not even when it is a comment behind spaces
    }
    bad_input(lines_.where(), "the file ends where {} was expected", expected);
  }
  // "CODE:", "CODE :", "CODE"
  static bool opens(const std::vector<MtgCell>& cells, std::string_view section) {
    std::string word = in_capitals(cells.front().text);
    if (const std::size_t colon = word.find(':'); colon != std::string::npos) word.resize(colon);
    return word == section;
  }
  static bool is_section(const std::vector<MtgCell>& cells) {
    const bool colon = cells.front().text.ends_with(':') || (cells.size() > 1 && cells[1].text == ":");
    if (!colon) return false;
    for (const char* section : {"CODE", "CLASSES", "DESCRIPTION", "FEATURES", "MTG"})
      if (opens(cells, section)) return true;
    return false;
  }
  void expect(const char* section) {
    const std::vector<MtgCell> cells = row(section);
    if (!opens(cells, section))
      bad_input(lines_.where(cells.front()),
                "found {}, expected the section {}:", in_quotes(cells.front().text), section);
  }

  void read_code() {
    const std::vector<MtgCell> cells = row("CODE:");
    if (!opens(cells, "CODE"))
      bad_input(lines_.where(cells.front()), "found {}, expected the section CODE: FORM-A",
                in_quotes(cells.front().text));
    MtgCell code = cells.back();
    if (const std::size_t colon = code.text.rfind(':'); colon != std::string_view::npos) {
      code.text.remove_prefix(colon + 1);
      code.column += static_cast<int>(colon) + 1;
    }
    if (in_capitals(code.text) != "FORM-A")
      bad_input(lines_.where(code), "the code {} is not read, expected FORM-A", in_quotes(code.text));
  }

  template <class Add>
  void read_rows(const Add& add, const char* head, const char* second, const char* next_section) {
    for (;;) {
      const std::vector<MtgCell> cells = row((std::string(next_section) + ":").c_str());
      if (opens(cells, next_section) && (is_section(cells) || cells.size() == 1)) return;
      if (is_section(cells))
        bad_input(lines_.where(cells.front()), "found the section {}, expected {}: before it",
                  in_quotes(cells.front().text), next_section);
      if (cells.size() > 1 && in_capitals(cells[0].text) == head && in_capitals(cells[1].text) == second)
        continue;
      refuse_foreign_head(cells, next_section);
      add(cells);
    }
  }

  // The column heads of a later section mean that its own line was left out.
  void refuse_foreign_head(const std::vector<MtgCell>& cells, const char* next_section) const {
    const std::string first = in_capitals(cells[0].text);
    const std::string second = cells.size() > 1 ? in_capitals(cells[1].text) : "";
    if ((first == "SYMBOL" && second == "SCALE") || (first == "LEFT" && second == "RIGHT") ||
        (first == "NAME" && second == "TYPE") || first == "ENTITY-CODE" || first == "TOPO")
      bad_input(lines_.where(cells[0]), "missing section: {}: must stand before {}", next_section,
                in_quotes(cells[0].text));
  }

  void add_class(const std::vector<MtgCell>& cells) {
    if (cells.size() < 2)
      bad_input(lines_.where(cells.front()),
                "a class needs its scale: SYMBOL SCALE DECOMPOSITION INDEXATION DEFINITION");
    const auto scale = parse_integer(cells[1].text);
    constexpr long long most_scales = 1000;
    if (!scale || *scale < 0 || *scale > most_scales)
      bad_input(lines_.where(cells[1]), "found {}, expected the scale of class {} (0 to {})",
                in_quotes(cells[1].text), in_quotes(cells[0].text), most_scales);
    for (const MtgClass& known : mtg_.classes)
      if (known.symbol == cells[0].text)
        bad_input(lines_.where(cells[0]), "the class {} is there already", in_quotes(cells[0].text));
    MtgClass out{std::string(cells[0].text), static_cast<int>(*scale)};
    if (cells.size() > 2) out.decomposition = cells[2].text;
    if (cells.size() > 3) out.indexation = cells[3].text;
    if (cells.size() > 4) out.definition = cells[4].text;
    mtg_.classes.push_back(std::move(out));
  }

  std::string known_class(std::string_view symbol, const MtgCell& cell) const {
    std::vector<std::string> known;
    for (const MtgClass& one : mtg_.classes) known.push_back(one.symbol);
    if (std::find(known.begin(), known.end(), symbol) == known.end())
      bad_input(lines_.where(cell), "unknown class {}{}", in_quotes(symbol), did_you_mean(symbol, known));
    return std::string(symbol);
  }

  void add_relation(const std::vector<MtgCell>& cells) {
    std::size_t edge = 1;  // "U,W" may be written "U, W"
    while (edge < cells.size() && cells[edge].text != "<" && cells[edge].text != "+") ++edge;
    if (edge == cells.size() || edge < 2)
      bad_input(lines_.where(cells.back()),
                "unknown relation {}, expected LEFT RIGHT RELTYPE MAX with RELTYPE < or +",
                in_quotes(cells.size() > 2 ? cells[2].text : cells.back().text));
    MtgRelation out{known_class(cells[0].text, cells[0]), {}, cells[edge].text[0]};
    for (std::size_t i = 1; i < edge; ++i) {
      std::string_view list = cells[i].text;
      while (!list.empty()) {
        const std::size_t end = std::min(list.find(','), list.size());
        if (end > 0) out.right.push_back(known_class(list.substr(0, end), cells[i]));
        list.remove_prefix(std::min(end + 1, list.size()));
      }
    }
    if (out.right.empty()) bad_input(lines_.where(cells[1]), "no class on the right of the relation");
    if (cells.size() > edge + 1) out.most = cells[edge + 1].text;
    mtg_.relations.push_back(std::move(out));
  }

  void add_feature(const std::vector<MtgCell>& cells) {
    if (cells.size() < 2)
      bad_input(lines_.where(cells.front()), "the feature {} needs its type: NAME TYPE",
                in_quotes(cells[0].text));
    const std::string type = in_capitals(cells[1].text);
    if (std::find(mtg_types().begin(), mtg_types().end(), type) == mtg_types().end())
      bad_input(lines_.where(cells[1]), "unknown type {}{}", in_quotes(cells[1].text),
                did_you_mean(type, mtg_types()));
    if (mtg_.feature(cells[0].text))
      bad_input(lines_.where(cells[0]), "the feature {} is there already", in_quotes(cells[0].text));
    mtg_.features.push_back({std::string(cells[0].text), type});
  }

  void read_heads(std::size_t& topology) {
    row("the line ENTITY-CODE");
    const std::vector<MtgCell> cells = lines_.cells(false);
    const std::string first = in_capitals(cells.front().text);
    if (first != "ENTITY-CODE" && first != "TOPO")
      bad_input(lines_.where(cells.front()),
                "found {}, expected ENTITY-CODE or TOPO and the names of the columns",
                in_quotes(cells.front().text));
    topology = 1;
    while (topology < cells.size() && cells[topology].text.empty()) ++topology;
    std::size_t end = cells.size();
    while (end > topology && cells[end - 1].text.empty()) --end;
    std::vector<std::string> known;
    for (const MtgFeature& one : mtg_.features) known.push_back(one.name);
    for (std::size_t i = topology; i < end; ++i) {
      const auto feature = mtg_.feature(cells[i].text);
      if (!feature)
        bad_input(lines_.where(cells[i]), "the column {} is not among the FEATURES{}",
                  in_quotes(cells[i].text), did_you_mean(cells[i].text, known));
      if (std::find(mtg_.columns.begin(), mtg_.columns.end(), *feature) != mtg_.columns.end())
        bad_input(lines_.where(cells[i]), "the column {} is there already", in_quotes(cells[i].text));
      mtg_.columns.push_back(*feature);
    }
    constexpr std::size_t any = 1 << 20;  // without columns of values all are of codes
    if (mtg_.columns.empty()) topology = any;
  }

  MtgLines& lines_;
  Mtg& mtg_;
};

bool is_date(std::string_view form, std::string_view text) {
  // Digits in groups as in the form (DD/MM/YY): one to four digits for each group of letters.
  std::size_t groups = 1, digits = 0, wanted = 1;
  for (const char c : form) wanted += c == '/' || c == '-' || c == ':' ? 1 : 0;
  for (const char c : text) {
    if (std::isdigit(static_cast<unsigned char>(c)) != 0) {
      if (++digits > 4) return false;
    } else if (c == '/' || c == '-' || c == ':' || c == ' ' || c == '.') {
      if (digits == 0) return false;
      digits = 0;
      ++groups;
    } else {
      return false;
    }
  }
  return groups == wanted && digits > 0;
}

}  // namespace

const std::vector<std::string>& mtg_types() {
  static const std::vector<std::string> types{"INT",   "REAL",     "ALPHA",      "STRING", "BOOLEAN",
                                              "DD/MM", "DD/MM/YY", "DD/MM/YYYY", "MM/YY",  "HH:MM",
                                              "TIME",  "GEOMETRY", "APPEARANCE", "OBJECT"};
  return types;
}

bool is_mtg_value(std::string_view type, std::string_view text) {
  if (type == "INT") return parse_integer(text).has_value();
  if (type == "REAL") return parse_number(text).has_value();
  if (type == "BOOLEAN") {
    const std::string word = in_capitals(text);
    return word == "TRUE" || word == "FALSE" || word == "0" || word == "1";
  }
  if (type.starts_with("DD/") || type.starts_with("MM/") || type == "HH:MM") return is_date(type, text);
  return true;
}

void read_mtg_head(MtgLines& lines, Mtg& mtg, std::size_t& topology) {
  MtgHead(lines, mtg).read(topology);
}

}  // namespace bpms
