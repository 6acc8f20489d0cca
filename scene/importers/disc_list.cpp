#include "scene/importers/disc_list.h"

#include <array>
#include <cmath>
#include <iterator>

#include "core/text.h"

namespace bpms {

std::vector<Disc> read_disc_list(const std::string& path) {
  return parse_disc_list(path, read_text(path));
}

std::vector<Disc> parse_disc_list(const std::string& path, std::string_view text) {
  static constexpr std::array<const char*, 7> names{"radius", "x", "y", "z", "nx", "ny", "nz"};
  constexpr double largest = 1e7;  // metres; float coordinates beyond it mean nothing to a leaf
  TokenReader reader(path, text);
  std::vector<Disc> out;
  while (const auto first = reader.peek()) {
    std::array<double, 7> row;
    for (std::size_t k = 0; k < row.size(); ++k) {
      const auto token = reader.next();
      if (!token || token->line != first->line)
        bad_input({path, first->line}, "{} columns, expected 7 (radius x y z nx ny nz)", k);
      const auto value = parse_number(token->text);
      if (!value || std::abs(*value) > largest)
        bad_input(reader.where(*token), "found {}, expected {} (a number below 1e7)", in_quotes(token->text),
                  names[k]);
      row[k] = *value;
      constexpr double smallest = 1e-9;  // metres; what is not far from zero in floats
      if (k == 0 && row[0] < smallest)
        bad_input(reader.where(*token), "radius {}, expected one above 0", row[0]);
    }
    if (const auto more = reader.peek(); more && more->line == first->line)
      bad_input(reader.where(*more), "more than 7 columns, expected radius x y z nx ny nz");
    const Eigen::Vector3d normal(row[4], row[5], row[6]);
    if (!(normal.norm() > 0))
      bad_input(reader.where(*first), "the normal is (0, 0, 0), expected a direction");
    // A direction that is a unit vector to the precision of floats stays as it is written.
    constexpr double float_steps = 4e-7;
    const bool unit = std::abs(normal.squaredNorm() - 1) < float_steps;
    out.push_back({Eigen::Vector3d(row[1], row[2], row[3]).cast<float>(), static_cast<float>(row[0]),
                   (unit ? normal : normal.normalized()).cast<float>()});
  }
  if (out.empty()) bad_input({path}, "no rows, expected discs (radius x y z nx ny nz)");
  return out;
}

std::string disc_list_text(const std::vector<Disc>& discs) {
  std::string out = "# radius x y z nx ny nz, metres\n";
  for (const Disc& disc : discs)
    fmt::format_to(std::back_inserter(out), "{} {} {} {} {} {} {}\n", disc.radius_m, disc.centre_m.x(),
                   disc.centre_m.y(), disc.centre_m.z(), disc.normal.x(), disc.normal.y(), disc.normal.z());
  return out;
}

}  // namespace bpms
