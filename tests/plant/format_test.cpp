// The layout of plant texts.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <filesystem>

#include "core/text.h"
#include "plant/plant.h"
#include "plant/plant_format.h"
#include "tests/data.h"
#include "tests/plant/random_plant.h"

namespace bpms {
namespace {

using enum ErrorKind;

std::string formatted(const std::string& text) {
  return formatted_plant("x.bpms", text);
}

TEST(Format, LaysOutEveryConstruct) {
  const std::string text =
      "# a frond\n"
      "units   cm   # as measured\n\n\n"
      "include  \"organs.bpms\"\n"
      "let lean=30 let  size = ( 2*lean+sqrt( 4 ) )\n"
      "organ frond(len,pairs=3){ # body\n<s [+l]>( pairs ) l(  2 )\n"
      "l 2{a_length (len/-2) a_width 1}\n\n\n s {\n material stem a_length (max(len,1)^2)  # two on a line\n"
      "\n# alone\n}\n}\n"
      "\n[s[+l]\n   [+l]  # second\nc ]\n"
      "c{organ frond len 12.0 p_note \"a  b\"}\n"
      "l {\n  a_length 25.0 a_width 1.2 f_inclination n 0 (lean) 0.5 -3 1 +4 f_width p 1\n}\n"
      "# the end   \n";
  EXPECT_EQ(formatted(text),
            "# a frond\n"
            "units cm  # as measured\n\n"
            "include \"organs.bpms\"\n"
            "let lean = 30\n"
            "let size = (2 * lean + sqrt(4))\n"
            "organ frond(len, pairs = 3) {  # body\n"
            "  <s [+l]>(pairs) l(2)\n"
            "  l 2 { a_length (len / -2)  a_width 1 }\n\n"
            "  s {\n"
            "    material stem\n"
            "    a_length (max(len, 1)^2)  # two on a line\n\n"
            "    # alone\n"
            "  }\n"
            "}\n\n"
            "[s[+l]\n"
            "  [+l]  # second\n"
            "  c ]\n"
            "c { organ frond  len 12.0  p_note \"a  b\" }\n"
            "l {\n"
            "  a_length 25.0\n"
            "  a_width 1.2\n"
            "  f_inclination n 0 (lean) 0.5 -3 1 +4\n"
            "  f_width p 1\n"
            "}\n"
            "# the end\n");
}

TEST(Format, KeepsABlockInItsLineWhileItFits) {
  const std::string line =
      "l { f_inclination n 0 1 0.1 2 0.2 3 0.3 4 0.4 5 0.5 6 0.6 7 0.7 8 0.8 9 0.9 10 1 11 }\n";
  EXPECT_EQ(formatted("l\n" + line), "l\n" + line);
  const std::string longer =
      line.substr(0, line.size() - 2) + " a_length 10  a_width 1.25 p_origin field }\n";
  EXPECT_EQ(formatted("l\n" + longer),
            "l\nl {\n  f_inclination n 0 1 0.1 2 0.2 3 0.3 4 0.4 5 0.5 6 0.6 7 0.7 8 0.8 9 0.9 10 1 11\n"
            "  a_length 10\n  a_width 1.25\n  p_origin field\n}\n");
}

TEST(Format, ALibraryToo) {
  EXPECT_EQ(formatted("l 1 {a_length 3\na_width 1}let a=1 s{a_length (a)}"),
            "l 1 {\n  a_length 3\n  a_width 1\n}\nlet a = 1\ns { a_length (a) }\n");
}

TEST(Format, WhatIsNotClosedIsRefused) {
  BPMS_EXPECT_ERROR(formatted("s s { a_length 1"), bad_input,
                    "x.bpms:1:3: syntax error: block opened here is never closed");
  BPMS_EXPECT_ERROR(formatted("organ o { s"), bad_input, "the file ends where '}' was expected");
  BPMS_EXPECT_ERROR(formatted("s } "), bad_input, "'}' without a block");
  BPMS_EXPECT_ERROR(formatted("s s { p_x \"a }"), bad_input, "string opened here");
}

// A text with comments, blanks and line breaks strewn between its tokens.
std::string strewn(const std::string& text) {
  std::string out;
  bool in_string = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    out += text[i];
    if (in_string && text[i] == '\\') {
      out += text[++i];
      continue;
    }
    if (text[i] == '"') in_string = !in_string;
    const bool gap = text[i] == ' ' || text[i] == '\n' || text[i] == '}' || text[i] == '(' || text[i] == ']';
    if (in_string || !gap || *rc::gen::inRange(0, 12) != 0) continue;
    out +=
        *rc::gen::element<std::string>("\n", " # c\n", "\n\n\n", "\n# a line  \n", "  \t ", "\r\n", "#\n#\n");
  }
  return out;
}

RC_GTEST_PROP(Format, KeepsThePlantAndChangesNothingTwice, ()) {
  const std::string text = strewn(random_plant_text());
  const std::string written = plant_text(parse_plant("x.bpms", text));
  const std::string once = formatted(text);
  RC_LOG() << text << "\n---\n" << once << "\n---\n" << formatted(once);
  RC_ASSERT(plant_text(parse_plant("x.bpms", once)) == written);
  RC_ASSERT(formatted(once) == once);
  RC_ASSERT(std::count(once.begin(), once.end(), '#') == std::count(text.begin(), text.end(), '#'));
  RC_ASSERT(once.find(" \n") == std::string::npos);
}

TEST(Format, TheExamplesKeepTheirPlants) {
  for (const auto& file :
       std::filesystem::directory_iterator(std::string(BPMS_SOURCE_DIR) + "/examples/plants")) {
    if (file.path().extension() != ".bpms") continue;
    const std::string text = read_text(file.path());
    const std::string once = formatted_plant(file.path(), text);
    EXPECT_EQ(formatted_plant(file.path(), once), once) << file.path();
    const auto written = [&](const std::string& content) -> std::string {
      try {
        return plant_text(parse_plant(file.path(), content));
      } catch (const Error& error) {
        return error.message();  // a library has no word
      }
    };
    EXPECT_EQ(written(once), written(text)) << file.path();
  }
}

}  // namespace
}  // namespace bpms
