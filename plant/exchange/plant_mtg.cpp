// A plant of the plant language as a graph. Organs that follow each other in one bracket make an axis; a
// bracket that holds a stem or a bud begins an axis of its own, borne by the organ before it; leaves are
// borne.
#include <algorithm>
#include <unordered_map>

#include "plant/exchange/mtg_builder.h"
#include "plant/leaf_frame.h"

namespace bpms {
namespace {

std::string mtg_number(double value) {
  return fmt::format("{:.9g}", value);
}
std::string mtg_word(std::string text) {  // a value of a column: one line, no spaces around it
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return c < ' '; }, ' ');
  while (!text.empty() && (text.back() == ' ')) text.pop_back();
  text.erase(0, std::min(text.find_first_not_of(" #"), text.size()));
  return text;
}

class PlantGraph {
 public:
  PlantGraph(const Plant& plant, const Mesh& mesh) : plant_(plant), mesh_(mesh) {
    for (std::size_t i = 0; i < mesh.organs.size(); ++i) organ_of_id_.emplace(mesh.organs[i].id, i);
    out_.file = plant.name;
    out_.classes = {{"P", 1}, {"A", 2}, {"S", 3}, {"L", 3}, {"H", 3}, {"B", 3}};
    out_.relations = {{"A", {"A"}, '+'},
                      {"S", {"S", "B", "H"}, '<'},
                      {"B", {"S", "B", "H"}, '<'},
                      {"S", {"S", "B", "L", "H"}, '+'},
                      {"B", {"S", "B", "L", "H"}, '+'}};
    for (const char* name : {"XX", "YY", "ZZ", "Length", "Width", "Radius", "TopDia", "BotDia", "Area"})
      out_.feature_number(name, "REAL");
    for (const char* name : {"Material", "Label"}) out_.feature_number(name, "ALPHA");
  }

  Mtg graph() {
    add('/', "P", 1, -1);
    placed_ = place_organs(plant_);
    walk(plant_, -1);
    return std::move(out_);
  }

 private:
  // A word whose organs start on `before` (-1: the ground), in an axis of their own; compound organs as words
  // of theirs. Organs come in the order in which they were placed.
  void walk(const OrganWord& organs, std::int32_t before) {
    struct Open {
      std::int32_t before;
      bool branch;
    };
    std::vector<Open> stack;
    bool branch = true;  // what follows next begins an axis
    for (const Symbol& symbol : organs.word) {
      if (symbol.type == Symbol::Type::open) {
        stack.push_back({before, branch});
        branch = true;
      } else if (symbol.type == Symbol::Type::close) {
        before = stack.back().before;
        branch = stack.back().branch;
        stack.pop_back();
      } else if (symbol.kind == OrganKind::compound) {
        const int compound =
            symbol.block >= 0 ? organs.blocks[static_cast<std::size_t>(symbol.block)].compound : -1;
        if (compound >= 0) walk(plant_.compounds[static_cast<std::size_t>(compound)], before);
      } else if (symbol.kind != OrganKind::rotation) {
        add_organ(placed_.at(next_++), symbol.ordinal, before, branch);
      }
    }
  }

  std::int32_t add(char edge, const std::string& symbol, int index, std::int32_t cursor) {
    return builder_.add(edge, out_.class_number(symbol, 3), index, cursor, {out_.file}, symbol);
  }

  void add_organ(const PlacedOrgan& organ, int ordinal, std::int32_t& before, bool& branch) {
    std::string symbol(1, static_cast<char>(std::toupper(static_cast<unsigned char>(letter(organ.kind)))));
    const bool carries = organ.kind == OrganKind::stem || organ.kind == OrganKind::bud;
    std::int32_t vertex = 0;
    if (before < 0) {
      if (first_axis_ < 0) first_axis_ = add('/', "A", ++axes_, 0);
      vertex = add('/', symbol, ordinal, first_axis_);
    } else if (!carries && organ.kind == OrganKind::leaf) {
      vertex = add('+', symbol, ordinal, before);
    } else if (branch && carries) {
      const std::int32_t axis = add('+', "A", ++axes_, before);
      vertex = add('/', symbol, ordinal, axis);
    } else {
      vertex = add(branch ? '+' : '<', symbol, ordinal, before);
    }
    set_values(static_cast<std::size_t>(vertex), organ);
    if (!carries) return;
    before = vertex;
    branch = false;
  }

  void set_values(std::size_t v, const PlacedOrgan& organ) {
    constexpr double per_metre = 100;
    const OrganAttributes& a = *organ.attributes;
    Eigen::Vector3d tip = organ.plant_from_organ.translation();
    if (organ.kind == OrganKind::bud)
      tip = organ.plant_from_organ * Eigen::Vector3d(0, 0, 2 * a.radius_m);
    else if (a.length_m > 0)
      tip = organ.plant_from_organ * midrib(a, {1.0}).back().x_m;
    const char* axes[] = {"XX", "YY", "ZZ"};
    for (int k = 0; k < 3; ++k) set(v, axes[k], mtg_number(per_metre * tip[k]));
    if (a.length_m > 0) set(v, "Length", mtg_number(per_metre * a.length_m));
    if (a.width_m > 0) set(v, "Width", mtg_number(per_metre * a.width_m));
    if (a.radius_m > 0) set(v, "Radius", mtg_number(per_metre * a.radius_m));
    if (organ.kind == OrganKind::stem && a.radius_m > 0) {
      const auto fraction = [&](double l) { return a.f_width ? std::max(0.0, a.f_width->value(l)) : 1.0; };
      set(v, "BotDia", mtg_number(2 * per_metre * a.radius_m * fraction(0)));
      set(v, "TopDia", mtg_number(2 * per_metre * a.radius_m * fraction(1)));
    }
    set(v, "Label", organ.label);
    const auto found = organ_of_id_.find(organ.id);
    if (found == organ_of_id_.end()) return;
    const Mesh::Organ& row = mesh_.organs[found->second];
    set(v, "Area", mtg_number(per_metre * per_metre * row.area_m2));
    set(v, "Material", mtg_word(row.material));
    for (const auto& property : organ.properties.empty() ? row.properties : organ.properties)
      set(v, property.first, mtg_word(property.second));
  }

  void set(std::size_t v, const std::string& name, std::string value) {
    if (!value.empty()) out_.set(v, out_.feature_number(name, "ALPHA"), std::move(value));
  }

  const Plant& plant_;
  const Mesh& mesh_;
  Mtg out_;
  MtgBuilder builder_{out_};
  std::unordered_map<int, std::size_t> organ_of_id_;
  std::vector<PlacedOrgan> placed_;
  std::size_t next_ = 0;
  std::int32_t first_axis_ = -1;
  int axes_ = 0;
};

}  // namespace

Mtg plant_mtg(const Plant& plant, const Mesh& mesh) {
  return PlantGraph(plant, mesh).graph();
}

}  // namespace bpms
