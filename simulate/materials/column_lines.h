// Lines of text in columns, one after the other: separated by commas, semicolons or white space. '#' starts a
// comment; lines without anything else are passed over. Between commas an empty field counts, but for those
// at the end; quotes and white space around a field are no part of it.
#pragma once
#include <string_view>
#include <vector>

namespace bpms {

struct ColumnField {
  std::string_view text;
  int column;  // where it stands in its line, from 1
};

class ColumnLines {
 public:
  explicit ColumnLines(std::string_view text) : text_(text) {}  // which must outlive it
  bool next();  // to the next line that holds something; false: there is none
  int number() const { return number_; }
  const std::vector<ColumnField>& fields() const { return fields_; }

 private:
  std::string_view text_;
  std::size_t at_ = 0;
  int number_ = 0;
  std::vector<ColumnField> fields_;
};

}  // namespace bpms
