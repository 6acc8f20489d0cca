#include "core/csv.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/data.h"

namespace bpms {
namespace {

using enum ErrorKind;

TEST(Csv, ReadsQuotedFieldsBlankLinesAndCarriageReturns) {
  const CsvTable table = CsvTable::parse("t.csv", "a,b\r\n\"x, \"\"y\"\"\",2.5\r\n\r\n z ,-3e2\r\n");
  ASSERT_EQ(table.rows(), 2u);
  EXPECT_EQ(table.text(0, 0), "x, \"y\"");
  EXPECT_EQ(table.text(1, 0), "z");
  EXPECT_DOUBLE_EQ(table.number(0, 1), 2.5);
  EXPECT_DOUBLE_EQ(table.number(1, 1), -300);
}

TEST(Csv, FrenchDialect) {
  const CsvTable table = CsvTable::parse("t.csv", "x;y\n1,5;2\n", csv_dialect("fr"));
  EXPECT_DOUBLE_EQ(table.number(0, 0), 1.5);
}

TEST(Csv, ErrorsNameLineAndColumn) {
  BPMS_EXPECT_ERROR(CsvTable::parse("t.csv", "a,b\n1,x\n").number(0, 1), bad_input, "t.csv:2:3: found 'x'");
  BPMS_EXPECT_ERROR(CsvTable::parse("t.csv", "a,b\n1,nan\n").number(0, 1), bad_input, "t.csv:2:3");
  BPMS_EXPECT_ERROR(CsvTable::parse("t.csv", "a,b\n1,1e300\n").number(0, 1), bad_input, "finite");
  BPMS_EXPECT_ERROR(CsvTable::parse("t.csv", "a,b\n1\n"), bad_input, "t.csv:2: 1 fields, expected 2");
  BPMS_EXPECT_ERROR(CsvTable::parse("t.csv", "a,a\n"), bad_input, "t.csv:1:3: the column 'a' stands twice");
  BPMS_EXPECT_ERROR(CsvTable::parse("t.csv", "a,b\n1,\"x\n"), bad_input,
                    "t.csv:2:3: a quoted field is never closed");
  BPMS_EXPECT_ERROR(CsvTable::parse("t.csv", "plant,axis\n").require("plnat"), bad_input,
                    "no column 'plnat' in the header; did you mean 'plant'?");
}

TEST(Csv, FieldsRoundTrip) {
  for (const std::string text :
       {"plain", "with, comma", "with \"quotes\"", "two\nlines", " blanks ", "\t", ""}) {
    const CsvTable table = CsvTable::parse("t.csv", "a,b\n" + csv_field(text) + ",1\n");
    EXPECT_EQ(table.text(0, 0), text);
  }
  for (const double value : {0.1, 1.0 / 3.0, -1e-300, 12345678.9}) {
    const CsvTable table = CsvTable::parse("t.csv", "a\n" + csv_number(value) + "\n");
    EXPECT_EQ(table.number(0, 0), value);
  }
}

}  // namespace
}  // namespace bpms
