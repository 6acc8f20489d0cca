#include "core/text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/nearest.h"
#include "core/units.h"
#include "tests/data.h"

namespace bpms {
namespace {

using enum ErrorKind;

TEST(Text, NumbersAreWholeFiniteAndLocaleFree) {
  EXPECT_EQ(parse_number("-1.5e3"), -1500.0);
  EXPECT_EQ(parse_number("+2"), 2.0);
  for (const char* bad : {"", "nan", "inf", "1,5", "1.5x", "1e999", "0x10", " 1"})
    EXPECT_FALSE(parse_number(bad)) << bad;
  EXPECT_EQ(parse_integer("42"), 42);
  EXPECT_FALSE(parse_integer("4.2"));
}

TEST(Text, TokensKnowTheirPlace) {
  TokenReader reader("w.bpms", "s { # comment }\n  a 1.5}", "{}");
  EXPECT_EQ(reader.next()->text, "s");
  const Token brace = *reader.next();
  EXPECT_EQ(brace.text, "{");
  EXPECT_EQ(brace.column, 3);
  const Token a = *reader.next();
  EXPECT_EQ(reader.where(a).str(), "w.bpms:2:3");
  EXPECT_EQ(reader.number("a value"), 1.5);
  EXPECT_EQ(reader.next()->text, "}");
  EXPECT_FALSE(reader.next());
}

TEST(Text, BadFilesAreNamed) {
  const test::TemporaryFolder folder;
  BPMS_EXPECT_ERROR(read_text(folder / "absent"), missing_resource, "no such file");
  BPMS_EXPECT_ERROR(read_text(folder / "."), missing_resource, "is a folder");
  BPMS_EXPECT_ERROR(read_text(folder.write("e", " \n")), bad_input, "the file is empty");
  BPMS_EXPECT_ERROR(read_text(folder.write("b", std::string("a\nb\0c", 5))), bad_input,
                    "b:2: binary content");
  BPMS_EXPECT_ERROR(read_number_table(folder.write("t", "1 2\n1 x\n"), 2, 2, "x y"), bad_input,
                    "t:2:3: found 'x'");
  BPMS_EXPECT_ERROR(read_number_table(folder.write("t", "1 2\n1\n3 4\n"), 2, 2, "x y"), bad_input,
                    "t:2: 1 columns, expected 2");
}

TEST(Text, NearestWord) {
  EXPECT_EQ(nearest_word("f_inclinaton", {"f_azimuth", "f_inclination"}), "f_inclination");
  EXPECT_EQ(nearest_word("zzz", {"f_azimuth", "f_inclination"}), "");
  EXPECT_EQ(edit_distance("ab", "ba"), 1);
}

TEST(Text, AnErrorIsOneLineWhateverItQuotes) {
  const Error error(bad_input, {"a\nb.csv", 2, 3}, "no column 'x'" + did_you_mean("x", {"y\nz", "\tq"}));
  EXPECT_EQ(std::string(error.what()), "a\\x0ab.csv:2:3: no column 'x'; known: y\\x0az, \\x09q");
  EXPECT_EQ(error.message(), "no column 'x'; known: y\\x0az, \\x09q");
}

TEST(Text, LengthsSayTheirUnit) {
  EXPECT_DOUBLE_EQ(parse_length("25mm", {}), 0.025);
  EXPECT_DOUBLE_EQ(parse_length("0.1 cm", {}), 0.001);
  EXPECT_DOUBLE_EQ(parse_length("1e-3m", {}), 0.001);
  BPMS_EXPECT_ERROR(parse_length("25", {}), bad_input, "has no unit");
  BPMS_EXPECT_ERROR(parse_length("25 parsec", {}), bad_input, "unknown unit of length 'parsec'");
}

TEST(Text, AmountsOfMemorySayTheirUnit) {
  EXPECT_EQ(parse_bytes("4 GiB", {}), std::uint64_t{1} << 32);
  EXPECT_EQ(parse_bytes("0.5kB", {}), 500u);
  EXPECT_EQ(parse_bytes("1e3 MB", {}), 1'000'000'000u);
  BPMS_EXPECT_ERROR(parse_bytes("4", {}), bad_input, "has no unit; write for example 4GiB");
  BPMS_EXPECT_ERROR(parse_bytes("4 gib", {}), bad_input, "unknown unit of memory 'gib'");
  BPMS_EXPECT_ERROR(parse_bytes("0 GiB", {}), bad_input, "out of range");
  BPMS_EXPECT_ERROR(parse_bytes("-1 GiB", {}), bad_input, "out of range");
  BPMS_EXPECT_ERROR(parse_bytes("GiB", {}), bad_input, "expected a memory such as 25GiB");
}

}  // namespace
}  // namespace bpms
