// A picture as numbers over (U,V) of a surface: integers of a material map, heights of a bump map. U runs
// with the columns, V from the bottom row up; both wrap outside [0, 1).
#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace bpms {

class Raster {
 public:
  Raster(std::size_t columns, std::size_t rows, std::vector<float> values)  // by rows from the top
      : columns_(columns), rows_(rows), values_(std::move(values)) {}
  std::size_t columns() const { return columns_; }
  std::size_t rows() const { return rows_; }
  const std::vector<float>& values() const { return values_; }
  // Of the pixel that holds (U,V).
  float nearest(const Eigen::Vector2f& uv) const;
  // Bilinear between pixel centres, and its slopes per unit of U and V.
  struct Sloped {
    float value, per_u, per_v;
  };
  Sloped bilinear(const Eigen::Vector2f& uv) const;

 private:
  float at(std::size_t column, std::size_t row) const { return values_[row * columns_ + column]; }
  std::size_t columns_, rows_;
  std::vector<float> values_;
};

}  // namespace bpms
