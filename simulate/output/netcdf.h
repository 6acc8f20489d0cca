// NetCDF-4 files, written: dimensions, double and text variables with attributes. libnetcdf stays behind this
// file. What is written appears under its name only with commit().
#pragma once
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace bpms {

using NetcdfAttributes = std::vector<std::pair<std::string, std::string>>;

// What is kept of a number: all of it, single precision, or three significant digits, which is more than a
// standard error has and is small when compressed.
enum class Precision { full, single, three_digits };

class NetcdfWriter {
 public:
  NetcdfWriter(const std::string& path, bool overwrite);
  ~NetcdfWriter();
  NetcdfWriter(const NetcdfWriter&) = delete;
  NetcdfWriter& operator=(const NetcdfWriter&) = delete;

  void global(const std::string& name, const std::string& value);
  void dimension(const std::string& name, std::size_t size);
  // Values in the order of the dimensions, the last one fastest; NaN is the fill value.
  void variable(const std::string& name, const std::vector<std::string>& dimensions,
                std::span<const double> values, const NetcdfAttributes& attributes,
                Precision precision = Precision::full);
  void integers(const std::string& name, const std::vector<std::string>& dimensions,
                std::span<const long long> values, const NetcdfAttributes& attributes);
  void words(const std::string& name, const std::string& dimension, const std::vector<std::string>& values,
             const NetcdfAttributes& attributes);
  void commit();

 private:
  int define(const std::string& name, int type, const std::vector<std::string>& dimensions,
             const NetcdfAttributes& attributes);
  void check(int status, const std::string& doing) const;
  std::string path_;
  bool overwrite_;
  int id_ = -1;
};

}  // namespace bpms
