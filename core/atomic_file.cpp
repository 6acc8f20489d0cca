#include "core/atomic_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "core/error.h"

namespace fs = std::filesystem;

namespace bpms {

namespace {
std::string temporary_name(const std::string& path) {
  return fmt::format("{}.{}.part", path, ::getpid());
}

// A place where the file may stand: not a folder, not there already, in a folder that is there.
void require_free(const std::string& path, bool overwrite) {
  std::error_code code;
  if (path.empty()) throw Error(ErrorKind::bad_input, "an output file name is empty");
  if (fs::is_directory(path, code))
    fail(ErrorKind::missing_resource, {path}, "is a folder, a file name was expected");
  if (fs::exists(path, code) && !overwrite)
    fail(ErrorKind::bad_input, {path}, "exists already; give --overwrite to replace it");
  const fs::path folder = fs::path(path).has_parent_path() ? fs::path(path).parent_path() : fs::path(".");
  if (!fs::is_directory(folder, code)) fail(ErrorKind::missing_resource, {path}, "its folder does not exist");
}

}  // namespace

void require_writable(const std::string& path, bool overwrite) {
  require_free(path, overwrite);
  // Tried, not asked: root may write everywhere by its rights, but not to /proc or a read-only disk.
  const std::string trial = temporary_name(path);
  const int file = ::open(trial.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0644);
  if (file < 0)
    fail(ErrorKind::missing_resource, {path}, "its folder is not writable: {}", std::strerror(errno));
  ::close(file);
  ::unlink(trial.c_str());
}

AtomicFile::AtomicFile(std::string path, bool overwrite) : path_(std::move(path)), overwrite_(overwrite) {
  require_writable(path_, overwrite_);
  temporary_ = temporary_name(path_);
  const int file = ::open(temporary_.c_str(), O_CREAT | O_TRUNC | O_WRONLY | O_CLOEXEC, 0644);
  if (file < 0) fail(ErrorKind::missing_resource, {path_}, "cannot be written: {}", std::strerror(errno));
  ::close(file);
}

AtomicFile::~AtomicFile() {
  if (!committed_) ::unlink(temporary_.c_str());
}

void AtomicFile::write(std::string_view bytes) {
  const int file = ::open(temporary_.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC);
  if (file < 0) fail(ErrorKind::missing_resource, {path_}, "cannot be written: {}", std::strerror(errno));
  while (!bytes.empty()) {
    const ssize_t done = ::write(file, bytes.data(), bytes.size());
    if (done < 0) {
      const int why = errno;
      ::close(file);
      fail(ErrorKind::missing_resource, {path_}, "cannot be written: {}", std::strerror(why));
    }
    bytes.remove_prefix(static_cast<std::size_t>(done));
  }
  ::close(file);
}

void AtomicFile::commit() {
  const int file = ::open(temporary_.c_str(), O_RDONLY | O_CLOEXEC);
  const bool synced = file >= 0 && ::fsync(file) == 0;
  const int why = errno;
  if (file >= 0) ::close(file);
  if (!synced) fail(ErrorKind::missing_resource, {path_}, "cannot be written: {}", std::strerror(why));
  require_free(path_, overwrite_);  // somebody else may have written it in the meantime
  if (::rename(temporary_.c_str(), path_.c_str()) != 0)
    fail(ErrorKind::missing_resource, {path_}, "cannot be put in its place: {}", std::strerror(errno));
  committed_ = true;
}

void write_file(const std::string& path, std::string_view bytes, bool overwrite) {
  AtomicFile file(path, overwrite);
  file.write(bytes);
  file.commit();
}

}  // namespace bpms
