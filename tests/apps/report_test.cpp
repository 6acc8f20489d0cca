// Reports that `bpms report` refuses, and command lines that no verb takes.
#include "tests/apps/refused.h"

namespace bpms::test {
namespace {

Refusal json(const std::string& name, const std::string& content, const std::string& begin,
             const std::vector<std::string>& holds) {
  return {name, written("fit.json", content), report, 2, "fit.json:" + begin, holds};
}
Refusal line(const std::string& name, const std::string& arguments, const std::string& begin,
             const std::vector<std::string>& holds) {
  return {name, as_it_is(), arguments, 2, begin, holds};
}

INSTANTIATE_TEST_SUITE_P(Report, Refused,
                         ::testing::ValuesIn(std::vector<Refusal>{
                             json("Truncated", "{\"report\": \"fit\",\n \"organs\": [1, ", "2:", {"JSON"}),
                             json("TruncatedInAWord", "{\"report\": \"fit\",\n \"orga", "2:", {"JSON"}),
                             json("NotANumber", "{\"report\": \"fit\",\n \"x\": NaN}", "2:7: ", {"JSON"}),
                             json("HugeNumber", "{\"report\": \"fit\",\n \"x\": 1e999}", " ", {"range"}),
                             json("NotUtf8", "{\"report\": \"f\xff\"}", "1:", {"JSON"}),
                             json("TextBehind", "{\"report\": \"fit\"}\n}", "2:1: ", {"JSON"}),
                             json("NoReport", "{\"organs\": []}", " ", {"\"report\""}),
                             json("ReportOfAnotherType", "{\"report\": 3}", " ", {"\"report\""}),
                             json("AnArray", "[1, 2]", " ", {"\"report\""}),
                             json("Nested",
                                  "{\"report\": \"fit\", \"x\": " + std::string(200000, '[') +
                                      std::string(200000, ']') + "}",
                                  " ", {"nested deeper than 100"})}),
                         name_of_case);

INSTANTIATE_TEST_SUITE_P(
    CommandLine, Refused,
    ::testing::ValuesIn(std::vector<Refusal>{
        line("UnknownVerb", "simulte scene.toml", "", {"'simulte'", "did you mean 'simulate'?"}),
        line("UnknownOption", simulate + " --sample 3", "", {"--sample"}), line("NoVerb", "", "", {}),
        line("NoInput", "simulate -o new.nc", "", {"scene"}),
        line("NoOutput", "simulate scene.toml", "", {"-o FILE"}),
        line("EmptyOutput", "simulate scene.toml -o ''", "", {"-o"}),
        line("SeedOfWords", simulate + " --seed one", "", {"--seed"}),
        line("NegativeThreads", simulate + " --threads -1", "", {"--threads"}),
        line("RaysOutOfRange", "describe scene.toml --rays 3", "", {"--rays"}),
        line("NotAnyKind", "check leaf.obj", "leaf.obj: ", {"not recognised"}),
        line("OneBadOfTwo", "check grass.bpms leaf.obj", "leaf.obj: ", {"not recognised"})}),
    name_of_case);

}  // namespace
}  // namespace bpms::test
