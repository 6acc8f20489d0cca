// NetCDF files, read: dimensions, numbers, words, attributes. A name that is not there is bad_input.
#pragma once
#include <string>
#include <vector>

namespace bpms {

class NetcdfReader {
 public:
  explicit NetcdfReader(const std::string& path);
  ~NetcdfReader();
  NetcdfReader(const NetcdfReader&) = delete;
  NetcdfReader& operator=(const NetcdfReader&) = delete;

  const std::string& path() const { return path_; }
  bool has(const std::string& variable) const;
  std::string attribute(const std::string& name) const;  // of the file
  std::vector<std::string> names() const;                // of all variables
  std::vector<std::size_t> shape(const std::string& variable) const;
  std::vector<std::string> dimensions(const std::string& variable) const;
  std::vector<double> numbers(const std::string& variable) const;  // all of it, the last dimension fastest
  std::vector<std::string> words(const std::string& variable) const;

 private:
  int find(const std::string& variable) const;
  void check(int status, const std::string& doing) const;
  std::string path_;
  int id_ = -1;
};

}  // namespace bpms
