// The verbs of the program, in pipeline order; main.cpp holds the same table.
#pragma once

namespace bpms {
struct Cli;
void add_check(Cli& cli);
void add_target(Cli& cli);
void add_calibrate(Cli& cli);
void add_reconstruct(Cli& cli);
void add_fit(Cli& cli);
void add_build(Cli& cli);
void add_describe(Cli& cli);
void add_view(Cli& cli);
void add_simulate(Cli& cli);
void add_recolour(Cli& cli);
void add_report(Cli& cli);
}  // namespace bpms
