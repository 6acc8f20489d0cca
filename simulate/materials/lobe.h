// One way in which a surface scatters light beyond Lambert's law. A material is a diffuse part and any number
// of lobes. To add a kind: its own file with a class and a reader, and a line in read_material.cpp.
//
// Frame: z is the normal of the surface on the side of `view`. Both directions are unit vectors that point
// away from the surface: `view` (z > 0) to where the radiance goes, `light` to where it comes from; light.z >
// 0 is reflection, light.z < 0 transmission. Values are those of the BRDF (BTDF) in sr-1: radiance out =
// integral of value * radiance in * |light.z|. A BRF is pi times it. Lobes are isotropic: turning both
// directions about z changes nothing.
#pragma once
#include <Eigen/Core>
#include <span>

namespace bpms {

class Lobe {
 public:
  virtual ~Lobe() = default;

  // A lobe whose value is spectrum(band) * shape(view, light) is separable: many bands then cost as much as
  // one. Others give a value for each band (`out` has one place for each traced band); their `shape` is
  // about the mean over the bands, to steer by.
  virtual bool separable() const { return true; }
  virtual float shape(const Eigen::Vector3f& view, const Eigen::Vector3f& light) const = 0;
  virtual void values(const Eigen::Vector3f& /*view*/, const Eigen::Vector3f& /*light*/,
                      std::span<float> /*out*/) const {}

  // A mirror or a window sends all light in one direction: `shape` and `pdf` are 0, and `sample` gives that
  // direction with weight spectrum alone.
  virtual bool is_delta() const { return false; }
  // The direction goes straight on: a shadow ray goes through, weakened.
  virtual bool is_straight() const { return false; }

  // Chooses a direction of the light, given the view; `pdf` is its density per steradian, over all bands (a
  // lobe that is not separable draws from the mean over its bands of what it would do in each). False: none,
  // and the path ends. (u, v) are uniform in (0, 1).
  virtual bool sample(const Eigen::Vector3f& view, float u, float v, Eigen::Vector3f& light) const = 0;
  virtual float pdf(const Eigen::Vector3f& view, const Eigen::Vector3f& light) const = 0;

  // About how much of the light it returns (per unit of spectrum where it is separable): steers which lobe a
  // path takes, and changes no result.
  virtual float typical_albedo() const { return 1.0f; }

  // False: value(a, b) != value(b, a); the places of sun and view may not be exchanged.
  virtual bool reciprocal() const { return true; }
  // A formula fitted to measurements, which may give out more than it receives at some angles: that is noted
  // (Material::notes) where others are refused.
  virtual bool empirical() const { return false; }
};

}  // namespace bpms
