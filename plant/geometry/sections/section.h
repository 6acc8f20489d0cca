// The cross-section of a leaf, at one l and for a width of 1: a curve in the plane of the frame's x (towards
// the lower side) and y, with s from -1 (V = 0) to 1 (V = 1) in proportion to its length. Whatever the
// section, its length is the leaf's width, the midrib (s = 0) is the frame's origin, and a positive
// half-angle lifts both edges towards the upper side (-x). Where a section has folds it is made of panels
// between them, each smooth, with normals of its own at the fold.
//
// To add a kind: one file sections/NAME.cpp and one line in the table of sections/sections.cpp.
#pragma once
#include <Eigen/Core>
#include <string>
#include <string_view>
#include <vector>

#include "plant/plant.h"

namespace bpms {

struct SectionForm {
  double half_angle = 0;                       // f_curvature at l
  double midrib_width = 0, midrib_height = 0;  // over the width
};

struct SectionPoint {
  Eigen::Vector2d at;             // (x, y) over the width
  Eigen::Vector2d by_half_angle;  // its derivative by the half-angle, at the same s
  Eigen::Vector2d across;         // unit tangent towards rising s
};

class LeafSection {
 public:
  virtual ~LeafSection() = default;
  virtual const char* name() const = 0;
  virtual bool has_curvature() const { return true; }       // f_curvature means something
  virtual bool has_raised_midrib() const { return false; }  // needs a_midrib_width and a_midrib_height
  // Why these numbers make no section, or empty.
  virtual std::string complaint(const SectionForm&) const { return {}; }
  // Where panels meet, rising within (-1, 1); a panel more than these.
  virtual std::vector<double> folds(const SectionForm&) const { return {}; }
  virtual SectionPoint point(const SectionForm&, int panel, double s) const = 0;
  // How many straight pieces keep a panel within `tolerance` (over the width) of its curve.
  virtual int pieces(const SectionForm&, double /*tolerance*/) const { return 1; }
  // Where the corners of such pieces lie so that they are together as long as the curve, and their mean is
  // where the curve's is: bending the leaf then stretches both alike. `step`: a piece's extent in s.
  virtual Eigen::Vector2d corner(const SectionForm& form, int panel, double s, double /*step*/) const {
    return point(form, panel, s).at;
  }
};

const LeafSection& leaf_section(std::string_view name);  // an arc where the name is empty
bool is_leaf_section(std::string_view name);
std::vector<std::string> leaf_section_names();
SectionForm section_form(const OrganAttributes& leaf, double half_angle);

}  // namespace bpms
