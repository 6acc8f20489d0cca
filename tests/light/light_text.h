// Light as its reader makes it from the body of [illumination].
#pragma once
#include <gmock/gmock.h>

#include <cmath>
#include <string>

#include "core/toml.h"
#include "core/units.h"
#include "simulate/light/light.h"
#include "tests/data.h"

namespace bpms::test {

struct LightScene {
  Domain domain;
  Bands bands;
  std::vector<std::string> inputs, notes;

  Light read(const std::string& body, const std::string& path = "scene.toml") {
    const TomlDocument document = TomlDocument::parse(path, body);
    Light out = read_light(document.root(), domain, bands, inputs, notes);
    document.finish();
    return out;
  }
};

inline Eigen::Vector3f sky_at(double zenith_deg, double azimuth_deg, const Domain& domain = {}) {
  return direction_from_angles(radians(zenith_deg), radians(azimuth_deg), domain).cast<float>();
}

}  // namespace bpms::test
