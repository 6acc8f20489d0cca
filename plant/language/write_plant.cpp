#include <iterator>

#include "core/units.h"
#include "plant/language/attributes.h"

namespace bpms {
namespace {

// Fifteen digits hold every value that was read from a text of up to fifteen, and rounding to them absorbs
// the rounding of the unit's factor: what is read back and written again is the same text.
std::string rounded(double value) {
  return fmt::format("{:.15g}", value);
}

std::string word_text(const Plant& plant) {
  std::string out;
  for (const Symbol& symbol : plant.word) {
    if (symbol.type == Symbol::Type::open) out += '[';
    if (symbol.type == Symbol::Type::close) out += ']';
    if (symbol.type == Symbol::Type::organ) out += letter(symbol.kind);
    if (symbol.label) fmt::format_to(std::back_inserter(out), "({})", *symbol.label);
  }
  return out;
}

std::string block_text(const Block& block, double metres) {
  std::string out(1, letter(block.kind));
  const auto line = [&](std::string_view name, std::string_view value) {
    fmt::format_to(std::back_inserter(out), "  {} {}\n", name, value);
  };
  if (block.number) fmt::format_to(std::back_inserter(out), " {}", *block.number);
  out += " {\n";
  const OrganAttributes& attributes = block.attributes;
  if (!attributes.material.empty()) line("material", attributes.material);
  if (!attributes.section.empty()) line("section", attributes.section);
  for (const ConstantAttribute& attribute : constant_attributes) {
    const double value = attributes.*attribute.member;
    const double unit = attribute.fraction ? 1 : metres;
    if (value != 0) line(attribute.name, rounded(attribute.angle ? degrees(value) : value / unit));
  }
  for (const FunctionAttribute& attribute : function_attributes) {
    if (attributes.*attribute.member)
      line(attribute.name, organ_function_text(*(attributes.*attribute.member)));
  }
  return out + "}\n";
}

}  // namespace

std::string plant_text(const Plant& plant) {
  const double metres = metres_per_unit(plant.unit, {});
  std::string out = "units " + plant.unit + "\n" + word_text(plant) + "\n";
  for (const Block& block : plant.blocks) out += block_text(block, metres);
  return out;
}

}  // namespace bpms
