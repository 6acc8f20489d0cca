// The front door of simulate: from a scene.toml to the radiance that its sensors see, with every part of it
// and the standard error of each number. Reverse Monte Carlo path tracing; definitions and method:
// docs/physics.md.
#pragma once
#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "simulate/light/light.h"
#include "simulate/materials/material.h"
#include "simulate/sensors/flux_sensor.h"
#include "simulate/sensors/sensor.h"

namespace bpms {

// From the sensors, from the light, or whichever costs less (forward/choose_mode.h).
enum class Mode { reverse, forward, automatic };

// When to stop, per view: a standard error of the total in every band, or a number of paths.
struct Sampling {
  double target_se = 0;   // 0: none
  bool relative = false;  // target_se is a fraction of the value
  std::uint64_t samples = 0;
  std::uint64_t max_samples = 10'000'000;
  double max_seconds = 0;  // of the whole run; 0: none
  int max_order = 0;       // 0: until roulette ends it
  int orders = 0;          // scattering orders kept apart, the last holds all higher ones; 0: chosen
  bool roulette = true;
  int diffuse_rays = 1;               // that go on from the first interaction
  bool interpolated_normals = false;  // of meshes, for scattering; else geometric normals
  // ARARAT's habit: diffusely transmitting surfaces weaken a shadow ray and do not block it (counts that
  // light twice).
  bool attenuate_shadows = false;
  bool keep_interactions = false;  // for other spectra afterwards
  Mode mode = Mode::reverse;
  SourceLocation mode_where{};  // where it was asked for
};
// "0.0002" or "0.1%".
void set_target_se(Sampling& sampling, const std::string& text, const SourceLocation& where);

struct Simulation {
  Scene scene;
  Bands bands;
  std::vector<Material> materials;  // in the order of scene.materials
  Light light;
  std::vector<std::unique_ptr<Sensor>> sensors;
  std::vector<FluxSensor> fluxes;
  Sampling sampling;
  std::uint64_t most_bytes = 0;  // for what is traced and the results together; 0: no limit
  std::vector<std::string> inputs;
};
Simulation read_simulation(const std::string& path);
// The same from the text; `path` stands in messages, and the files it names lie relative to its folder.
Simulation parse_simulation(const std::string& path, std::string_view text);

enum class Origin { total, direct, diffuse };  // which source a photon came from
enum class Component {
  all,
  uc_sgl,
  co_sgl,
  mlt
};  // order 1 ground, order 1 canopy, the rest; of direct light
inline constexpr int every_order = -1;
const char* name_of(Origin origin);
const char* name_of(Component component);

inline constexpr int every_sun = -1;
struct Part {
  Origin origin = Origin::total;
  Component component = Component::all;
  int order = every_order;
  int sun = every_sun;  // of several: this one's light alone
  bool operator==(const Part&) const = default;
};

struct Estimates {
  std::vector<double> value;
  std::vector<double> standard_error;
  void resize(std::size_t size);
};

// How often each spectrum multiplied the light of a view: a node is a monomial in the factors (spectra of the
// materials, see factor_names), with the mean over the paths of each batch of what no band changes: for each
// sun the light per unit of irradiance / pi, for the sky per unit of radiance, for each sun again the part of
// it by way of the ground alone (order 1).
struct InteractionHistogram {
  std::size_t factors = 0, sums_per_node = 0, batches = 0;
  std::vector<std::uint16_t> exponents;  // nodes x factors
  std::vector<double> sums;              // nodes x sums_per_node x batches
  std::size_t nodes() const { return factors == 0 ? 0 : exponents.size() / factors; }
};
// "leaf.reflectance", "leaf.reflectance_back", "leaf.transmittance" of each material, then "leaf.lobe1" ...
std::vector<std::string> factor_names(const Simulation& simulation);

struct SensorResult {
  const Sensor* sensor = nullptr;
  std::vector<Part> parts;
  std::vector<Estimates> radiance;  // for each part: views x bands
  // Its place in `parts`, or their number where it is not among them.
  std::size_t place_of(const Part& part) const {
    return static_cast<std::size_t>(std::find(parts.begin(), parts.end(), part) - parts.begin());
  }
  Estimates gap;  // per view: rays that meet no canopy on their way to the ground or out
  // Of the view, by the material met first: views x suns x materials. lit_behind: of the sunlit part, what is
  // lit on the face that is not seen.
  Estimates sunlit, shaded, lit_behind;
  Estimates sunlit_ground;  // views x suns: the bidirectional gap probability
  // Views x bands, where there are suns and a sky: of the direct and the diffuse radiance, which come from
  // the same paths.
  std::vector<double> direct_diffuse_covariance;
  std::vector<double>
      truncation;  // views x bands: what max_order leaves out, estimated; empty without max_order
  std::vector<std::uint64_t> samples;  // per view; 0 when an interrupt came before
  std::vector<double> covariance;      // of the totals where views share paths: bands x views x views
  std::vector<InteractionHistogram> histograms;  // per view, when they were asked for
  std::uint64_t rays = 0;
  std::uint64_t lost = 0;  // paths ended by the wrap limit of a periodic domain
};

struct FluxResult;  // forward/forward.h
struct Result {
  std::vector<std::shared_ptr<const FluxResult>> fluxes;  // of each flux sensor
  std::vector<SensorResult> sensors;
  Estimates sun_gap;  // gap probability towards each sun; empty without a `brf` sensor
  // Of the irradiance, per written band: asks for the reflectance under it, recombined from direct and
  // diffuse; empty: not asked for.
  std::vector<double> diffuse_fraction;
  std::uint64_t samples = 0;
  std::uint64_t rays = 0;
  double seconds = 0;
  int threads = 1;
  std::uint64_t seed = 1;
  std::string stopped_by;  // target_se, samples, max_samples, max_seconds, interrupt
};

// Stops at Ctrl-C with what is done (stopped_by "interrupt"); throws `interrupted` when that is nothing.
Result simulate(const Simulation& simulation, std::uint64_t seed);
// The same with the scene's rays at hand already.
Result simulate(const Simulation& simulation, const Intersector& intersector, std::uint64_t seed);

}  // namespace bpms
