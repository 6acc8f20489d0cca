// The entity table of an MTG file. A code stands in the column of its branching depth; it starts from the
// last entity of the column to its left, or with ^ from the last one of its own column.
#include <algorithm>
#include <set>

#include "core/nearest.h"
#include "core/text.h"
#include "plant/exchange/mtg_builder.h"
#include "plant/exchange/mtg_text.h"

namespace bpms {
namespace {

constexpr int longest_range = 100'000;

struct MtgCode {  // one element of a code: "<E6" or "<<E10"
  char edge = '/';
  bool range = false, shared = false;  // << and <.<: all from the one before; the dot: they share the values
  std::uint32_t symbol = 0;
  int index = -1;
  MtgCell cell;
};

class MtgEntities {
 public:
  MtgEntities(MtgLines& lines, std::size_t topology, Mtg& mtg)
      : lines_(lines), topology_(topology), mtg_(mtg) {
    for (std::size_t i = 0; i < mtg.classes.size(); ++i)
      symbols_.emplace(mtg.classes[i].symbol, static_cast<std::uint32_t>(i));
    for (const MtgRelation& row : mtg.relations)
      for (const std::string& right : row.right)
        allowed_.insert({symbols_.at(row.left), symbols_.at(right), row.edge});
  }

  void read() {
    while (lines_.next())
      if (!lines_.blank()) read_line(lines_.cells(false));
    if (mtg_.vertices.empty()) bad_input(lines_.where(), "no entities below the names of the columns");
    if (unlike_ > 0)
      mtg_.notes.push_back(fmt::format("{}: {} relations that DESCRIPTION does not name, the first here",
                                       SourceLocation{mtg_.file, unlike_line_, 0}.str(), unlike_));
  }

 private:
  void read_line(const std::vector<MtgCell>& cells) {
    std::size_t column = 0;
    while (cells[column].text.empty()) ++column;  // the line is not blank
    if (column >= topology_)
      bad_input(lines_.where(cells[column]),
                "wrong tabs: {} stands in column {}, but entity codes end with column {} (values follow)",
                in_quotes(cells[column].text), column + 1, topology_);
    const std::size_t first = mtg_.vertices.size();
    const std::size_t from = read_code(cells[column], column);
    for (std::size_t i = column + 1; i < cells.size(); ++i) {
      if (cells[i].text.empty()) continue;
      if (i < topology_)
        bad_input(lines_.where(cells[i]),
                  "wrong tabs: {} between the code and the values, which begin with column {}",
                  in_quotes(cells[i].text), topology_ + 1);
      if (i - topology_ >= mtg_.columns.size())
        bad_input(lines_.where(cells[i]), "wrong tabs: {} in column {}, but the last column is {} ({})",
                  in_quotes(cells[i].text), i + 1, topology_ + mtg_.columns.size(),
                  mtg_.features[mtg_.columns.back()].name);
      add_value(cells[i], mtg_.columns[i - topology_], std::max(first, from));
    }
  }

  void add_value(const MtgCell& cell, std::uint32_t feature, std::size_t from) {
    const MtgFeature& of = mtg_.features[feature];
    if (!is_mtg_value(of.type, cell.text))
      bad_input(lines_.where(cell), "found {}, expected a value of type {} in column {}",
                in_quotes(cell.text), of.type, of.name);
    for (std::size_t v = from; v < mtg_.vertices.size(); ++v) mtg_.set(v, feature, std::string(cell.text));
  }

  // Adds the entities of a code; returns the first one that the values belong to.
  std::size_t read_code(const MtgCell& cell, std::size_t column) {
    MtgCell rest = cell;
    const bool same_column = rest.text.starts_with('^');
    if (same_column) {
      rest.text.remove_prefix(1);
      ++rest.column;
    }
    std::int32_t cursor = -1;
    if (same_column || column > 0) {
      const std::size_t at = same_column ? column : column - 1;
      if (at >= last_.size() || last_[at] < 0)
        bad_input(lines_.where(cell),
                  "wrong tabs: no entity stands above in column {} that {} could start from", at + 1,
                  in_quotes(cell.text));
      cursor = last_[at];
    }
    if (rest.text.empty())
      bad_input(lines_.where(cell), "a code without an entity: {}", in_quotes(cell.text));
    std::size_t values_from = 0;
    while (!rest.text.empty()) {
      const MtgCode code = next_code(rest);
      const std::size_t before = mtg_.vertices.size();
      cursor = code.range ? add_range(code, cursor) : add(code, code.index, cursor);
      // A range with a dot gives its values to all of it, the entity that it starts from too.
      values_from = code.shared && before > 0 ? before - 1 : mtg_.vertices.size() - 1;
    }
    last_.resize(column + 1, -1);
    last_[column] = cursor;
    return values_from;
  }

  MtgCode next_code(MtgCell& rest) {
    MtgCode out;
    out.cell = rest;
    const auto take = [&](std::size_t bytes) {
      rest.text.remove_prefix(bytes);
      rest.column += static_cast<int>(bytes);
    };
    out.edge = rest.text.front();
    if (out.edge != '/' && out.edge != '<' && out.edge != '+')
      bad_input(lines_.where(rest), "unknown relation in {}, expected / < or + before an entity{}",
                in_quotes(rest.text),
                rest.text.find(' ') != std::string_view::npos ? " (columns are separated by tabs)" : "");
    take(1);
    if (out.edge != '/' && rest.text.size() > 1 && rest.text[0] == '.' && rest.text[1] == out.edge) {
      out.range = out.shared = true;
      take(2);
    } else if (out.edge != '/' && rest.text.starts_with(out.edge)) {
      out.range = true;
      take(1);
    }
    std::size_t letters = 0;
    while (letters < rest.text.size() && is_letter(rest.text[letters])) ++letters;
    out.symbol = class_of(rest.text.substr(0, letters), rest);
    take(letters);
    std::size_t digits = 0;
    while (digits < rest.text.size() && rest.text[digits] >= '0' && rest.text[digits] <= '9') ++digits;
    if (digits > 0) {
      constexpr long long largest = 2'000'000'000;
      const auto index = parse_integer(rest.text.substr(0, digits));
      if (!index || *index > largest)
        bad_input(lines_.where(rest), "the index {} is larger than 2e9",
                  in_quotes(rest.text.substr(0, digits)));
      out.index = static_cast<int>(*index);
      take(digits);
    }
    return out;
  }

  static bool is_letter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' ||
           static_cast<unsigned char>(c) >= 128;
  }

  std::uint32_t class_of(std::string_view symbol, const MtgCell& at) {
    const auto found = symbols_.find(std::string(symbol));
    if (found != symbols_.end()) return found->second;
    // Xplo writes the scene itself as the first entity and does not declare it.
    if (mtg_.vertices.empty() && !symbol.empty() && at.column == 2) {
      const std::uint32_t scene = mtg_.class_number(std::string(symbol), 0);
      symbols_.emplace(symbol, scene);
      mtg_.notes.push_back(
          fmt::format("{}: the class {} is not among the CLASSES; taken for the scene (scale 0)",
                      lines_.where(at).str(), in_quotes(symbol)));
      return scene;
    }
    std::vector<std::string> known;
    for (const MtgClass& one : mtg_.classes) known.push_back(one.symbol);
    if (symbol.empty())
      bad_input(lines_.where(at), "found {}, expected a class{}", in_quotes(at.text),
                did_you_mean("", known));
    bad_input(lines_.where(at), "unknown class {}{}", in_quotes(symbol), did_you_mean(symbol, known));
  }

  std::int32_t add_range(const MtgCode& code, std::int32_t cursor) {
    const MtgVertex* from = cursor >= 0 ? &mtg_.vertices[static_cast<std::size_t>(cursor)] : nullptr;
    if (from == nullptr || from->symbol != code.symbol || from->index < 0 || code.index <= from->index)
      bad_input(lines_.where(code.cell),
                "the range {} does not go on from an entity of its class and a lower index",
                in_quotes(code.cell.text));
    if (code.index - from->index > longest_range)
      bad_input(lines_.where(code.cell), "the range {} is longer than {}", in_quotes(code.cell.text),
                longest_range);
    for (int index = from->index + 1; index <= code.index; ++index) cursor = add(code, index, cursor);
    return cursor;
  }

  std::int32_t add(const MtgCode& code, int index, std::int32_t cursor) {
    const std::int32_t out =
        builder_.add(code.edge, code.symbol, index, cursor, lines_.where(code.cell), code.cell.text);
    const MtgVertex& vertex = mtg_.vertices[static_cast<std::size_t>(out)];
    if (code.edge != '/') check_relation(vertex);
    return out;
  }

  void check_relation(const MtgVertex& vertex) {
    if (allowed_.empty()) return;
    const std::uint32_t left = mtg_.vertices[static_cast<std::size_t>(vertex.parent)].symbol;
    if (allowed_.count({left, vertex.symbol, vertex.edge}) > 0) return;
    if (unlike_++ == 0) unlike_line_ = lines_.number();
  }

  MtgLines& lines_;
  std::size_t topology_;
  Mtg& mtg_;
  std::unordered_map<std::string, std::uint32_t> symbols_;
  std::set<std::tuple<std::uint32_t, std::uint32_t, char>> allowed_;
  std::vector<std::int32_t> last_;  // of each column
  MtgBuilder builder_{mtg_};
  std::size_t unlike_ = 0;
  int unlike_line_ = 0;
};

bool is_utf8(std::string_view text) {
  for (std::size_t i = 0; i < text.size();) {
    const auto c = static_cast<unsigned char>(text[i]);
    const std::size_t length = c < 0x80                ? 1
                               : c >= 0xc2 && c < 0xe0 ? 2
                               : c >= 0xe0 && c < 0xf0 ? 3
                               : c >= 0xf0 && c < 0xf5 ? 4
                                                       : 0;
    if (length == 0 || i + length > text.size()) return false;
    for (std::size_t k = 1; k < length; ++k)
      if ((static_cast<unsigned char>(text[i + k]) & 0xc0) != 0x80) return false;
    i += length;
  }
  return true;
}

std::string from_latin1(std::string_view text) {
  std::string out;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x80) {
      out += c;
    } else {
      out += static_cast<char>(0xc0 | (byte >> 6));
      out += static_cast<char>(0x80 | (byte & 0x3f));
    }
  }
  return out;
}

}  // namespace

void read_mtg_entities(MtgLines& lines, std::size_t topology, Mtg& mtg) {
  MtgEntities(lines, topology, mtg).read();
}

Mtg parse_mtg(const std::string& path, std::string_view text) {
  Mtg out;
  out.file = path;
  std::string converted;
  if (!is_utf8(text)) {
    converted = from_latin1(text);
    text = converted;
    out.notes.push_back(path + ": not UTF-8, read as Latin-1");
  }
  if (text.find('\r') != std::string_view::npos)
    out.notes.push_back(path + ": lines end with CR LF, read as LF");
  MtgLines lines(path, text);
  std::size_t topology = 0;
  read_mtg_head(lines, out, topology);
  read_mtg_entities(lines, topology, out);
  return out;
}

Mtg read_mtg(const std::string& path) {
  return parse_mtg(path, read_text(path));
}

}  // namespace bpms
