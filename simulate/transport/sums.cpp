#include "simulate/transport/sums.h"

#include <cmath>

namespace bpms {

double Moments::standard_error(std::size_t index, std::size_t batches) const {
  const auto n = static_cast<double>(batches);
  return std::sqrt(squares_[index] / ((n - 1.0) * n));
}

}  // namespace bpms
