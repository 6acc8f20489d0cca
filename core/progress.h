// Progress of long work on stderr: one updated line on a terminal, a plain line now and then elsewhere.
#pragma once
#include <atomic>
#include <chrono>
#include <cstdint>
#include <mutex>
#include <string>

namespace bpms {

void set_quiet(bool quiet);  // --quiet: no progress, no notes
bool quiet();
// A line for the user on stderr ("note: ..."), unless --quiet.
void note(const std::string& message);

class Progress {
 public:
  Progress(std::string what, std::uint64_t total);  // total 0: not known
  ~Progress();                                      // ends the line
  void add(std::uint64_t count = 1);                // from any thread
  void set(std::uint64_t done);
  void status(const std::string& text);  // shown at the line's end, e.g. the worst standard error

 private:
  void show(bool last);
  std::string what_;
  std::string status_;
  std::uint64_t total_;
  std::atomic<std::uint64_t> done_{0};
  std::atomic<std::int64_t> next_ms_{0};
  std::chrono::steady_clock::time_point start_;
  std::mutex mutex_;
  bool terminal_;
  bool shown_ = false;
};

}  // namespace bpms
