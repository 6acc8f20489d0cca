// A sensor as its reader makes it from the body of a [[sensors]] table, over a scene with a ground at 0 m and
// a cell of 10 x 6 m.
#pragma once
#include <gmock/gmock.h>

#include <Eigen/Geometry>

#include <memory>
#include <string>

#include "core/random.h"
#include "core/toml.h"
#include "core/units.h"
#include "simulate/sensors/sensor.h"
#include "tests/data.h"

namespace bpms::test {

struct SensorScene {
  Scene scene;
  Light light;
  std::vector<std::string> inputs, notes;
  Extent extent{{-5, -3}, {5, 3}, 2.0, 0.0};

  SensorScene() {
    scene.domain.size_m = {10, 6};
    scene.ground = Ground{};
    Prototype disc;
    disc.discs.push_back({{0, 0, 1.5f}, 0.5f, {0, 0, 1}});
    scene.prototypes.push_back(disc);
    scene.instances.emplace_back();
    Sun sun;
    sun.zenith_deg = 30;
    sun.azimuth_deg = 20;
    sun.direction = direction_from_angles(radians(30), radians(20), scene.domain);
    light.suns.push_back(sun);
  }

  SensorList read_all(const std::string& body, const std::string& path = "scene.toml") {
    const TomlDocument document = TomlDocument::parse(path, "name = \"eye\"\n" + body);
    SensorList out = read_sensors(document.root(), {scene, light, inputs, notes});
    document.finish();
    return out;
  }
  std::unique_ptr<Sensor> read(const std::string& body, const std::string& path = "scene.toml") {
    SensorList all = read_all(body, path);
    EXPECT_EQ(all.size(), 1u);
    return std::move(all.front());
  }
  template <class Kind>
  std::unique_ptr<Kind> read_as(const std::string& body, const std::string& path = "scene.toml") {
    return std::unique_ptr<Kind>(dynamic_cast<Kind*>(read(body, path).release()));
  }
};

inline constexpr SensorNumbers middle{0.5, 0.5, 0.5, 0.5};

inline SensorNumbers numbers_of(Philox& random) {
  SensorNumbers out{random.uniform(), random.uniform()};
  out.s = random.uniform();
  out.t = random.uniform();
  return out;
}

// Where a ray meets the plane z = height.
inline Eigen::Vector3d at_height(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
                                 double height = 0) {
  return origin + direction * ((height - origin.z()) / direction.z());
}

// Vectors of numbers near 1 in 32-bit floats.
inline constexpr double single = 1e-6;

}  // namespace bpms::test
