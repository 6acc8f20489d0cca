// Ctrl-C: long work asks now and then, keeps what is done or leaves nothing, and throws.
#pragma once
namespace bpms {
void catch_interrupts();      // SIGINT and SIGTERM set the flag; a second one ends the program at once
bool interrupted();           // has one come?
void throw_if_interrupted();  // Error of kind interrupted
}  // namespace bpms
