// What the writers of stands share.
#pragma once
#include <map>

#include "core/atomic_file.h"
#include "plant/export/formats.h"
#include "plant/stand_file.h"

namespace bpms {

// Bytes on their way to a file, a few megabytes at a time.
class FileStream {
 public:
  FileStream(const std::string& path, bool overwrite) : file_(path, overwrite) {
    buffer_.reserve(piece + room);
  }
  std::string& buffer() {
    if (buffer_.size() >= piece) flush();
    return buffer_;
  }
  template <class T>
  void append(const T* values, std::size_t count) {
    buffer().append(reinterpret_cast<const char*>(values), sizeof(T) * count);
  }
  void commit() {
    flush();
    file_.commit();
  }

 private:
  void flush() {
    file_.write(buffer_);
    buffer_.clear();
  }
  static constexpr std::size_t piece = std::size_t{4} << 20, room = std::size_t{1} << 16;
  AtomicFile file_;
  std::string buffer_;
};

// Materials of all meshes together: names, and of each mesh the index of each organ's.
struct StandMaterials {
  explicit StandMaterials(const Stand& stand);
  std::vector<std::string> names;
  std::vector<std::vector<std::uint32_t>> of_organ;
};

void write_stand_ply(const std::string& path, const Stand& stand, const StandFileOptions& options);
void write_stand_obj(const std::string& path, const Stand& stand, const StandFileOptions& options);
void write_stand_glb(const std::string& path, const Stand& stand, const StandFileOptions& options);

std::string mtl_text(const std::vector<std::string>& materials);
std::string in_one_line(std::string text);  // a comment ends with its line

}  // namespace bpms
