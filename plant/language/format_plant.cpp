#include <algorithm>
#include <charconv>

#include "plant/language/attributes.h"
#include "plant/language/parse.h"
#include "plant/plant_format.h"

namespace bpms {
namespace {

constexpr std::size_t longest_line = 110;
constexpr int indent_step = 2;

// The pieces of an expression's token: numbers, names, single characters.
std::vector<std::string_view> expression_pieces(std::string_view token) {
  std::vector<std::string_view> out;
  while (!token.empty()) {
    std::size_t length = 1;
    if ((token[0] >= '0' && token[0] <= '9') || token[0] == '.') {
      double value = 0;
      const auto [end, code] = std::from_chars(token.data(), token.data() + token.size(), value);
      if (code == std::errc{}) length = static_cast<std::size_t>(end - token.data());
    } else if (is_identifier(token.substr(0, 1))) {
      while (length < token.size() && is_identifier(token.substr(0, length + 1))) ++length;
    }
    out.push_back(token.substr(0, length));
    token.remove_prefix(length);
  }
  return out;
}

// The blanks before a piece of an expression.
class ExpressionSpacing {
 public:
  int before(std::string_view piece) {
    const bool sign = (piece == "-" || piece == "+") && !operand_;
    int out = 1;
    if (last_.empty() || last_ == "(" || piece == ")" || piece == "," || after_sign_) out = 0;
    if (piece == "^" || last_ == "^") out = 0;
    if (piece == "(" && is_identifier(last_)) out = 0;  // a function
    after_sign_ = sign;
    operand_ = piece == ")" ||
               (piece.size() > 1 || std::string_view("()+-*/^,=").find(piece) == std::string_view::npos);
    last_ = piece;
    return out;
  }

 private:
  std::string_view last_;
  bool operand_ = false;  // the last piece ended a number, a name or a parenthesis
  bool after_sign_ = false;
};

class PlantFormatter {
 public:
  PlantFormatter(const std::string& path, std::string_view text)
      : all_(plant_tokens(path, text, true)), code_{path, {}, all_.end} {
    for (std::size_t k = 0; k < all_.tokens.size(); ++k) {
      if (all_.tokens[k].text.front() == '#') continue;
      code_.tokens.push_back(all_.tokens[k]);
      place_.push_back(k);
    }
  }

  std::string run() {
    std::size_t at = 0;
    put_items(at, code_.tokens.size());
    if (at < code_.tokens.size()) syntax_error(code_.where(at), "'}}' without a block before it");
    put_comments(all_.tokens.size(), true);
    end_line();
    return std::move(out_);
  }

 private:
  bool is(std::size_t i, std::string_view text) const { return code_.is(i, text); }
  bool on_line_of_last(std::size_t k) const {
    return k > 0 && all_.tokens[k - 1].line == all_.tokens[k].line;
  }

  // --- characters ---
  void end_line() {
    if (line_is_open_) out_ += '\n';
    line_is_open_ = false;
  }
  void put_text(std::string_view text, int gap) {
    if (line_is_open_)
      out_.append(static_cast<std::size_t>(gap), ' ');
    else
      out_.append(static_cast<std::size_t>(indent_ + (within_item_ ? indent_step : 0)), ' ');
    out_ += text;
    line_is_open_ = true;
    may_be_blank_ = true;
  }
  // Keeps one of the empty lines that stand before a token.
  void put_blank_line(std::size_t k) {
    if (k > 0 && all_.tokens[k].line - all_.tokens[k - 1].line > 1 && may_be_blank_ && !out_.empty())
      out_ += '\n';
  }

  // --- comments ---
  // Those before token `end` of all; with `between` the item before has ended.
  void put_comments(std::size_t end, bool between) {
    for (; next_ < end; ++next_) {
      const Token& token = all_.tokens[next_];
      if (token.text.front() != '#') continue;
      std::string_view text = token.text;
      text = text.substr(0, text.find_last_not_of(" \t\r") + 1);
      if (line_is_open_ && on_line_of_last(next_)) {
        put_text(text, 2);
      } else {
        end_line();
        if (between) within_item_ = false, put_blank_line(next_);
        put_text(text, 0);
      }
      end_line();
    }
  }

  // --- tokens ---
  void put(std::size_t& at, int gap) {
    put_comments(place_[at], false);
    put_text(code_.tokens[at].text, gap);
    next_ = place_[at++] + 1;
    within_item_ = true;
  }
  void begin_item(std::size_t at, bool keep_blank = true) {
    put_comments(place_[at], true);
    end_line();
    within_item_ = false;
    if (keep_blank) put_blank_line(place_[at]);
  }
  // From a "(" to its ")".
  void put_expression(std::size_t& at, int gap) {
    ExpressionSpacing spacing;
    int depth = 0;
    const std::size_t begin = at;
    for (; at < code_.tokens.size(); next_ = place_[at++] + 1) {
      put_comments(place_[at], false);
      for (const std::string_view piece : expression_pieces(code_.tokens[at].text)) {
        const int before = spacing.before(piece);
        put_text(piece, at == begin ? gap : before);
        within_item_ = true;
      }
      if (is(at, "(")) ++depth;
      if (is(at, ")") && --depth == 0) break;
    }
    if (at < code_.tokens.size()) next_ = place_[at++] + 1;
  }
  void put_value(std::size_t& at, std::size_t end) {
    if (at >= end || is(at, "}")) return;
    if (is(at, "("))
      put_expression(at, 1);
    else
      put(at, 1);
  }

  // --- the language ---
  void put_items(std::size_t& at, std::size_t end) {
    while (at < end && !is(at, "}")) {
      begin_item(at);
      const std::string_view text = code_.tokens[at].text;
      if (text == "units" || text == "include") {
        put(at, 1);
        if (at < end) put(at, 1);
      } else if (text == "let") {
        for (int i = 0; i < 3 && at < end; ++i) put(at, 1);
        put_value(at, end);
      } else if (text == "organ") {
        put_organ(at, end);
      } else if (begins_block(code_, at)) {
        put_block(at, end);
      } else {
        put_word(at, end);
      }
    }
  }

  void put_organ(std::size_t& at, std::size_t end) {
    for (int i = 0; i < 2 && at < end; ++i) put(at, 1);
    if (is(at, "(")) put_expression(at, 0);
    if (at >= end || !is(at, "{")) return;
    put(at, 1);
    indent_ += indent_step;
    may_be_blank_ = false;
    put_items(at, end);
    if (at >= end) syntax_error(code_.end, "the file ends where '}}' was expected");
    begin_item_after_body(at);
    put(at, 0);
  }
  // The closing brace: what comments stand before it belong to the body.
  void begin_item_after_body(std::size_t at) {
    begin_item(at, false);
    indent_ -= indent_step;
  }

  void put_word(std::size_t& at, std::size_t end) {
    const std::size_t word_end = std::min(end, word_end_of(at));
    const std::size_t begin = at;
    while (at < word_end) {
      if (is(at, "(")) {
        put_expression(at, 0);
        continue;
      }
      if (at > begin && code_.tokens[at].line != code_.tokens[at - 1].line) {
        put_comments(place_[at], false);
        end_line();
      }
      put(at, at > begin && touches(at) ? 0 : 1);
    }
  }
  std::size_t word_end_of(std::size_t at) const {
    int depth = 0;
    for (std::size_t i = at; i < code_.tokens.size(); ++i) {
      if (is(i, "}") && depth == 0) return i > at ? i : at + 1;  // the end of an organ's body
      if (is(i, "{")) break;
    }
    return std::max(first_block(code_, at), at + 1);
  }
  bool touches(std::size_t at) const {
    const Token& before = code_.tokens[at - 1];
    return before.line == code_.tokens[at].line &&
           before.column + static_cast<int>(before.text.size()) == code_.tokens[at].column;
  }

  // In one line if it stands in one and fits.
  void put_block(std::size_t& at, std::size_t end) {
    const std::size_t close = closing_brace(at);
    if (code_.tokens[at].line == code_.tokens[close].line) {
      const std::size_t begin = at, next = next_, written = out_.size();
      put_block_lines(at, end, true);
      if (out_.size() - written <= longest_line) return;
      at = begin, next_ = next;  // once more, in several lines
      out_.resize(written);
      line_is_open_ = within_item_ = false;
    }
    put_block_lines(at, end, false);
  }
  std::size_t closing_brace(std::size_t at) const {
    std::size_t i = at;
    while (i < code_.tokens.size() && !is(i, "}")) ++i;
    if (i == code_.tokens.size())
      syntax_error(code_.where(at), "block opened here is never closed, expected '}}'");
    return i;
  }
  void put_block_lines(std::size_t& at, std::size_t end, bool one_line) {
    while (!is(at, "{")) put(at, 1);
    put(at, 1);
    if (!one_line) indent_ += indent_step, may_be_blank_ = false;
    bool first = true;
    while (at < end && !is(at, "}")) {
      if (!one_line) begin_item(at);
      put_attribute(at, end, first ? 1 : 2);
      first = false;
    }
    if (!one_line) begin_item_after_body(at);
    put(at, 1);
  }

  void put_attribute(std::size_t& at, std::size_t end, int gap) {
    const std::string_view name = code_.tokens[at].text;
    const auto is_name = [&](const FunctionAttribute& attribute) { return attribute.name == name; };
    const bool function = std::ranges::any_of(function_attributes, is_name);
    put(at, gap);
    put_value(at, end);
    while (function && at < end && (is(at, "(") || begins_number(code_.tokens[at].text))) put_value(at, end);
  }
  static bool begins_number(std::string_view text) {
    return std::string_view("0123456789+-.").find(text.front()) != std::string_view::npos;
  }

  PlantTokens all_, code_;          // with comments, without
  std::vector<std::size_t> place_;  // of code_'s tokens among all_'s
  std::size_t next_ = 0;            // of all_, to be written
  std::string out_;
  int indent_ = 0;
  bool line_is_open_ = false;
  bool within_item_ = false;
  bool may_be_blank_ = false;  // something stands in this body already
};

}  // namespace

std::string formatted_plant(const std::string& path, std::string_view text) {
  return PlantFormatter(path, text).run();
}

}  // namespace bpms
