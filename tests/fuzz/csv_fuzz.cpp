// CSV tables from arbitrary bytes: parsing, access to every field as text, number and integer, and the
// writers' promise that what they write reads back.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "core/csv.h"
#include "tests/fuzz/answer.h"

namespace {

template <class F>
void answer(const F& f) {
  bpms::fuzz::answer("fuzz.csv", f);
}

void walk(const bpms::CsvTable& table) {
  std::string again;
  for (std::size_t c = 0; c < table.columns().size(); ++c) {
    again += (c ? "," : "") + bpms::csv_field(table.columns()[c]);
    (void)table.find(table.columns()[c]);
  }
  again += "\n";
  for (std::size_t row = 0; row < table.rows(); ++row) {
    for (int c = 0; c < static_cast<int>(table.columns().size()); ++c) {
      again += (c ? "," : "") + bpms::csv_field(table.text(row, c));
      if (table.where(row, c).line < 1 || table.where(row, c).column < 1) std::abort();
      answer([&] {
        const double value = table.number(row, c);
        const std::string written = "x\n" + bpms::csv_number(value) + "\n";
        if (bpms::CsvTable::parse("fuzz.csv", written).number(0, 0) != value) std::abort();
      });
      answer([&] { (void)table.integer(row, c); });
    }
    again += "\n";
  }
  answer([&] { (void)table.require("u_px"); });
  const bpms::CsvTable back = bpms::CsvTable::parse("fuzz.csv", again);
  if (back.columns() != table.columns() || back.rows() != table.rows()) std::abort();
  for (std::size_t row = 0; row < table.rows(); ++row)
    for (int c = 0; c < static_cast<int>(table.columns().size()); ++c)
      if (back.text(row, c) != table.text(row, c)) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  for (const char* dialect : {"en", "fr"})
    answer([&] { walk(bpms::CsvTable::parse("fuzz.csv", text, bpms::csv_dialect(dialect))); });
  return 0;
}
