// TOML documents from arbitrary bytes: parsing, a walk over every value by every accessor, and finish().
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "core/toml.h"
#include "tests/fuzz/answer.h"

namespace {

template <class F>
void answer(const F& f) {
  bpms::fuzz::answer("fuzz.toml", f);
}

void walk(const bpms::TomlValue& value, int depth) {
  constexpr int deepest = 64;
  if (depth > deepest) return;
  if (value.where().file != "fuzz.toml") std::abort();
  answer([&] {
    const double number = value.number();
    const std::string text = "x = " + bpms::toml_number(number) + "\n";
    if (bpms::TomlDocument::parse("fuzz.toml", text).root().get("x").number() != number) std::abort();
  });
  answer([&] { (void)value.number(-1, 1); });
  answer([&] { (void)value.positive(); });
  answer([&] { (void)value.integer(-5, 5); });
  answer([&] { (void)value.boolean(); });
  answer([&] { (void)value.numbers(); });
  answer([&] { (void)value.numbers(3); });
  answer([&] { (void)value.one_of({"north_clockwise", "east_counterclockwise"}); });
  answer([&] {
    const std::string text = value.string();
    const std::string written = "x = " + bpms::toml_string(text) + "\n";
    if (bpms::TomlDocument::parse("fuzz.toml", written).root().get("x").string() != text) std::abort();
  });
  if (value.is_table()) {
    answer([&] { (void)value.require("units"); });
    answer([&] { (void)value.number_or("absent", 1.0); });
    for (const std::string& key : value.keys()) {
      if (!value.get(key)) std::abort();
      walk(value.get(key), depth + 1);
    }
  }
  if (value.is_array())
    for (std::size_t i = 0; i < value.size(); ++i) walk(value[i], depth + 1);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  answer([&] {
    const bpms::TomlDocument document = bpms::TomlDocument::parse("fuzz.toml", text);
    answer([&] { document.finish(); });
    walk(document.root(), 0);
    answer([&] { document.finish(); });
  });
  return 0;
}
