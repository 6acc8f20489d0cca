#include "core/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

namespace bpms {
namespace {
std::atomic<bool> quiet_flag{false};

// What is told on the way must not end the work: a closed or full stderr is no error.
void tell(const std::string& text) {
  std::fputs(text.c_str(), stderr);
  std::fflush(stderr);
}

std::string in_words(double seconds) {
  if (seconds < 90) return fmt::format("{:.0f} s", seconds);
  if (seconds < 5400) return fmt::format("{:.1f} min", seconds / 60);
  return fmt::format("{:.1f} h", seconds / 3600);
}
}  // namespace

void set_quiet(bool on) {
  quiet_flag = on;
}
bool quiet() {
  return quiet_flag;
}

void note(const std::string& message) {
  if (!quiet_flag) tell("note: " + message + "\n");
}

Progress::Progress(std::string what, std::uint64_t total)
    : what_(std::move(what)),
      total_(total),
      start_(std::chrono::steady_clock::now()),
      terminal_(isatty(2) == 1) {
  next_ms_ = terminal_ ? 300 : 5000;
}

Progress::~Progress() {
  show(true);
}

void Progress::set(std::uint64_t done) {
  done_ = done;
  add(0);
}

void Progress::status(const std::string& text) {
  const std::lock_guard lock(mutex_);
  status_ = text;
}

void Progress::add(std::uint64_t count) {
  done_ += count;
  const auto elapsed = std::chrono::steady_clock::now() - start_;
  const auto ms = std::chrono::duration_cast<std::chrono::milliseconds>(elapsed).count();
  std::int64_t due = next_ms_;
  if (ms < due || !next_ms_.compare_exchange_strong(due, ms + (terminal_ ? 200 : 10000))) return;
  show(false);
}

void Progress::show(bool last) {
  if (quiet_flag || (last && !shown_)) return;
  const std::lock_guard lock(mutex_);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  const std::uint64_t done = done_;
  const double rate = static_cast<double>(done) / (seconds > 0 ? seconds : 1);
  std::string line = fmt::format("{}: {}", what_, done);
  if (total_ > 0)
    line += fmt::format("/{} ({:.0f} %)", total_,
                        100.0 * static_cast<double>(done) / static_cast<double>(total_));
  line += fmt::format(", {:.3g}/s", rate);
  if (!last && total_ > done && rate > 0)
    line += fmt::format(", {} left", in_words(static_cast<double>(total_ - done) / rate));
  if (!status_.empty()) line += ", " + status_;
  if (terminal_) {
    tell("\r\x1b[K" + line + (last ? "\n" : ""));
  } else {
    tell(line + "\n");
  }
  shown_ = true;
}

}  // namespace bpms
