#include "core/csv.h"

#include <algorithm>
#include <cmath>

#include "core/nearest.h"
#include "core/text.h"

namespace bpms {

CsvDialect csv_dialect(std::string_view name) {
  if (name == "en") return {};
  if (name == "fr") return {';', ','};
  bad_input({}, "unknown CSV dialect {}; known: en (comma, decimal point), fr (semicolon, decimal comma)",
            in_quotes(name));
}

namespace {
std::string_view trimmed(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.remove_suffix(1);
  return text;
}
}  // namespace

CsvTable CsvTable::read(const std::string& path, CsvDialect dialect) {
  return parse(path, read_text(path), dialect);
}

CsvTable CsvTable::parse(std::string path, std::string text, CsvDialect dialect) {
  CsvTable table;
  table.path_ = std::move(path);
  table.dialect_ = dialect;
  std::size_t at = 0;
  int line = 1;
  int column = 1;
  std::vector<Field> row;
  const auto end_row = [&] {
    const bool blank = row.size() == 1 && row[0].text.empty();
    if (!blank && table.columns_.empty()) {
      for (const Field& field : row) {
        if (std::find(table.columns_.begin(), table.columns_.end(), field.text) != table.columns_.end())
          bad_input({table.path_, field.line, field.column}, "the column {} stands twice in the header",
                    in_quotes(field.text));
        table.columns_.push_back(field.text);
      }
    } else if (!blank) {
      if (row.size() != table.columns_.size())
        bad_input({table.path_, row[0].line}, "{} fields, expected {} as in the header", row.size(),
                  table.columns_.size());
      std::move(row.begin(), row.end(), std::back_inserter(table.fields_));
    }
    row.clear();
  };
  while (at < text.size()) {
    Field field{{}, line, column};
    while (at < text.size() && (text[at] == ' ' || text[at] == '\t')) ++at, ++column;
    if (at < text.size() && text[at] == '"') {
      const SourceLocation opened{table.path_, line, column};
      ++at, ++column;
      for (;; ++at, ++column) {
        if (at >= text.size()) bad_input(opened, "a quoted field is never closed");
        if (text[at] == '"') {
          if (at + 1 >= text.size() || text[at + 1] != '"') break;
          ++at, ++column;
        }
        if (text[at] == '\n') ++line, column = 0;
        field.text += text[at];
      }
      ++at, ++column;
      while (at < text.size() && (text[at] == ' ' || text[at] == '\t' || text[at] == '\r')) ++at, ++column;
      if (at < text.size() && text[at] != dialect.separator && text[at] != '\n')
        bad_input({table.path_, line, column},
                  "text after a closing quote, expected '{}' or the end of the line", dialect.separator);
    } else {
      const std::size_t begin = at;
      while (at < text.size() && text[at] != dialect.separator && text[at] != '\n') ++at, ++column;
      std::string_view raw(text.data() + begin, at - begin);
      if (raw.ends_with('\r')) raw.remove_suffix(1);
      field.text = trimmed(raw);
    }
    row.push_back(std::move(field));
    const bool more = at < text.size() && text[at] == dialect.separator;
    if (more) {
      ++at, ++column;
      if (at < text.size()) continue;
      row.push_back({{}, line, column});  // the file ends behind a separator
    }
    end_row();
    if (at < text.size()) ++at;
    ++line, column = 1;
  }
  if (table.columns_.empty()) bad_input({table.path_}, "no header line");
  return table;
}

int CsvTable::find(std::string_view column) const {
  const auto at = std::find(columns_.begin(), columns_.end(), column);
  return at == columns_.end() ? -1 : static_cast<int>(at - columns_.begin());
}

int CsvTable::require(std::string_view column) const {
  const int at = find(column);
  if (at < 0)
    bad_input({path_, 1}, "no column {} in the header{}", in_quotes(column), did_you_mean(column, columns_));
  return at;
}

std::string_view CsvTable::text(std::size_t row, int column) const {
  return fields_[row * columns_.size() + static_cast<std::size_t>(column)].text;
}

SourceLocation CsvTable::where(std::size_t row, int column) const {
  const Field& field = fields_[row * columns_.size() + static_cast<std::size_t>(column)];
  return {path_, field.line, field.column};
}

double CsvTable::number(std::size_t row, int column) const {
  constexpr double largest = 1e12;
  std::string field(text(row, column));
  if (dialect_.decimal != '.') std::replace(field.begin(), field.end(), dialect_.decimal, '.');
  const auto value = parse_number(field);
  if (!value || std::abs(*value) > largest)
    bad_input(where(row, column), "found {} in column {}, expected a finite number",
              in_quotes(text(row, column)), in_quotes(columns_[static_cast<std::size_t>(column)]));
  return *value;
}

long long CsvTable::integer(std::size_t row, int column) const {
  const auto value = parse_integer(text(row, column));
  if (!value)
    bad_input(where(row, column), "found {} in column {}, expected a whole number",
              in_quotes(text(row, column)), in_quotes(columns_[static_cast<std::size_t>(column)]));
  return *value;
}

std::string csv_field(std::string_view text) {
  // The reader trims what is not quoted.
  if (text.find_first_of(",\"\n\r") == std::string_view::npos && trimmed(text) == text)
    return std::string(text);
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"') out += '"';
    out += c;
  }
  return out + "\"";
}

std::string csv_number(double value) {
  return std::isfinite(value) ? fmt::format("{}", value) : std::string();
}

}  // namespace bpms
