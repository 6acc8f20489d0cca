// Every entity in a line of its own: what goes on from the entity above stands in its column with ^, what
// branches off in the next column.
#include <algorithm>

#include "plant/exchange/mtg_text.h"

namespace bpms {
namespace {

constexpr std::size_t most_columns = 1000;

// How each entity is said: after which one, and with which relation.
struct MtgSaid {
  std::int32_t after = -1;
  char edge = '/';
};

class MtgWriter {
 public:
  explicit MtgWriter(const Mtg& mtg) : mtg_(mtg) {}

  std::string text() {
    say();
    write_head();
    const std::vector<Line> lines = order();
    std::size_t topology = 1;
    for (const Line& line : lines) topology = std::max(topology, line.column + 1);
    out_ += "\nMTG:\nENTITY-CODE";
    out_.append(topology, '\t');
    for (std::size_t i = 0; i < mtg_.columns.size(); ++i) {
      if (i > 0) out_ += '\t';
      out_ += mtg_.features[mtg_.columns[i]].name;
    }
    out_ += '\n';
    for (const Line& line : lines) write(line, topology);
    return std::move(out_);
  }

 private:
  struct Line {
    std::int32_t vertex = 0;
    std::size_t column = 0;
    bool same_column = false;
  };

  const MtgVertex& at(std::int32_t v) const { return mtg_.vertices[static_cast<std::size_t>(v)]; }
  [[noreturn]] void refuse(std::int32_t v, const char* why) const {
    bad_input({mtg_.file, at(v).line}, "{} cannot be written as MTG: {}",
              mtg_.label(static_cast<std::size_t>(v)), why);
  }

  void say() {
    const auto count = static_cast<std::int32_t>(mtg_.vertices.size());
    std::vector<std::int32_t> attached(mtg_.vertices.size()), first(mtg_.vertices.size(), -1);
    for (std::int32_t v = count; v-- > 0;) {
      if (at(v).parent >= v || at(v).complex >= v || at(v).after >= v)
        refuse(v, "it stands before what it belongs to");
      if (at(v).complex >= 0) first[static_cast<std::size_t>(at(v).complex)] = v;
    }
    // What was not said to follow a finer entity follows where its first component does; components come
    // behind their complex, so that from the end the finest is known first.
    for (std::int32_t v = 0; v < count; ++v)
      attached[static_cast<std::size_t>(v)] = at(v).after >= 0 ? at(v).after : at(v).parent;
    for (std::int32_t v = count; v-- > 0;) {
      const std::int32_t complex = at(v).complex;
      if (complex >= 0 && at(complex).after < 0 && first[static_cast<std::size_t>(complex)] == v &&
          at(v).parent >= 0 && at(at(v).parent).complex != complex)
        attached[static_cast<std::size_t>(complex)] = attached[static_cast<std::size_t>(v)];
    }
    said_.resize(mtg_.vertices.size());
    for (std::int32_t v = 0; v < count; ++v) {
      const MtgVertex& vertex = at(v);
      MtgSaid& said = said_[static_cast<std::size_t>(v)];
      const bool inside = vertex.parent >= 0 && at(vertex.parent).complex == vertex.complex;
      if (inside) {
        said = {attached[static_cast<std::size_t>(v)], vertex.edge};
        check(v, said.after, vertex.parent);
      } else {
        said = {vertex.complex, '/'};
        if (vertex.parent < 0) continue;
        if (vertex.complex < 0 || first[static_cast<std::size_t>(vertex.complex)] != v)
          refuse(v, "only the first component may follow or be borne by what lies in another one");
        if (at(vertex.complex).parent < 0 || at(vertex.complex).edge != vertex.edge)
          refuse(v, "it follows what its complex does not follow, or in another way");
        check(v, attached[static_cast<std::size_t>(vertex.complex)], vertex.parent);
      }
    }
  }

  void check(std::int32_t v, std::int32_t after, std::int32_t parent) const {
    const int scale = mtg_.scale(static_cast<std::size_t>(v));
    while (after >= 0 && mtg_.scale(static_cast<std::size_t>(after)) > scale) after = at(after).complex;
    if (after != parent) refuse(v, "scales disagree about what it follows");
  }

  std::vector<Line> order() const {
    std::vector<std::vector<std::int32_t>> next(mtg_.vertices.size());
    std::vector<Line> stack, out;
    for (std::size_t v = 0; v < mtg_.vertices.size(); ++v) {
      if (said_[v].after >= 0)
        next[static_cast<std::size_t>(said_[v].after)].push_back(static_cast<std::int32_t>(v));
      else
        stack.push_back({static_cast<std::int32_t>(v), 0, false});
    }
    std::reverse(stack.begin(), stack.end());
    while (!stack.empty()) {
      const Line line = stack.back();
      stack.pop_back();
      out.push_back(line);
      if (line.column >= most_columns) refuse(line.vertex, "it is borne more than 1000 branches deep");
      const std::vector<std::int32_t>& after = next[static_cast<std::size_t>(line.vertex)];
      if (after.empty()) continue;
      // What goes on in the column comes last: the last that follows, else the last of all.
      std::size_t on = after.size() - 1;
      for (std::size_t i = after.size(); i-- > 0;) {
        if (said_[static_cast<std::size_t>(after[i])].edge != '<') continue;
        on = i;
        break;
      }
      stack.push_back({after[on], line.column, true});
      for (std::size_t i = after.size(); i-- > 0;)
        if (i != on) stack.push_back({after[i], line.column + 1, false});
    }
    return out;
  }

  void write_head() {
    out_ += "CODE:\tFORM-A\n\nCLASSES:\nSYMBOL\tSCALE\tDECOMPOSITION\tINDEXATION\tDEFINITION\n";
    for (const MtgClass& one : mtg_.classes)
      out_ += fmt::format("{}\t{}\t{}\t{}\t{}\n", word(one.symbol), one.scale, word(one.decomposition),
                          word(one.indexation), word(one.definition));
    out_ += "\nDESCRIPTION:\nLEFT\tRIGHT\tRELTYPE\tMAX\n";
    for (const MtgRelation& row : mtg_.relations)
      out_ += fmt::format("{}\t{}\t{}\t{}\n", word(row.left), fmt::join(row.right, ","), row.edge,
                          word(row.most));
    out_ += "\nFEATURES:\nNAME\tTYPE\n";
    for (const MtgFeature& one : mtg_.features)
      out_ += fmt::format("{}\t{}\n", word(one.name), word(one.type));
  }

  const std::string& word(const std::string& text) const {
    if (text.empty() || text.front() == '#' || text.find_first_of(" \t\r\n") != std::string::npos)
      bad_input({mtg_.file}, "{} cannot be written as MTG: expected one word", in_quotes(text));
    return text;
  }

  void write(const Line& line, std::size_t topology) {
    out_.append(line.column, '\t');
    if (line.same_column) out_ += '^';
    out_ += said_[static_cast<std::size_t>(line.vertex)].edge;
    const std::string label = mtg_.label(static_cast<std::size_t>(line.vertex));
    for (const char c : mtg_.classes[at(line.vertex).symbol].symbol)
      if (static_cast<unsigned char>(c) < 128 && std::isalpha(static_cast<unsigned char>(c)) == 0 && c != '_')
        refuse(line.vertex, "a class in front of an index is of letters only");
    out_ += label;
    std::size_t column = line.column;
    for (std::size_t i = 0; i < mtg_.columns.size(); ++i) {
      const std::string* value = mtg_.text(static_cast<std::size_t>(line.vertex), mtg_.columns[i]);
      if (value == nullptr || value->empty()) continue;
      if (value->front() == '#' || value->front() == ' ' || value->back() == ' ' ||
          value->find_first_of("\t\r\n") != std::string::npos)
        refuse(line.vertex, "a value begins with # or holds spaces around it, a tab or the end of a line");
      out_.append(topology + i - column, '\t');
      column = topology + i;
      out_ += *value;
    }
    out_ += '\n';
  }

  const Mtg& mtg_;
  std::vector<MtgSaid> said_;
  std::string out_;
};

}  // namespace

std::string mtg_text(const Mtg& mtg) {
  return MtgWriter(mtg).text();
}

}  // namespace bpms
