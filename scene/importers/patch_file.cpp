#include "scene/importers/patch_file.h"

#include <cmath>
#include <optional>

#include "core/text.h"

namespace bpms {
namespace {

constexpr double farthest_point_m = 1e7;

// How many tokens the first line has: one (a count) makes it Newell's layout.
std::size_t first_line_width(const std::string& path, std::string_view text) {
  TokenReader reader(path, text);
  std::size_t out = 0;
  const auto first = reader.peek();
  for (auto token = first; token && token->line == first->line; token = reader.peek(), ++out) reader.next();
  return out;
}

BezierPatch read_patch(TokenReader& reader, double unit) {
  BezierPatch out;
  const auto start = reader.peek();
  for (Eigen::Vector3d& point : out) {
    for (double& x : point) {
      const auto token = reader.peek();
      if (!token)
        bad_input(reader.here(), "the patch that begins in line {} has fewer than 16 points x y z",
                  start->line);
      x = reader.number("a coordinate") * unit;
      if (!(std::abs(x) <= farthest_point_m)) bad_input(reader.where(*token), "a point beyond 1e7 m");
    }
  }
  return out;
}

}  // namespace

std::vector<BezierPatch> parse_patches(const std::string& path, std::string_view text,
                                       double metres_per_unit) {
  TokenReader reader(path, text);
  std::vector<BezierPatch> out;
  std::optional<long long> count;
  if (first_line_width(path, text) == 1) {
    const auto token = reader.next();
    count = parse_integer(token->text);
    if (!count || *count < 1)
      bad_input(reader.where(*token), "found {}, expected the number of patches", in_quotes(token->text));
  }
  while (const auto next = reader.peek()) {
    if (count) {
      if (static_cast<long long>(out.size()) == *count)
        bad_input(reader.where(*next), "more than the {} patches that the first line announces", *count);
      for (int side = 0; side < 2; ++side) {
        const auto degree = reader.next();
        if (!degree || parse_integer(degree->text) != 3)
          bad_input(degree ? reader.where(*degree) : reader.here(),
                    "expected the degrees `3 3` of patch {} (bicubic ones alone are known)", out.size() + 1);
      }
    }
    out.push_back(read_patch(reader, metres_per_unit));
  }
  if (count && static_cast<long long>(out.size()) < *count)
    bad_input(reader.here(), "{} patches, the first line announces {}", out.size(), *count);
  if (out.empty()) bad_input({path}, "no patches");
  return out;
}

std::vector<BezierPatch> read_patch_file(const std::string& path, double metres_per_unit) {
  return parse_patches(path, read_text(path), metres_per_unit);
}

}  // namespace bpms
