// Other people's tables of measured polylines: which column means what is said on the command line,
//   leaf=variety+inerv,x=x,z=y
// `leaf` names the columns whose joint value tells leaves apart; x and z (z up) are needed; without y the
// midribs are planar (x outward). Optional: plant, axis, rank, organ, feature, point (order; else that of the
// file), sigma (of each coordinate, in the same unit). Columns that are not mapped are left alone. Without
// `plant` all leaves are one plant's.
#pragma once
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/csv.h"
#include "fit/measured_organ.h"

namespace bpms {

// Role -> columns (several only for leaf).
using PolylineColumns = std::map<std::string, std::vector<std::string>, std::less<>>;
PolylineColumns parse_polyline_columns(std::string_view text);

std::vector<MeasuredOrgan> read_polylines(const std::string& path, const PolylineColumns& columns,
                                          double metres_per_unit, CsvDialect dialect);

}  // namespace bpms
