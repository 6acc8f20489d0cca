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

Json read_report(const std::string& path) {
  const std::string text = read_text(path);
  try {
    Json report = Json::parse(text);
    if (!report.is_object() || !report.contains("report"))
      bad_input({path}, "not a report: an object with the key \"report\" was expected");
    return report;
  } catch (const Json::parse_error& error) {
    const auto until = text.begin() + static_cast<std::ptrdiff_t>(std::min(error.byte, text.size()));
    bad_input({path, 1 + static_cast<int>(std::count(text.begin(), until, '\n'))}, "not valid JSON");
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
  verb->add_option("files", options->files, "reports (JSON) in the order they shall stand")->required();
  verb->add_option("--title", options->title, "title of the page");
  verb->add_option("--note", options->notes, "a sentence at the head of the page (may be given again)");
}

}  // namespace bpms
