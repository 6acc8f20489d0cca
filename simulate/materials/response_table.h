// Response functions of a sensor's bands as its makers publish them: a header of names, then rows of a
// wavelength (nm) and the response in each band; separated by commas, semicolons or white space.
#pragma once
#include <string>
#include <vector>

namespace bpms {

struct ResponseTable {
  std::vector<double> nm;  // increasing
  std::vector<std::string> names;
  std::vector<std::vector<double>> response;  // by name, at each nm; >= 0
  double width_nm(std::size_t row) const;     // of the wavelengths that a row stands for (trapezoidal rule)
};

// With `step_nm` > 0 the rows are first brought to multiples of it, linear in between.
ResponseTable read_response_table(const std::string& path, double step_nm);

}  // namespace bpms
