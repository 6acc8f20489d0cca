// CSV tables that know their line and column numbers. Comma and point by default; ';' and decimal comma as
// dialect "fr". Quoted fields ("a, b", doubled quotes) are understood; blank lines are skipped; unknown
// columns are kept.
#pragma once
#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.h"

namespace bpms {

struct CsvDialect {
  char separator = ',';
  char decimal = '.';
};
CsvDialect csv_dialect(std::string_view name);  // "en", "fr"; else bad_input

class CsvTable {
 public:
  // Reads the header and all rows; a row with another number of fields than the header is bad_input.
  static CsvTable read(const std::string& path, CsvDialect dialect = {});
  static CsvTable parse(std::string path, std::string text, CsvDialect dialect = {});

  const std::string& path() const { return path_; }
  const std::vector<std::string>& columns() const { return columns_; }
  std::size_t rows() const { return fields_.size() / std::max<std::size_t>(1, columns_.size()); }
  bool has(std::string_view column) const { return find(column) >= 0; }
  int find(std::string_view column) const;     // -1 when absent
  int require(std::string_view column) const;  // or bad_input that names the nearest column of the header

  std::string_view text(std::size_t row, int column) const;
  bool empty(std::size_t row, int column) const { return text(row, column).empty(); }
  double number(std::size_t row, int column) const;  // finite and |x| <= 1e12, or located bad_input
  long long integer(std::size_t row, int column) const;
  SourceLocation where(std::size_t row, int column) const;

 private:
  struct Field {
    std::string text;
    int line;
    int column;
  };
  std::string path_;
  CsvDialect dialect_;
  std::vector<std::string> columns_;
  std::vector<Field> fields_;
};

// Quotes a field where its content asks for it.
std::string csv_field(std::string_view text);
// The shortest decimal that reads back as the same double; "" for a value that is not finite.
std::string csv_number(double value);

}  // namespace bpms
