#include "simulate/output/netcdf.h"

#include <netcdf.h>
#include <netcdf_mem.h>

#include <cstdlib>
#include <limits>
#include <memory>

#include "core/atomic_file.h"
#include "core/error.h"

namespace bpms {

// HDF5 does not survive a write that fails (it crashes when the program ends), so that the file grows in
// memory.
NetcdfWriter::NetcdfWriter(const std::string& path, bool overwrite) : path_(path), overwrite_(overwrite) {
  check(nc_create_mem(path.c_str(), NC_NETCDF4, 0, &id_), "creating it");
}

NetcdfWriter::~NetcdfWriter() {
  if (id_ >= 0) nc_close(id_);
}

void NetcdfWriter::check(int status, const std::string& doing) const {
  if (status != NC_NOERR)
    fail(ErrorKind::missing_resource, {path_}, "NetCDF fails {}: {}", doing, nc_strerror(status));
}

void NetcdfWriter::global(const std::string& name, const std::string& value) {
  check(nc_put_att_text(id_, NC_GLOBAL, name.c_str(), value.size(), value.data()), "writing " + name);
}

void NetcdfWriter::dimension(const std::string& name, std::size_t size) {
  int unused = 0;
  check(nc_def_dim(id_, name.c_str(), size, &unused), "making dimension " + name);
}

int NetcdfWriter::define(const std::string& name, int type, const std::vector<std::string>& dimensions,
                         const NetcdfAttributes& attributes) {
  std::vector<int> ids;
  for (const std::string& dimension : dimensions) {
    ids.push_back(0);
    check(nc_inq_dimid(id_, dimension.c_str(), &ids.back()), "finding dimension " + dimension);
  }
  int id = 0;
  check(nc_def_var(id_, name.c_str(), type, static_cast<int>(ids.size()), ids.data(), &id),
        "making variable " + name);
  constexpr int quick = 1;
  if (!ids.empty() && type != NC_STRING)
    check(nc_def_var_deflate(id_, id, 1, 1, quick), "compressing " + name);
  const double fill = std::numeric_limits<double>::quiet_NaN();
  if (type == NC_DOUBLE || type == NC_FLOAT)
    check(nc_put_att_double(id_, id, "_FillValue", type, 1, &fill), "writing the fill value of " + name);
  for (const auto& [key, value] : attributes)
    check(nc_put_att_text(id_, id, key.c_str(), value.size(), value.data()), "writing attributes of " + name);
  return id;
}

void NetcdfWriter::variable(const std::string& name, const std::vector<std::string>& dimensions,
                            std::span<const double> values, const NetcdfAttributes& attributes,
                            Precision precision) {
  const int id = define(name, precision == Precision::full ? NC_DOUBLE : NC_FLOAT, dimensions, attributes);
  constexpr int digits = 3;
  if (precision == Precision::three_digits)
    check(nc_def_var_quantize(id_, id, NC_QUANTIZE_GRANULARBR, digits), "shortening " + name);
  check(nc_put_var_double(id_, id, values.data()), "writing " + name);
}

void NetcdfWriter::integers(const std::string& name, const std::vector<std::string>& dimensions,
                            std::span<const long long> values, const NetcdfAttributes& attributes) {
  const int id = define(name, NC_INT64, dimensions, attributes);
  check(nc_put_var_longlong(id_, id, values.data()), "writing " + name);
}

void NetcdfWriter::words(const std::string& name, const std::string& dimension,
                         const std::vector<std::string>& values, const NetcdfAttributes& attributes) {
  const int id = define(name, NC_STRING, {dimension}, attributes);
  std::vector<const char*> texts;
  for (const std::string& value : values) texts.push_back(value.c_str());
  check(nc_put_var_string(id_, id, texts.data()), "writing " + name);
}

void NetcdfWriter::commit() {
  const int id = id_;
  id_ = -1;
  NC_memio content{};
  check(nc_close_memio(id, &content), "closing it");
  const std::unique_ptr<void, void (*)(void*)> owner(content.memory, &std::free);
  write_file(path_, {static_cast<const char*>(content.memory), content.size}, overwrite_);
}

}  // namespace bpms
