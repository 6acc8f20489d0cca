// Discs in cells: a ray walks from cell to cell (Amanatides & Woo 1987) and tests the eight or so discs of
// each at once. Where discs fill the scene evenly this takes a third of the time of a hierarchy; where much
// of it is empty the hierarchy is better, so `make` answers null there. Discs alone (no meshes, shapes,
// terrain); a periodic cell is walked round without end.
//
// Discs are numbered through all instances: those of instance i, as its prototype numbers them, from
// first_id(i) on.
#pragma once
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/large_vector.h"
#include "scene/intersect/box.h"
#include "scene/intersect/intersector.h"

namespace bpms {

class TracedScene;

class DiscGrid {
 public:
  static constexpr std::uint32_t none = 0xffffffffu;
  static constexpr std::size_t wide = 8;

  // Null where the scene does not suit, has few discs, a disc is wider than half the period, or the grid
  // would take more bytes.
  static std::unique_ptr<DiscGrid> make(const TracedScene& traced, const Scene& scene,
                                        std::uint64_t most_bytes);

  std::uint32_t first_id(std::uint32_t instance) const { return first_id_[instance]; }

  enum class End { disc, far, side, wraps };  // `side`: left an open scene, or the top or bottom
  struct Query {
    Eigen::Vector3d origin, direction;  // from inside the cell where it is periodic
    double far;
    std::uint32_t skip = none;  // a disc that the ray starts on
    bool any = false;           // whichever disc is found first will do; its distance is not wanted
    int max_wraps = 1000;
  };
  struct Found {
    double distance;
    std::uint32_t instance, primitive;
    Eigen::Vector3d position, normal;  // in the cell, in the disc's plane; unit normal
    double radius;
  };
  // The first disc met in (0, far); `side` and `far`: none.
  End first(const Query& query, Found& found) const;

  std::uint64_t memory_bytes() const;

 private:
  using Floats = float __attribute__((vector_size(4 * wide)));
  struct alignas(32) Packet {  // by component; empty places have a negative squared radius
    Floats x, y, z, nx, ny, nz, radius2;
  };
  struct Copy {  // of a disc, in the box
    Eigen::Vector3f centre;
    std::uint32_t disc;
  };
  struct Walk;  // a ray's way through the box

  DiscGrid(const TracedScene& traced, const Scene& scene);
  bool build(std::uint64_t most_bytes);
  void choose_cells(double side);
  template <class Visit>
  void each_copy(Visit visit) const;
  template <class Visit>
  void cells_of(const Copy& copy, Visit visit) const;
  void walk(Walk& walk) const;

  std::vector<Disc> discs_;  // in the world; empty once they are in cells
  std::vector<std::uint32_t> first_id_;
  bool periodic_;
  Eigen::Vector3d low_, high_;  // of the box
  Eigen::Vector2d size_;        // of the period
  Eigen::Vector3f cell_m_, per_m_, low_f_;
  std::array<int, 3> cells_{1, 1, 1};
  double widest_ = 0;  // diameter
  LargeVector<std::uint32_t> first_packet_;
  LargeVector<Packet> packets_;
  LargeVector<std::array<std::uint32_t, wide>> ids_;  // of each packet's discs
};

}  // namespace bpms
