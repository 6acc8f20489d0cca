#include <iterator>
#include <set>

#include "core/units.h"
#include "plant/language/attributes.h"
#include "plant/language/tokens.h"

namespace bpms {
namespace {

// Fifteen digits hold every value that was read from a text of up to fifteen, and rounding to them absorbs
// the rounding of the unit's factor: what is read back and written again is the same text.
std::string rounded(double value) {
  return fmt::format("{:.15g}", value);
}

std::string word_text(const OrganWord& organs) {
  std::string out;
  for (const Symbol& symbol : organs.word) {
    if (symbol.type == Symbol::Type::open) out += '[';
    if (symbol.type == Symbol::Type::close) out += ']';
    if (symbol.type == Symbol::Type::organ) out += letter(symbol.kind);
    if (symbol.label) fmt::format_to(std::back_inserter(out), "({})", *symbol.label);
  }
  return out;
}

// Two uses of one organ with different values are two organs here: frond and frond_2.
std::vector<std::string> compound_names(const Plant& plant) {
  std::set<std::string> taken;
  for (const CompoundOrgan& organ : plant.compounds) taken.insert(organ.name);
  std::vector<std::string> out;
  std::set<std::string> seen;
  for (const CompoundOrgan& organ : plant.compounds) {
    std::string name = organ.name;
    if (!seen.insert(name).second) {
      // "p_2" would be a property.
      const std::string stem = is_attribute_name(organ.name + "_2") ? "organ_" + organ.name : organ.name;
      for (int k = 2; !taken.insert(name).second; ++k) name = fmt::format("{}_{}", stem, k);
    }
    out.push_back(name);
  }
  return out;
}

std::string block_text(const Block& block, const std::string& unit, const std::vector<std::string>& names) {
  std::string out(1, letter(block.kind));
  const auto line = [&](std::string_view name, std::string_view value) {
    fmt::format_to(std::back_inserter(out), "  {} {}\n", name, value);
  };
  if (block.number) fmt::format_to(std::back_inserter(out), " {}", *block.number);
  out += " {\n";
  if (block.compound >= 0) line("organ", names[static_cast<std::size_t>(block.compound)]);
  for (const AttributeLine& attribute : attribute_lines(block.attributes, unit))
    line(attribute.name, attribute.value);
  for (const auto& [name, value] : block.attributes.properties)
    line(std::string(property_prefix) + name, property_text(value));
  return out + "}\n";
}

std::string organs_text(const OrganWord& organs, const std::string& unit,
                        const std::vector<std::string>& names) {
  std::string out = word_text(organs) + "\n";
  for (const Block& block : organs.blocks) out += block_text(block, unit, names);
  return out;
}

}  // namespace

std::vector<AttributeLine> attribute_lines(const OrganAttributes& attributes, const std::string& unit) {
  const double metres = metres_per_unit(unit, {});
  std::vector<AttributeLine> out;
  for (const NameAttribute& attribute : name_attributes) {
    const std::string& value = attributes.*attribute.member;
    if (!value.empty()) out.push_back({std::string(attribute.name), value, ""});
  }
  for (const ConstantAttribute& attribute : constant_attributes) {
    const double value = attributes.*attribute.member;
    if (value == 0) continue;
    if (attribute.angle)
      out.push_back({std::string(attribute.name), rounded(degrees(value)), "deg"});
    else
      out.push_back({std::string(attribute.name), rounded(value / metres), unit});
  }
  for (const NumberAttribute& attribute : number_attributes) {
    if (attributes.*attribute.member != 0)
      out.push_back({std::string(attribute.name), rounded(attributes.*attribute.member), ""});
  }
  for (const FunctionAttribute& attribute : function_attributes) {
    if (attributes.*attribute.member)
      out.push_back({std::string(attribute.name), organ_function_text(*(attributes.*attribute.member)), ""});
  }
  return out;
}

std::string property_text(std::string_view value) {
  return is_plain_word(value) && !is_attribute_name(value) ? std::string(value) : quoted(value);
}

std::string plant_text(const Plant& plant) {
  const std::vector<std::string> names = compound_names(plant);
  std::string out = "units " + plant.unit + "\n";
  for (std::size_t i = 0; i < plant.compounds.size(); ++i)
    out += "organ " + names[i] + " {\n" + organs_text(plant.compounds[i], plant.unit, names) + "}\n";
  return out + organs_text(plant, plant.unit, names);
}

}  // namespace bpms
