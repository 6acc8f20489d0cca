// Light that keeps one direction: the perfect mirror and the perfectly clear sheet.
#pragma once
#include "simulate/materials/lobe.h"

namespace bpms {

class Mirror : public Lobe {
 public:
  float shape(const Eigen::Vector3f&, const Eigen::Vector3f&) const override { return 0; }
  bool is_delta() const override { return true; }
  bool sample(const Eigen::Vector3f& view, float, float, Eigen::Vector3f& light) const override {
    light = {-view.x(), -view.y(), view.z()};
    return true;
  }
  float pdf(const Eigen::Vector3f&, const Eigen::Vector3f&) const override { return 0; }
};

// No thickness, so no refraction: what passes goes straight on.
class Straight : public Lobe {
 public:
  float shape(const Eigen::Vector3f&, const Eigen::Vector3f&) const override { return 0; }
  bool is_delta() const override { return true; }
  bool is_straight() const override { return true; }
  bool sample(const Eigen::Vector3f& view, float, float, Eigen::Vector3f& light) const override {
    light = -view;
    return true;
  }
  float pdf(const Eigen::Vector3f&, const Eigen::Vector3f&) const override { return 0; }
};

}  // namespace bpms
