#include "plant/terrain/terrain_file.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <optional>

#include "core/nearest.h"
#include "core/text.h"

namespace bpms {
namespace {

constexpr double farthest_node_m = 1e7;

struct HeaderValue {
  double number = 0;
  SourceLocation where;
};

class GridHeader {
 public:
  explicit GridHeader(TokenReader& reader) : file_(reader.file()) {
    static const std::vector<std::string> known{"ncols",     "nrows",     "xllcorner", "xllcenter",
                                                "yllcorner", "yllcenter", "cellsize",  "nodata_value"};
    while (const auto token = reader.peek()) {
      if (parse_number(token->text)) break;
      std::string key(token->text);
      std::transform(key.begin(), key.end(), key.begin(), [](unsigned char c) { return std::tolower(c); });
      const SourceLocation where = reader.where(*reader.next());
      if (std::find(known.begin(), known.end(), key) == known.end())
        bad_input(where, "found {}, expected a key of an ESRI ASCII grid or a height{}", in_quotes(key),
                  did_you_mean(key, known));
      if (values_.count(key) != 0) bad_input(where, "{} is given twice", key);
      const double value = reader.number(key);
      values_[key] = {value, where};
    }
  }

  std::optional<HeaderValue> get(const std::string& key) const {
    const auto found = values_.find(key);
    return found == values_.end() ? std::nullopt : std::optional(found->second);
  }
  HeaderValue require(const std::string& key) const {
    const auto value = get(key);
    if (!value) bad_input({file_}, "no {} in the header of the grid", key);
    return *value;
  }
  std::size_t count(const std::string& key) const {
    constexpr double most = 100'000;
    const HeaderValue value = require(key);
    if (!(value.number >= 2 && value.number <= most && value.number == std::floor(value.number)))
      bad_input(value.where, "{} {}, expected a whole number from 2 to 100000", key, value.number);
    return static_cast<std::size_t>(value.number);
  }
  // The centre of the first cell along an axis.
  double low(char axis, double spacing) const {
    const std::string corner = std::string(1, axis) + "llcorner", centre = std::string(1, axis) + "llcenter";
    if (get(corner) && get(centre))
      bad_input(get(centre)->where, "both {} and {}, expected one", corner, centre);
    const double out = get(centre) ? get(centre)->number : require(corner).number + 0.5 * spacing;
    return out;
  }

 private:
  std::string file_;
  std::map<std::string, HeaderValue> values_;
};

}  // namespace

Terrain parse_terrain(const std::string& path, std::string_view text) {
  TokenReader reader(path, text);
  const GridHeader header(reader);
  Terrain out;
  out.columns = header.count("ncols");
  out.rows = header.count("nrows");
  const HeaderValue spacing = header.require("cellsize");
  if (!(spacing.number > 0 && spacing.number <= farthest_node_m))
    bad_input(spacing.where, "cellsize {}, expected a length above 0 and up to 1e7 m", spacing.number);
  out.spacing_m.setConstant(spacing.number);
  out.low_m = {header.low('x', spacing.number), header.low('y', spacing.number)};
  const auto no_data = header.get("nodata_value");
  const std::size_t nodes = out.columns * out.rows;
  // Each value takes two bytes at least: a header that promises more than the file holds is not believed.
  if (nodes > text.size())
    bad_input({path}, "{} rows of {} values are announced, the file holds fewer", out.rows, out.columns);
  out.heights_m.resize(nodes);
  for (std::size_t k = 0; k < nodes; ++k) {
    const std::size_t row = k / out.columns, column = k % out.columns;
    const auto token = reader.peek();
    if (!token)
      bad_input(reader.here(), "the grid ends after {} heights, expected {} rows of {}", k, out.rows,
                out.columns);
    const SourceLocation where = reader.where(*token);
    const double value = reader.number("a height");
    if (no_data && value == no_data->number)
      bad_input(where, "no data (NODATA_value) in row {}, column {}: terrain must be complete", row + 1,
                column + 1);
    if (!(std::abs(value) <= farthest_node_m))
      bad_input(where, "height {}, expected one within 1e7 m", value);
    out.heights_m[(out.rows - 1 - row) * out.columns + column] = static_cast<float>(value);
  }
  if (const auto more = reader.peek())
    bad_input(reader.where(*more), "more heights than {} rows of {}", out.rows, out.columns);
  return out;
}

Terrain read_terrain_file(const std::string& path) {
  return parse_terrain(path, read_text(path));
}

}  // namespace bpms
