// A verb is one file: it declares its options on a CLI11 subcommand and calls its stage.
// To add one: write verb_NAME.cpp with `void add_NAME(Cli&)`, declare it in verbs.h and put it in the table
// of main.cpp.
#pragma once
#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>

#include "core/json.h"
#include "core/provenance.h"

namespace bpms {

// What every verb has: -o --seed --threads --quiet --json --overwrite --report.
struct CommonOptions {
  std::string output;
  std::string report;  // FILE.json or FILE.html
  std::uint64_t seed = 1;
  int threads = 0;
  bool quiet = false;
  bool json = false;
  bool overwrite = false;
};

struct Cli {
  CLI::App app;
  CommonOptions common;
  std::string command;  // as typed
};

// Where -o of a verb may go: files are checked before the verb runs, folders are the verb's own business.
enum class OutputKind { file, file_or_folder };
bool names_folder(const std::string& output);  // "plants/", or a folder that is there

// A subcommand with the common options; `example` is printed at the end of its help. `run` is called after
// parsing.
CLI::App* add_verb(Cli& cli, const std::string& name, const std::string& summary, const std::string& example,
                   std::function<void()> run, OutputKind output = OutputKind::file);

Provenance provenance(const Cli& cli, bool with_seed = false);

// Puts "report": verb and the provenance into the report, prints it on stdout when --json was given and
// writes it to
// --report (JSON, or a self-contained page when the name ends in .html).
void deliver_report(const Cli& cli, const std::string& verb, Json report, const Provenance& provenance);

// The page that holds these reports, self-contained (template built from workbench/).
std::string html_page(const Json& document);
// The page that shows a scene to turn and look into (scene/pictures/viewer_document.h).
std::string viewer_page(const Json& document);

// Before the work: each of these outputs can be written, and no two of them and --report are one file.
void require_outputs(const Cli& cli, const std::vector<std::string>& outputs);

// Missing -o is bad input, and so is -o -: these outputs are files.
const std::string& require_output(const Cli& cli);

// "640x480", of --image-size.
std::pair<int, int> parse_image_size(const std::string& text);

}  // namespace bpms
