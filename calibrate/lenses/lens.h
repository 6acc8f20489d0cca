// A lens model: which pixel a point before a camera falls on, and which ray a pixel looks along. One file a
// model, and one line in lens.cpp. Camera frame: x right, y down, z forward; pixel centres are integers.
#pragma once
#include <Eigen/Core>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace bpms {

// The numbers of one lens: what an adjustment estimates (fx fy cx cy come first in every model), and what the
// model is set up with (the grid of a spline).
struct LensNumbers {
  std::span<const double> parameters, constants;
};

struct LensDerivatives {
  Eigen::Vector2d pixel;
  Eigen::Matrix<double, 2, 3> by_x_cam;
  Eigen::Matrix<double, 2, Eigen::Dynamic> by_parameters;
};

// What is believed of the parameters before any image, +- one standard deviation: sum of coefficients times
// parameters = value. It keeps parameters that no corner touches from being undetermined, and is weak beside
// the corners where there are some.
struct LensPrior {
  std::vector<std::pair<int, double>> coefficients;  // parameter, factor
  double value = 0, sigma = 1;
};

class Lens {
 public:
  virtual ~Lens() = default;
  virtual std::string_view model() const = 0;  // as rig.toml names it
  // Of each parameter. Empty when the model does not come with so many numbers.
  virtual std::vector<std::string> parameter_names(const LensNumbers& numbers) const = 0;
  virtual std::string expected_numbers() const = 0;  // in words, for messages
  // nullopt where the model is not defined, or not one to one.
  virtual std::optional<Eigen::Vector2d> project(const LensNumbers& lens,
                                                 const Eigen::Vector3d& x_cam) const = 0;
  virtual std::optional<LensDerivatives> project_with_derivatives(const LensNumbers& lens,
                                                                  const Eigen::Vector3d& x_cam) const = 0;
  // Unit vector; nullopt where no ray leads to the pixel.
  virtual std::optional<Eigen::Vector3d> unproject(const LensNumbers& lens,
                                                   const Eigen::Vector2d& pixel) const = 0;
  // Parameters that an adjustment leaves as they are, because others can take their part.
  virtual std::vector<int> held(const LensNumbers&) const { return {}; }
  virtual std::vector<LensPrior> priors(const LensNumbers&) const { return {}; }
  virtual std::string prior_words() const { return {}; }  // what they say, for reports
  // The model must give a ray to every pixel of an image. Others are defined where there is an image (a
  // fisheye's circle, a spline's grid), and are to be trusted only where corners were seen.
  virtual bool covers_image() const { return true; }
};

const Lens* find_lens(std::string_view model);  // or nullptr
std::vector<std::string> lens_models();

// What a user can ask for: a model with a number of parameters. The first guess of a calibration is made with
// `from`, a simpler choice, and enriched() takes its camera over (calibrate/lenses/enrich.h).
struct LensChoice {
  std::string name, words, model;
  int parameters = 0;
  std::string from = {};  // empty: the model itself
  std::vector<double> constants = {};
};
const std::vector<LensChoice>& lens_choices();
// bad_input for a name that is none. "splined:16x12" is the splined lens with that many knots.
LensChoice lens_choice(const std::string& name);

}  // namespace bpms
