#include "core/toml.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/data.h"

namespace bpms {
namespace {

using enum ErrorKind;

TEST(Toml, ReadsValues) {
  const auto document =
      TomlDocument::parse("s.toml", "a = 1\n[t]\nb = \"x\"\nc = [1, 2.5]\n[[r]]\nd = true\n");
  const TomlValue root = document.root();
  EXPECT_DOUBLE_EQ(root.require("a").number(), 1);
  EXPECT_EQ(root.get("t").require("b").string(), "x");
  EXPECT_EQ(root.get("t").get("c").numbers(2), (std::vector<double>{1, 2.5}));
  EXPECT_TRUE(root.get("r")[0].get("d").boolean());
  EXPECT_FALSE(root.get("absent"));
  EXPECT_DOUBLE_EQ(root.number_or("absent", 7), 7);
  document.finish();
}

TEST(Toml, UnknownKeyNamesTheNearest) {
  const auto document = TomlDocument::parse("s.toml", "[sampling]\nmax_sample = 3\n");
  document.root().get("sampling").get("max_samples");
  BPMS_EXPECT_ERROR(document.finish(), bad_input,
                    "s.toml:2:1: unknown key 'max_sample'; did you mean 'max_samples'?");
  const auto missing = TomlDocument::parse("s.toml", "[sampling]\nmax_sample = 3\n");
  BPMS_EXPECT_ERROR(missing.root().get("sampling").require("max_samples"), bad_input,
                    "did you mean 'max_samples'?");
}

TEST(Toml, ErrorsNameThePlaceAndTheKey) {
  const auto document = TomlDocument::parse("s.toml", "[sun]\nzenith_deg = 95\nname = 3\nx = nan\n");
  const TomlValue sun = document.root().get("sun");
  BPMS_EXPECT_ERROR(sun.get("zenith_deg").number(0, 89.9), bad_input,
                    "s.toml:2:14: sun.zenith_deg: found 95");
  BPMS_EXPECT_ERROR(sun.get("name").string(), bad_input, "sun.name: found the number 3, expected a text");
  BPMS_EXPECT_ERROR(sun.get("x").number(), bad_input, "finite");
  BPMS_EXPECT_ERROR(sun.require("radiance"), bad_input, "s.toml:1:1: missing key 'radiance' in [sun]");
  BPMS_EXPECT_ERROR(TomlDocument::parse("s.toml", "a = \n"), bad_input, "s.toml:1");
  BPMS_EXPECT_ERROR(TomlDocument::parse("s.toml", "a = " + std::string(5000, '[')), bad_input,
                    "nested deeper");
}

TEST(Toml, WrittenStringsAndNumbersReadBack) {
  const std::string odd = "a\"b\\c\n\x01";
  const auto document =
      TomlDocument::parse("s.toml", "s = " + toml_string(odd) + "\nx = " + toml_number(1.0 / 3) +
                                        "\ny = " + toml_number(5) + "\n");
  EXPECT_EQ(document.root().get("s").string(), odd);
  EXPECT_EQ(document.root().get("x").number(), 1.0 / 3);
  EXPECT_EQ(document.root().get("y").number(), 5);
}

}  // namespace
}  // namespace bpms
