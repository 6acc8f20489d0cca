// Output that is there whole or not at all: written beside its place under a temporary name, then renamed.
#pragma once
#include <string>
#include <string_view>

namespace bpms {

// Throws when PATH exists and may not be overwritten, or when its folder is missing or not writable.
// Verbs call it before long work, so that a run is not lost at its end.
void require_writable(const std::string& path, bool overwrite);

class AtomicFile {
 public:
  AtomicFile(std::string path, bool overwrite);
  ~AtomicFile();  // removes what was not committed
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;
  const std::string& temporary() const { return temporary_; }  // for libraries that open files themselves
  void write(std::string_view bytes);                          // buffered nowhere: appended at once
  void commit();  // flushed to disk, then renamed over the target

 private:
  std::string path_;
  std::string temporary_;
  bool overwrite_;
  bool committed_ = false;
};

// The whole content in one call.
void write_file(const std::string& path, std::string_view bytes, bool overwrite);

}  // namespace bpms
