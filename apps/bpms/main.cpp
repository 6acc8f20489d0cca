// The command line: a table of verbs, one error line, the exit code.
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <new>

#include "apps/bpms/verb.h"
#include "apps/bpms/verbs.h"
#include "core/error.h"
#include "core/interrupt.h"
#include "core/nearest.h"

namespace {

using bpms::Cli;

constexpr void (*verbs[])(Cli&) = {
    bpms::add_check,    bpms::add_target,   bpms::add_calibrate, bpms::add_reconstruct,
    bpms::add_fit,      bpms::add_build,    bpms::add_describe,  bpms::add_view,
    bpms::add_simulate, bpms::add_recolour, bpms::add_report,
};

int parse_and_run(Cli& cli, int argc, char** argv) {
  std::vector<std::string> names;
  for (const CLI::App* verb : cli.app.get_subcommands([](const CLI::App*) { return true; }))
    names.push_back(verb->get_name());
  if (argc > 1 && argv[1][0] != '-' && std::find(names.begin(), names.end(), argv[1]) == names.end())
    bpms::bad_input({}, "unknown verb {}{}", bpms::in_quotes(argv[1]), bpms::did_you_mean(argv[1], names));
  try {
    cli.app.parse(argc, argv);
  } catch (const CLI::CallForHelp& help) {
    return cli.app.exit(help);
  } catch (const CLI::CallForVersion& v) {
    return cli.app.exit(v);
  } catch (const CLI::ParseError& error) {
    bpms::bad_input({}, "{} (see bpms {}--help)", error.what(),
                    argc > 1 && argv[1][0] != '-' ? std::string(argv[1]) + " " : "");
  }
  // What was printed may still lie in a buffer; a full disk behind stdout must not pass for success.
  if (std::fflush(stdout) != 0)
    bpms::fail(bpms::ErrorKind::missing_resource, {}, "standard output cannot be written: {}",
               std::strerror(errno));
  return 0;
}

// On a closed or full stderr the exit code still says it.
int report_error(bpms::ErrorKind kind, const std::string& message) {
  std::fputs(("error: " + message + "\n").c_str(), stderr);
  return bpms::exit_code(kind);
}

}  // namespace

int main(int argc, char** argv) {
  bpms::catch_interrupts();
  std::signal(SIGXFSZ, SIG_IGN);  // a limit on the size of files is an error of the write, not the end
  Cli cli;
  cli.app.description("bpms: from measurements on plants to the radiance that a sensor would see");
  cli.app.name("bpms");
  cli.app.require_subcommand(1);
  cli.app.set_version_flag("--version", bpms::version());
  for (int i = 0; i < argc; ++i) cli.command += (i ? " " : "") + std::string(i ? argv[i] : "bpms");
  try {
    for (const auto add : verbs) add(cli);
    return parse_and_run(cli, argc, argv);
  } catch (const bpms::Error& error) {
    return report_error(error.kind(), error.what());
  } catch (const std::bad_alloc&) {
    return report_error(bpms::ErrorKind::missing_resource, "out of memory");
  } catch (const std::exception& error) {
    return report_error(bpms::ErrorKind::internal, std::string("internal: ") + error.what());
  }
}
