// The verbs of the program, in pipeline order; main.cpp holds the same table.
#pragma once

namespace bpms {
struct Cli;
void add_check(Cli& cli);
void add_calibrate(Cli& cli);
}  // namespace bpms
