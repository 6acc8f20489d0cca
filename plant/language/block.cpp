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

bool begins_like_number(std::string_view text) {
  const char c = text.front();
  const bool sign_or_digit = (c >= '0' && c <= '9') || c == '-' || c == '+' || c == '.';
  return sign_or_digit || text == "nan" || text == "NaN" || text == "inf";
}

constexpr std::string_view section_attribute = "section";
constexpr std::string_view organ_attribute = "organ";  // of c: which one

class BlockParser {
 public:
  BlockParser(const PlantTokens& text, std::size_t& at, const std::string& unit, const Scope& scope)
      : text_(text), at_(at), unit_(unit), metres_(metres_per_unit(unit, {})), scope_(scope) {}

  ParsedBlock parse() {
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
    if (block_.kind == OrganKind::compound && out_.use->organ.empty())
      semantic_error(block_.where, "this block does not say which organ, expected: organ NAME");
    out_.notes = size_notes(block_, unit_, [&](std::string_view name) { return place_of(name); });
    return std::move(out_);
  }

 private:
  void parse_header() {
    const Token& token = text_.tokens[at_];
    block_.where = text_.where(at_);
    const std::size_t kind = token.text.size() == 1 ? organ_letters.find(token.text) : std::string_view::npos;
    if (kind == std::string_view::npos)
      syntax_error(block_.where, "found {}, expected a block: a letter of b s l h c +, its number, '{{'{}",
                   in_quotes(token.text),
                   is_statement(token.text) ? "; let, organ and include stand before the word" : "");
    letter_ = token.text[0];
    block_.kind = static_cast<OrganKind>(kind);
    if (block_.kind == OrganKind::compound) out_.use.emplace().unit = unit_;
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
    const std::size_t place = at_++;
    for (const NameAttribute& attribute : name_attributes) {
      if (attribute.name == name) {
        once(name, place, attribute.letters);
        block_.attributes.*attribute.member =
            parse_name(attribute.name == section_attribute ? "a section's name" : "a material's name");
        return;
      }
    }
    for (const ConstantAttribute& attribute : constant_attributes) {
      if (attribute.name == name) return once(name, place, attribute.letters), parse_constant(attribute);
    }
    for (const NumberAttribute& attribute : number_attributes) {
      if (attribute.name == name) return once(name, place, attribute.letters), parse_plain(attribute);
    }
    for (const FunctionAttribute& attribute : function_attributes) {
      if (attribute.name == name) return once(name, place, attribute.letters), parse_function(attribute);
    }
    if (is_property(name)) return once(name, place, property_letters), parse_property(name);
    if (name == organ_attribute && block_.kind == OrganKind::compound) {
      once(name, place, "c");
      out_.use->where = text_.where(at_);
      out_.use->organ = parse_name("the name of an organ");
      return;
    }
    const SourceLocation where = text_.where(place);
    if (begins_like_number(name))
      syntax_error(where, "found {}, expected an attribute name or '}}'", in_quotes(name));
    if (block_.kind == OrganKind::compound && is_identifier(name)) {
      once(name, place, "c");
      const double value = read_number(text_, at_, scope_, fmt::format("the value of {}", name));
      out_.use->arguments.push_back({std::string(name), value, where});
      return;
    }
    syntax_error(where, "unknown attribute {}{}", in_quotes(name), did_you_mean(name, names(letter_)));
  }

  static std::vector<std::string> names(char organ) {
    std::vector<std::string> out;
    const auto add = [&](std::string_view name, std::string_view letters) {
      if (letters.find(organ) != std::string_view::npos) out.emplace_back(name);
    };
    for (const NameAttribute& attribute : name_attributes) add(attribute.name, attribute.letters);
    for (const ConstantAttribute& attribute : constant_attributes) add(attribute.name, attribute.letters);
    for (const NumberAttribute& attribute : number_attributes) add(attribute.name, attribute.letters);
    for (const FunctionAttribute& attribute : function_attributes) add(attribute.name, attribute.letters);
    add(organ_attribute, "c");
    return out;
  }

  SourceLocation place_of(std::string_view name) const {
    for (const Seen& seen : seen_) {
      if (seen.name == name) return text_.where(seen.token);
    }
    return block_.where;
  }

  // Refuses what this kind of organ does not have, repetitions, and a_ beside f_ of one name.
  void once(std::string_view name, std::size_t place, std::string_view letters) {
    if (letters.find(letter_) == std::string_view::npos) {
      std::string known;
      for (const std::string& other : names(letter_)) known += (known.empty() ? "" : ", ") + other;
      semantic_error(text_.where(place), "a {} has no {}; it has {}", organ_name(block_.kind), name, known);
    }
    for (const Seen& seen : seen_) {
      const std::string_view other = seen.name;
      if (other == name) semantic_error(text_.where(place), "a second '{}' in one block", name);
      const bool one_of_each = (name.starts_with("a_") && other.starts_with("f_")) ||
                               (name.starts_with("f_") && other.starts_with("a_"));
      if (one_of_each && other.substr(1) == name.substr(1) && name.substr(1) != "_width")
        semantic_error(text_.where(place), "'{}' beside '{}' in one block: give the constant or the function",
                       name, other);
    }
    seen_.push_back({name, place});
  }

  // What a leaf's section needs, and what it cannot use. A number that depends on a parameter without a value
  // is not known yet, and not 0.
  void check_section() const {
    const OrganAttributes& leaf = block_.attributes;
    const SourceLocation where = place_of(section_attribute);
    if (!leaf.section.empty() && !is_leaf_section(leaf.section)) {
      std::string known;
      for (const std::string& name : leaf_section_names()) known += (known.empty() ? "" : ", ") + name;
      semantic_error(where, "unknown section {}; known: {}{}", in_quotes(leaf.section), known,
                     did_you_mean(leaf.section, leaf_section_names()));
    }
    const LeafSection& section = leaf_section(leaf.section);
    const auto given = [&](std::string_view name) {
      return std::ranges::any_of(seen_, [&](const Seen& seen) { return seen.name == name; });
    };
    if (!section.has_curvature() && given("f_curvature"))
      semantic_error(place_of("f_curvature"), "a section {} has no f_curvature", section.name());
    for (const char* name : {"a_midrib_width", "a_midrib_height"}) {
      if (!section.has_raised_midrib() && given(name))
        semantic_error(place_of(name), "a section {} has no {}; raised_midrib has", section.name(), name);
      if (section.has_raised_midrib() && !given(name))
        semantic_error(where, "a section {} needs a_midrib_width and a_midrib_height, over the leaf's width",
                       section.name());
    }
    if (std::isnan(leaf.midrib_width) || std::isnan(leaf.midrib_height)) return;
    if (const std::string complaint = section.complaint(section_form(leaf, 0)); !complaint.empty())
      semantic_error(where, "{}", complaint);
  }

  std::string parse_name(std::string_view what) {
    if (at_ >= text_.tokens.size()) syntax_error(text_.end, "the file ends where {} was expected", what);
    const std::string_view value = text_.tokens[at_].text;
    if (!is_plain_word(value) || is_own_attribute(value))
      syntax_error(text_.where(at_), "found {}, expected {} (letters, digits, _ - .)", in_quotes(value),
                   what);
    ++at_;
    return std::string(value);
  }

  bool is_own_attribute(std::string_view name) const {
    const std::vector<std::string> known = names(letter_);
    return std::ranges::find(known, name) != known.end();
  }

  static bool is_property(std::string_view name) {
    return name.starts_with(property_prefix) && name.size() > property_prefix.size() && is_identifier(name);
  }

  void parse_property(std::string_view name) {
    if (at_ >= text_.tokens.size())
      syntax_error(text_.end, "the file ends where {}'s value was expected", name);
    const std::string_view token = text_.tokens[at_].text;
    std::string value;
    if (token == "(") {
      value = fmt::format("{}", read_number(text_, at_, scope_, name));
    } else if (token.front() == '"') {
      value = unquoted(token);
      ++at_;
    } else if (is_plain_word(token) && !is_own_attribute(token) && !token.starts_with(property_prefix)) {
      value = token;
      ++at_;
    } else {
      syntax_error(text_.where(at_),
                   "found {}, expected the value of {}: letters, digits, _ - . or a text in quotes",
                   in_quotes(token), name);
    }
    block_.attributes.properties.emplace_back(name.substr(property_prefix.size()), std::move(value));
  }

  double number(std::string_view what) { return read_number(text_, at_, scope_, what); }

  void parse_plain(const NumberAttribute& attribute) {
    const SourceLocation where = text_.where(at_);
    const double value = number(attribute.name);
    if (value < 0 || value > attribute.most)
      semantic_error(where, "{} is {}, expected a number from 0 to {}", attribute.name, value,
                     attribute.most);
    block_.attributes.*attribute.member = value;
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
    bool known = true;
    while (at_ < text_.tokens.size() && (begins_like_number(text_.tokens[at_].text) || text_.is(at_, "("))) {
      numbers.push_back(number("a number of the function"));
      known = known && !std::isnan(numbers.back());
    }
    if (!known) return;  // depends on a parameter without a value
    try {
      block_.attributes.*attribute.member =
          make_organ_function(code[0], std::move(numbers), attribute.angle ? radians(1) : 1.0, where);
    } catch (const Error& error) {
      syntax_error(where, "{}: {}", attribute.name, error.message());
    }
  }

  const PlantTokens& text_;
  std::size_t& at_;
  const std::string& unit_;
  double metres_;
  const Scope& scope_;
  char letter_ = 0;
  ParsedBlock out_;
  Block& block_ = out_.block;
  struct Seen {
    std::string_view name;
    std::size_t token;
  };
  std::vector<Seen> seen_;
};

}  // namespace

bool is_attribute_name(std::string_view name) {
  const auto is = [name](const auto& attribute) { return attribute.name == name; };
  return std::ranges::any_of(name_attributes, is) || std::ranges::any_of(constant_attributes, is) ||
         std::ranges::any_of(number_attributes, is) || std::ranges::any_of(function_attributes, is) ||
         name == organ_attribute || name.starts_with(property_prefix);
}

ParsedBlock parse_block(const PlantTokens& text, std::size_t& at, const std::string& unit,
                        const Scope& scope) {
  return BlockParser(text, at, unit, scope).parse();
}

void add_block(std::vector<ParsedBlock>& blocks, ParsedBlock block) {
  for (const ParsedBlock& other : blocks) {
    if (other.block.kind != block.block.kind || other.block.number != block.block.number) continue;
    const std::string number = block.block.number ? fmt::format(" {}", *block.block.number) : std::string();
    const SourceLocation& first = other.block.where;
    semantic_error(block.block.where, "a second block '{}{}'; the first is at {}", letter(block.block.kind),
                   number,
                   first.file == block.block.where.file ? fmt::format("line {}", first.line) : first.str());
  }
  blocks.push_back(std::move(block));
}

}  // namespace bpms
