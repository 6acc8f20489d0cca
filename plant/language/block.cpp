#include <algorithm>
#include <cmath>

#include "core/nearest.h"
#include "core/units.h"
#include "plant/geometry/sections/section.h"
#include "plant/language/attributes.h"
#include "plant/language/parse.h"

namespace bpms {
namespace {

constexpr double largest_size_m = 1e4;
constexpr double largest_angle_deg = 1e6;
constexpr double largest_fraction = 1;

bool begins_like_number(std::string_view text) {
  const char c = text.front();
  const bool sign_or_digit = (c >= '0' && c <= '9') || c == '-' || c == '+' || c == '.';
  return sign_or_digit || text == "nan" || text == "NaN" || text == "inf";
}

bool is_word(std::string_view text) {
  return std::ranges::all_of(text, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '-' || c == '.';
  });
}

class BlockParser {
 public:
  BlockParser(const PlantTokens& text, std::size_t& at, double metres)
      : text_(text), at_(at), metres_(metres) {}

  Block parse() {
    parse_header();
    const SourceLocation opened = text_.where(at_++);
    for (;;) {
      if (at_ >= text_.tokens.size())
        syntax_error(opened, "block opened here is never closed, expected '}}'");
      const std::string_view name = text_.tokens[at_].text;
      if (name == "}") break;
      if (name == "{") syntax_error(text_.where(at_), "'{{' inside a block; is a '}}' missing before it?");
      parse_attribute(name);
    }
    ++at_;
    check_section();
    return std::move(block_);
  }

 private:
  void parse_header() {
    const Token& token = text_.tokens[at_];
    block_.where = text_.where(at_);
    const std::size_t kind = token.text.size() == 1 ? organ_letters.find(token.text) : std::string_view::npos;
    if (kind == std::string_view::npos)
      syntax_error(block_.where, "found {}, expected a block: a letter of b s l h +, its number, '{{'",
                   in_quotes(token.text));
    letter_ = token.text[0];
    block_.kind = static_cast<OrganKind>(kind);
    ++at_;
    if (at_ < text_.tokens.size() && text_.tokens[at_].text != "{") {
      const auto number = parse_integer(text_.tokens[at_].text);
      constexpr long long largest = 1'000'000'000;
      if (!number || *number < 0 || *number > largest)
        syntax_error(text_.where(at_), "found {}, expected the block's number or '{{'",
                     in_quotes(text_.tokens[at_].text));
      block_.number = static_cast<int>(*number);
      ++at_;
    }
    if (at_ >= text_.tokens.size()) syntax_error(text_.end, "the file ends where '{{' was expected");
    if (text_.tokens[at_].text != "{")
      syntax_error(text_.where(at_), "found {}, expected '{{'", in_quotes(text_.tokens[at_].text));
  }

  void parse_attribute(std::string_view name) {
    const SourceLocation where = text_.where(at_++);
    if (name == "material") return once(name, where, material_letters), parse_material();
    if (name == "section") return once(name, where, section_letters), parse_section();
    for (const ConstantAttribute& attribute : constant_attributes) {
      if (attribute.name == name) return once(name, where, attribute.letters), parse_constant(attribute);
    }
    for (const FunctionAttribute& attribute : function_attributes) {
      if (attribute.name == name) return once(name, where, attribute.letters), parse_function(attribute);
    }
    if (begins_like_number(name))
      syntax_error(where, "found {}, expected an attribute name or '}}'", in_quotes(name));
    syntax_error(where, "unknown attribute {}{}", in_quotes(name), did_you_mean(name, names(letter_)));
  }

  static std::vector<std::string> names(char organ) {
    std::vector<std::string> out;
    const auto add = [&](std::string_view name, std::string_view letters) {
      if (letters.find(organ) != std::string_view::npos) out.emplace_back(name);
    };
    add("material", material_letters);
    add("section", section_letters);
    for (const ConstantAttribute& attribute : constant_attributes) add(attribute.name, attribute.letters);
    for (const FunctionAttribute& attribute : function_attributes) add(attribute.name, attribute.letters);
    return out;
  }

  // Refuses what this kind of organ does not have, repetitions, and a_ beside f_ of one name.
  void once(std::string_view name, const SourceLocation& where, std::string_view letters) {
    if (letters.find(letter_) == std::string_view::npos) {
      std::string known;
      for (const std::string& other : names(letter_)) known += (known.empty() ? "" : ", ") + other;
      semantic_error(where, "a {} has no {}; it has {}", organ_name(block_.kind), name, known);
    }
    for (const std::string_view other : seen_) {
      if (other == name) semantic_error(where, "a second '{}' in one block", name);
      const bool same_angle = name.size() > 2 && other.size() > 2 && other.substr(1) == name.substr(1);
      if (same_angle && name != "a_width" && name != "f_width")
        semantic_error(where, "'{}' beside '{}' in one block: give the constant or the function", name,
                       other);
    }
    seen_.push_back(name);
  }

  void parse_material() {
    if (at_ >= text_.tokens.size())
      syntax_error(text_.end, "the file ends where a material's name was expected");
    const std::string_view value = text_.tokens[at_].text;
    const std::vector<std::string> known = names(letter_);
    if (!is_word(value) || std::ranges::find(known, value) != known.end())
      syntax_error(text_.where(at_), "found {}, expected a material's name (letters, digits, _ - .)",
                   in_quotes(value));
    block_.attributes.material = value;
    ++at_;
  }

  void parse_section() {
    section_at_ = text_.where(at_);
    if (at_ >= text_.tokens.size())
      syntax_error(text_.end, "the file ends where a section's name was expected");
    const std::string_view value = text_.tokens[at_].text;
    if (!is_leaf_section(value)) {
      std::string known;
      for (const std::string& name : leaf_section_names()) known += (known.empty() ? "" : ", ") + name;
      semantic_error(section_at_, "unknown section {}; known: {}{}", in_quotes(value), known,
                     did_you_mean(value, leaf_section_names()));
    }
    block_.attributes.section = value;
    ++at_;
  }

  // What a leaf's section needs, and what it cannot use.
  void check_section() const {
    const OrganAttributes& leaf = block_.attributes;
    const LeafSection& section = leaf_section(leaf.section);
    const SourceLocation& where = leaf.section.empty() ? block_.where : section_at_;
    if (!section.has_curvature() && leaf.f_curvature)
      semantic_error(where, "a section {} has no f_curvature", section.name());
    const bool given = leaf.midrib_width > 0 || leaf.midrib_height > 0;
    if (!section.has_raised_midrib() && given)
      semantic_error(where, "a section {} has no a_midrib_width and no a_midrib_height; raised_midrib has",
                     section.name());
    if (section.has_raised_midrib() && !(leaf.midrib_width > 0 && leaf.midrib_height > 0))
      semantic_error(where, "a section {} needs a_midrib_width and a_midrib_height, over the leaf's width",
                     section.name());
    if (const std::string complaint = section.complaint(section_form(leaf, 0)); !complaint.empty())
      semantic_error(where, "{}", complaint);
  }

  double number(std::string_view what) {
    if (at_ >= text_.tokens.size()) syntax_error(text_.end, "the file ends where {} was expected", what);
    const auto value = parse_number(text_.tokens[at_].text);
    if (!value)
      syntax_error(text_.where(at_), "found {}, expected {} (a finite number)",
                   in_quotes(text_.tokens[at_].text), what);
    ++at_;
    return *value;
  }

  void parse_constant(const ConstantAttribute& attribute) {
    const SourceLocation where = text_.where(at_);
    const double value = number(attribute.name);
    if (attribute.angle) {
      if (std::abs(value) > largest_angle_deg)
        semantic_error(where, "{} is {} degrees, expected at most {}", attribute.name, value,
                       largest_angle_deg);
      block_.attributes.*attribute.member = radians(value);
      return;
    }
    if (value <= 0) semantic_error(where, "{} is {}, expected a size above 0", attribute.name, value);
    if (attribute.fraction) {
      if (value > largest_fraction)
        semantic_error(where, "{} is {}, expected a fraction of the leaf's width, at most {}", attribute.name,
                       value, largest_fraction);
      block_.attributes.*attribute.member = value;
      return;
    }
    if (value * metres_ > largest_size_m)
      semantic_error(where, "{} is {} m, expected at most {} m", attribute.name, value * metres_,
                     largest_size_m);
    block_.attributes.*attribute.member = value * metres_;
  }

  void parse_function(const FunctionAttribute& attribute) {
    const SourceLocation where = text_.where(at_);
    if (at_ >= text_.tokens.size() || text_.tokens[at_].text == "}")
      syntax_error(where, "{} without a function, expected a code and numbers: n 0 0 1 90", attribute.name);
    const std::string_view code = text_.tokens[at_].text;
    if (code.size() != 1)
      syntax_error(where, "found {}, expected a function code (n, p, f or s)", in_quotes(code));
    ++at_;
    std::vector<double> numbers;
    while (at_ < text_.tokens.size() && begins_like_number(text_.tokens[at_].text))
      numbers.push_back(number("a number of the function"));
    try {
      block_.attributes.*attribute.member =
          make_organ_function(code[0], std::move(numbers), attribute.angle ? radians(1) : 1.0, where);
    } catch (const Error& error) {
      syntax_error(where, "{}: {}", attribute.name, error.message());
    }
  }

  const PlantTokens& text_;
  std::size_t& at_;
  double metres_;
  char letter_ = 0;
  SourceLocation section_at_;
  Block block_;
  std::vector<std::string_view> seen_;
};

}  // namespace

Block parse_block(const PlantTokens& text, std::size_t& at, double metres) {
  return BlockParser(text, at, metres).parse();
}

}  // namespace bpms
