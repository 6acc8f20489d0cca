// Measured points sorted by the organ they belong to.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "core/records.h"

namespace bpms {

struct MeasuredOrgan {
  std::string plant;
  std::string axis;
  int rank = 0;
  std::string organ;    // leaf, stem, head
  std::string key;      // what tells it apart in the input: "plant 1 axis 1 rank 3 leaf", "Mercia 12"
  bool planar = false;  // x outward and z up only: y was not measured
  std::vector<VectorPoint> midrib;  // of a stem or head: its axis; in order from the base to the tip
  std::vector<VectorPoint> edge_left, edge_right;
  std::string str() const { return key; }
};

// Organs in order of first appearance; points in order of their number. Organs and features that no function
// is fitted to (a pot, an outline) are left out, each kind named once in `notes`.
std::vector<MeasuredOrgan> group_organs(const std::vector<VectorPoint>& points,
                                        std::vector<std::string>& notes);

// The lowest point digitised on the plant's buds: where its leaves spring from. Absent when there is none.
std::optional<Eigen::Vector3d> bud_of_plant(const std::vector<VectorPoint>& points, const std::string& plant);

}  // namespace bpms
