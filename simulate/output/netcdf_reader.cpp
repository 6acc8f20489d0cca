#include "simulate/output/netcdf_reader.h"

#include <netcdf.h>

#include <array>
#include <filesystem>
#include <numeric>

#include "core/error.h"

namespace bpms {

NetcdfReader::NetcdfReader(const std::string& path) : path_(path) {
  if (!std::filesystem::exists(path)) fail(ErrorKind::missing_resource, {path}, "no such file");
  if (std::filesystem::is_directory(path)) fail(ErrorKind::missing_resource, {path}, "is a folder");
  if (std::filesystem::file_size(path) == 0) bad_input({path}, "the file is empty");
  if (nc_open(path.c_str(), NC_NOWRITE, &id_) != NC_NOERR) {
    id_ = -1;
    bad_input({path}, "not a NetCDF file");
  }
}

NetcdfReader::~NetcdfReader() {
  if (id_ >= 0) nc_close(id_);
}

void NetcdfReader::check(int status, const std::string& doing) const {
  if (status != NC_NOERR) bad_input({path_}, "NetCDF fails {}: {}", doing, nc_strerror(status));
}

bool NetcdfReader::has(const std::string& variable) const {
  int id = 0;
  return nc_inq_varid(id_, variable.c_str(), &id) == NC_NOERR;
}

int NetcdfReader::find(const std::string& variable) const {
  int id = 0;
  if (nc_inq_varid(id_, variable.c_str(), &id) != NC_NOERR)
    bad_input({path_}, "there is no variable {}", in_quotes(variable));
  return id;
}

std::vector<std::string> NetcdfReader::names() const {
  int count = 0;
  check(nc_inq_nvars(id_, &count), "counting variables");
  std::vector<std::string> out;
  for (int v = 0; v < count; ++v) {
    std::array<char, NC_MAX_NAME + 1> name{};
    check(nc_inq_varname(id_, v, name.data()), "naming variables");
    out.emplace_back(name.data());
  }
  return out;
}

std::string NetcdfReader::attribute(const std::string& name) const {
  std::size_t length = 0;
  if (nc_inq_attlen(id_, NC_GLOBAL, name.c_str(), &length) != NC_NOERR)
    bad_input({path_}, "there is no attribute {}", in_quotes(name));
  std::string out(length, ' ');
  check(nc_get_att_text(id_, NC_GLOBAL, name.c_str(), out.data()), "reading " + name);
  return out;
}

std::vector<std::size_t> NetcdfReader::shape(const std::string& variable) const {
  const int id = find(variable);
  int count = 0;
  check(nc_inq_varndims(id_, id, &count), "reading " + variable);
  std::vector<int> ids(static_cast<std::size_t>(count));
  check(nc_inq_vardimid(id_, id, ids.data()), "reading " + variable);
  std::vector<std::size_t> out;
  for (const int dimension : ids)
    check(nc_inq_dimlen(id_, dimension, &out.emplace_back()), "reading " + variable);
  return out;
}

std::vector<std::string> NetcdfReader::dimensions(const std::string& variable) const {
  const int id = find(variable);
  std::vector<int> ids(shape(variable).size());
  check(nc_inq_vardimid(id_, id, ids.data()), "reading " + variable);
  std::vector<std::string> out;
  for (const int dimension : ids) {
    std::array<char, NC_MAX_NAME + 1> name{};
    check(nc_inq_dimname(id_, dimension, name.data()), "reading " + variable);
    out.emplace_back(name.data());
  }
  return out;
}

std::vector<double> NetcdfReader::numbers(const std::string& variable) const {
  const std::vector<std::size_t> size = shape(variable);
  std::vector<double> out(std::accumulate(size.begin(), size.end(), std::size_t{1}, std::multiplies<>()));
  check(nc_get_var_double(id_, find(variable), out.data()), "reading " + variable);
  return out;
}

std::vector<std::string> NetcdfReader::words(const std::string& variable) const {
  const std::vector<std::size_t> size = shape(variable);
  std::vector<char*> texts(std::accumulate(size.begin(), size.end(), std::size_t{1}, std::multiplies<>()));
  check(nc_get_var_string(id_, find(variable), texts.data()), "reading " + variable);
  std::vector<std::string> out(texts.begin(), texts.end());
  nc_free_string(texts.size(), texts.data());
  return out;
}

}  // namespace bpms
