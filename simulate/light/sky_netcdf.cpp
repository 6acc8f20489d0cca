#include <netcdf.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "core/error.h"
#include "simulate/light/sky_table.h"

namespace bpms {
namespace {

// An open file; what goes wrong with it is the file's fault.
class SkyNetcdf {
 public:
  explicit SkyNetcdf(const std::string& path) : path_(path) {
    if (!std::filesystem::exists(path)) fail(ErrorKind::missing_resource, {path}, "no such file");
    check(nc_open(path.c_str(), NC_NOWRITE, &id_), "it cannot be opened");
  }
  ~SkyNetcdf() { nc_close(id_); }
  SkyNetcdf(const SkyNetcdf&) = delete;
  SkyNetcdf& operator=(const SkyNetcdf&) = delete;

  int variable(const std::string& name) const {  // -1: absent
    int out = -1;
    return nc_inq_varid(id_, name.c_str(), &out) == NC_NOERR ? out : -1;
  }
  std::vector<int> dimensions(int variable) const {
    int count = 0;
    check(nc_inq_varndims(id_, variable, &count), "a variable without dimensions");
    std::vector<int> out(static_cast<std::size_t>(count));
    check(nc_inq_vardimid(id_, variable, out.data()), "a variable without dimensions");
    return out;
  }
  std::string dimension_name(int dimension) const {
    char name[NC_MAX_NAME + 1] = {};
    check(nc_inq_dimname(id_, dimension, name), "a dimension without a name");
    return name;
  }
  std::size_t length(int dimension) const {
    std::size_t out = 0;
    check(nc_inq_dimlen(id_, dimension, &out), "a dimension without a length");
    return out;
  }
  std::vector<double> values(int variable, std::size_t count) const {
    std::vector<double> out(count);
    check(nc_get_var_double(id_, variable, out.data()), "values that are no numbers");
    return out;
  }
  std::string text(int variable, const char* attribute) const {  // "": absent
    std::size_t length = 0;
    nc_type type = NC_NAT;
    if (nc_inq_att(id_, variable, attribute, &type, &length) != NC_NOERR || type != NC_CHAR) return "";
    std::string out(length, ' ');
    check(nc_get_att_text(id_, variable, attribute, out.data()), "an attribute that is no text");
    return out;
  }
  // What stands for a missing value.
  double fill(int variable) const {
    double out = NC_FILL_DOUBLE;
    nc_type type = NC_NAT;
    if (nc_get_att_double(id_, variable, "_FillValue", &out) == NC_NOERR) return out;
    if (nc_inq_vartype(id_, variable, &type) == NC_NOERR && type == NC_FLOAT)
      return static_cast<double>(NC_FILL_FLOAT);
    return out;
  }

 private:
  void check(int status, const char* what) const {
    if (status != NC_NOERR) bad_input({path_}, "NetCDF: {}: {}", what, nc_strerror(status));
  }
  std::string path_;
  int id_ = -1;
};

// A coordinate variable; empty where there is none.
std::vector<double> coordinate(const SkyNetcdf& file, const std::string& path, const std::string& name,
                               const std::vector<std::string>& units) {
  const int variable = file.variable(name);
  if (variable < 0) return {};
  const std::vector<int> dimensions = file.dimensions(variable);
  if (dimensions.size() != 1 || file.dimension_name(dimensions[0]) != name)
    bad_input({path}, "variable {}: expected the one dimension {}", name, name);
  const std::string unit = file.text(variable, "units");
  if (!unit.empty() && std::find(units.begin(), units.end(), unit) == units.end())
    bad_input({path}, "variable {} is in {}: expected {}", name, in_quotes(unit), units.front());
  std::vector<double> out = file.values(variable, file.length(dimensions[0]));
  for (std::size_t i = 0; i < out.size(); ++i)
    if (!std::isfinite(out[i]) || (i > 0 && !(out[i] > out[i - 1])))
      bad_input({path}, "variable {}: {} at {}: expected increasing values", name, out[i], i);
  return out;
}

}  // namespace

SkyTable read_sky_netcdf(const std::string& path) {
  const SkyNetcdf file(path);
  SkyTable out;
  out.zenith_deg = coordinate(file, path, "zenith", {"degrees", "degree"});
  out.azimuth_deg = coordinate(file, path, "azimuth", {"degrees", "degree"});
  out.wavelength_nm = coordinate(file, path, "wavelength", {"nm", "nanometers", "nanometer"});
  const int variable = file.variable("radiance");
  if (variable < 0 || out.zenith_deg.empty() || out.azimuth_deg.empty())
    bad_input({path}, "expected variables zenith, azimuth and radiance");
  require_sky_grid(out, path);
  // Strides by the order in which the file has its dimensions.
  const std::vector<std::string> names{"zenith", "azimuth", "wavelength"};
  std::size_t strides[3] = {}, count = 1;
  const std::vector<int> dimensions = file.dimensions(variable);
  for (auto d = dimensions.rbegin(); d != dimensions.rend(); ++d) {
    const auto known = std::find(names.begin(), names.end(), file.dimension_name(*d));
    if (known == names.end())
      bad_input({path}, "radiance has a dimension {}: expected zenith, azimuth and wavelength",
                in_quotes(file.dimension_name(*d)));
    strides[known - names.begin()] = count;
    count *= file.length(*d);
  }
  if (count != out.zenith_deg.size() * out.azimuth_deg.size() * out.colours())
    bad_input({path}, "radiance has {} values: expected {} x {} x {} over zenith, azimuth and wavelength",
              count, out.zenith_deg.size(), out.azimuth_deg.size(), out.colours());
  const std::vector<double> values = file.values(variable, count);
  const double fill = file.fill(variable);
  out.radiance.resize(count);
  for (std::size_t z = 0; z < out.zenith_deg.size(); ++z)
    for (std::size_t a = 0; a < out.azimuth_deg.size(); ++a)
      for (std::size_t w = 0; w < out.colours(); ++w) {
        const double value = values[z * strides[0] + a * strides[1] + w * strides[2]];
        const bool missing = std::isnan(value) || value == fill;
        out.at(z, a, w) = missing ? std::nan("") : require_radiance(value, {path});
      }
  return out;
}

}  // namespace bpms
