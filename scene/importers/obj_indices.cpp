#include "scene/importers/obj_indices.h"

#include <algorithm>
#include <array>
#include <charconv>

#include "core/error.h"

namespace bpms {
namespace {

bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r';
}

// Lines of two characters or more, without comments.
template <class Use>
void each_line(std::string_view text, const Use& use) {
  int number = 1;
  for (std::size_t begin = 0; begin < text.size(); ++number) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    std::string_view line = text.substr(begin, end - begin);
    begin = end + 1;
    line = line.substr(0, line.find('#'));
    if (line.size() > 1) use(line, number);
  }
}

void count_line(std::string_view line, std::array<long long, 3>& count) {
  if (line[0] != 'v') return;
  if (is_blank(line[1])) ++count[0];
  if (line[1] == 't') ++count[1];
  if (line[1] == 'n') ++count[2];
}

// "7/2/-1" of a face: vertex, texture coordinate, normal.
class FaceCorners {
 public:
  explicit FaceCorners(const std::string& path) : path_(path) {}

  std::array<long long, 3> all{}, before{};  // of the file; above the face

  void check(std::string_view line, int number) const {
    std::size_t at = 1;  // behind the f
    while (at < line.size()) {
      if (is_blank(line[at])) {
        ++at;
        continue;
      }
      std::size_t end = at;
      while (end < line.size() && !is_blank(line[end])) ++end;
      check_corner(line.substr(at, end - at), {path_, number, static_cast<int>(at) + 1});
      at = end;
    }
  }

 private:
  void check_corner(std::string_view corner, const SourceLocation& where) const {
    std::size_t part = 0;
    for (std::size_t at = 0; part < all.size(); ++part) {
      const std::size_t slash = corner.find('/', at);
      const std::string_view text = corner.substr(at, slash == std::string_view::npos ? slash : slash - at);
      if (!text.empty()) check_index(text, part, where);
      if (slash == std::string_view::npos) return;
      at = slash + 1;
    }
    bad_input(where, "found {}, expected vertex/texture/normal", in_quotes(corner));
  }

  void check_index(std::string_view text, std::size_t part, const SourceLocation& where) const {
    constexpr const char* names[] = {"vertices", "texture coordinates", "normals"};
    long long index = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), index);
    if (error != std::errc() || end != text.data() + text.size())
      bad_input(where, "found {} in a face, expected a whole number", in_quotes(text));
    if (index == 0 || index > all[part] || index < -before[part])
      bad_input(where, "a face names number {} of the {}, expected 1 to {} or -1 to -{}", index, names[part],
                all[part], before[part]);
  }

  const std::string& path_;
};

}  // namespace

void check_obj_indices(const std::string& path, std::string_view text) {
  FaceCorners faces(path);
  each_line(text, [&](std::string_view line, int) { count_line(line, faces.all); });
  each_line(text, [&](std::string_view line, int number) {
    count_line(line, faces.before);
    if (line[0] == 'f' && is_blank(line[1])) faces.check(line, number);
  });
}

}  // namespace bpms
