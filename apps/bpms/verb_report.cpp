#include <algorithm>
#include <memory>
#include <vector>

#include "apps/bpms/verb.h"
#include "apps/bpms/verbs.h"
#include "core/atomic_file.h"
#include "core/error.h"
#include "core/text.h"

namespace bpms {
namespace {

struct ReportArguments {
  std::vector<std::string> files;
  std::string title = "bpms report";
  std::vector<std::string> notes;
};

// Of the byte at which reading stopped; the parser counts bytes from 1.
SourceLocation place_of(const std::string& path, const std::string& text, std::size_t byte) {
  const std::string_view before = std::string_view(text).substr(0, byte > 0 ? byte - 1 : 0);
  const std::size_t line_begin = before.rfind('\n') + 1;  // npos + 1 is 0: the first line
  return {path, 1 + static_cast<int>(std::count(before.begin(), before.end(), '\n')),
          1 + static_cast<int>(before.size() - line_begin)};
}

Json read_report(const std::string& path) {
  const std::string text = read_text(path);
  constexpr int deepest = 100;  // what writes the page recurses over brackets
  const auto within_depth = [&](int depth, Json::parse_event_t, const Json&) {
    if (depth > deepest) bad_input({path}, "brackets nested deeper than {}, no report is", deepest);
    return true;
  };
  try {
    Json report = Json::parse(text, within_depth);
    if (!report.is_object() || !report.contains("report") || !report["report"].is_string())
      bad_input({path}, "not a report: an object with the key \"report\" and a verb's name was expected");
    return report;
  } catch (const Json::parse_error& error) {
    bad_input(place_of(path, text, error.byte), "not valid JSON");
  } catch (const Json::out_of_range&) {
    bad_input({path}, "a number beyond the range of doubles");
  }
}

void run(const Cli& cli, const ReportArguments& options) {
  Json reports = Json::array();
  for (const std::string& path : options.files) reports.push_back(read_report(path));
  const Json page{{"title", options.title},
                  {"version", version()},
                  {"command", cli.command},
                  {"notes", options.notes},
                  {"reports", reports}};
  write_file(require_output(cli), html_page(page), cli.common.overwrite);
}

}  // namespace

void add_report(Cli& cli) {
  auto options = std::make_shared<ReportArguments>();
  CLI::App* verb = add_verb(cli, "report", "one self-contained page from the reports of several runs",
                            "bpms report calibrate.json reconstruct.json simulate.json -o report.html",
                            [&cli, options] { run(cli, *options); });
  // It reports on others, and has no report of its own.
  for (const char* name : {"--report", "--json"}) verb->remove_option(verb->get_option(name));
  verb->add_option("files", options->files, "reports (JSON) in the order they shall stand")->required();
  verb->add_option("--title", options->title, "title of the page");
  verb->add_option("--note", options->notes, "a sentence at the head of the page (may be given again)");
}

}  // namespace bpms
