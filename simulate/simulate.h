// The front door of simulate: from a scene.toml to the radiance that its sensors see, with every part of it
// and the standard error of each number. Reverse Monte Carlo path tracing; definitions and method:
// docs/physics.md.
#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "simulate/light/light.h"
#include "simulate/materials/material.h"
#include "simulate/sensors/sensor.h"

namespace bpms {

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
};
// "0.0002" or "0.1%".
void set_target_se(Sampling& sampling, const std::string& text, const SourceLocation& where);

struct Simulation {
  Scene scene;
  Bands bands;
  std::vector<Material> materials;  // in the order of scene.materials
  Light light;
  std::vector<std::unique_ptr<Sensor>> sensors;
  Sampling sampling;
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

struct Part {
  Origin origin = Origin::total;
  Component component = Component::all;
  int order = every_order;
};

struct Estimates {
  std::vector<double> value;
  std::vector<double> standard_error;
  void resize(std::size_t size);
};

struct SensorResult {
  const Sensor* sensor = nullptr;
  std::vector<Part> parts;
  std::vector<Estimates> radiance;  // for each part: views x bands
  Estimates gap;                    // per view: rays that meet no canopy on their way to the ground or out
  Estimates sunlit, shaded;         // views x materials: of the view, by the material met first
  std::vector<double>
      truncation;  // views x bands: what max_order leaves out, estimated; empty without max_order
  std::vector<std::uint64_t> samples;  // per view; 0 when an interrupt came before
  std::uint64_t rays = 0;
  std::uint64_t lost = 0;  // paths ended by the wrap limit of a periodic domain
};

struct Result {
  std::vector<SensorResult> sensors;
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
