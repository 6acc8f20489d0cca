#include "fit/polyline_table.h"

#include <algorithm>
#include <utility>

#include "core/nearest.h"

namespace bpms {
namespace {

const std::vector<std::string>& roles() {
  static const std::vector<std::string> known{"leaf", "x",     "y",       "z",     "plant", "axis",
                                              "rank", "organ", "feature", "point", "sigma"};
  return known;
}

std::vector<std::string> split(std::string_view text, char separator) {
  std::vector<std::string> out;
  for (;;) {
    const std::size_t at = text.find(separator);
    out.emplace_back(text.substr(0, at));
    if (at == std::string_view::npos) return out;
    text.remove_prefix(at + 1);
  }
}

// The columns of the table by role; -1 where the role is not mapped.
class Columns {
 public:
  Columns(const CsvTable& table, const PolylineColumns& mapping) : table_(table) {
    for (const auto& [role, names] : mapping) {
      for (const std::string& name : names) index_[role].push_back(table.require(name));
    }
  }
  bool has(std::string_view role) const { return index_.contains(role); }
  int column(std::string_view role) const { return index_.find(role)->second.front(); }
  std::string text(std::string_view role, std::size_t row, std::string otherwise) const {
    return has(role) ? std::string(table_.text(row, column(role))) : std::move(otherwise);
  }
  double number(std::string_view role, std::size_t row) const { return table_.number(row, column(role)); }
  int integer(std::string_view role, std::size_t row) const {
    const long long value = table_.integer(row, column(role));
    constexpr long long largest = 1'000'000'000;
    if (value < -largest || value > largest)
      bad_input(table_.where(row, column(role)), "{} {} is out of range", role, value);
    return static_cast<int>(value);
  }
  std::string key(std::size_t row) const {
    std::string out;
    for (const int c : index_.find("leaf")->second) {
      if (!out.empty()) out += ' ';
      out += table_.text(row, c);
    }
    return out;
  }

 private:
  const CsvTable& table_;
  std::map<std::string, std::vector<int>, std::less<>> index_;
};

std::vector<VectorPoint>& points_of(MeasuredOrgan& organ, const std::string& feature,
                                    const SourceLocation& where) {
  if (feature == "midrib" || feature == "axis") return organ.midrib;
  if (feature == "edge_left") return organ.edge_left;
  if (feature == "edge_right") return organ.edge_right;
  bad_input(where, "found feature {}, expected midrib, edge_left, edge_right or axis", in_quotes(feature));
}

}  // namespace

PolylineColumns parse_polyline_columns(std::string_view text) {
  PolylineColumns out;
  for (const std::string& part : split(text, ',')) {
    const std::size_t equal = part.find('=');
    if (equal == std::string::npos || equal == 0 || equal + 1 == part.size())
      bad_input({}, "found {} in --columns, expected ROLE=COLUMN as in \"leaf=variety+number,x=x,z=y\"",
                in_quotes(part));
    const std::string role = part.substr(0, equal);
    if (std::find(roles().begin(), roles().end(), role) == roles().end())
      bad_input({}, "unknown role {} in --columns{}", in_quotes(role), did_you_mean(role, roles()));
    if (out.contains(role)) bad_input({}, "role {} stands twice in --columns", in_quotes(role));
    std::vector<std::string> names =
        role == "leaf" ? split(part.substr(equal + 1), '+') : std::vector{part.substr(equal + 1)};
    for (const std::string& name : names)
      if (name.empty())
        bad_input({}, "found {} in --columns, expected a column name on each side of '+'", in_quotes(part));
    out[role] = std::move(names);
  }
  for (const char* needed : {"leaf", "x", "z"})
    if (!out.contains(needed))
      bad_input({}, "--columns does not say which column is '{}': add {}=COLUMN", needed, needed);
  return out;
}

std::vector<MeasuredOrgan> read_polylines(const std::string& path, const PolylineColumns& mapping,
                                          double metres_per_unit, CsvDialect dialect) {
  const CsvTable table = CsvTable::read(path, dialect);
  const Columns columns(table, mapping);
  const bool planar = !columns.has("y");
  std::vector<MeasuredOrgan> out;
  std::map<std::pair<std::string, std::string>, std::size_t> known;
  std::map<std::string, int> leaves_of_plant;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const std::string plant = columns.text("plant", row, "1");
    const std::string key = columns.key(row);
    const auto [at, added] = known.try_emplace({plant, key}, out.size());
    if (added) {
      MeasuredOrgan organ;
      organ.plant = plant;
      organ.axis = columns.text("axis", row, "");
      organ.organ = columns.text("organ", row, "leaf");
      if (organ.organ != "leaf" && organ.organ != "stem" && organ.organ != "head")
        bad_input(table.where(row, columns.column("organ")), "found organ {}, expected leaf, stem or head",
                  in_quotes(organ.organ));
      const int ordinal = ++leaves_of_plant[plant];
      organ.rank = columns.has("rank") ? columns.integer("rank", row) : ordinal;
      organ.key = (columns.has("plant") ? plant + " " : "") + key;
      organ.planar = planar;
      out.push_back(std::move(organ));
    }
    MeasuredOrgan& organ = out[at->second];
    const std::string feature = columns.text("feature", row, "midrib");
    const SourceLocation where = table.where(row, columns.column("x"));
    std::vector<VectorPoint>& points = points_of(
        organ, feature, columns.has("feature") ? table.where(row, columns.column("feature")) : where);
    VectorPoint point;
    point.label = {plant, organ.axis, organ.rank, organ.organ, feature};
    point.where = where;
    point.point = columns.has("point") ? columns.integer("point", row) : static_cast<int>(points.size()) + 1;
    point.x_m =
        metres_per_unit * Eigen::Vector3d(columns.number("x", row), planar ? 0.0 : columns.number("y", row),
                                          columns.number("z", row));
    if (columns.has("sigma")) {
      const double sigma = metres_per_unit * columns.number("sigma", row);
      if (sigma <= 0)
        bad_input(table.where(row, columns.column("sigma")), "found a sigma of {}, expected one above 0",
                  sigma);
      point.covariance_m2 = sigma * sigma * Eigen::Matrix3d::Identity();
    }
    points.push_back(std::move(point));
  }
  if (out.empty()) bad_input({path}, "no points after the header");
  for (MeasuredOrgan& organ : out) {
    for (auto* list : {&organ.midrib, &organ.edge_left, &organ.edge_right})
      std::stable_sort(list->begin(), list->end(),
                       [](const auto& a, const auto& b) { return a.point < b.point; });
  }
  return out;
}

}  // namespace bpms
