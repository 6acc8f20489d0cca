// scene.toml stated by what is particular to it. Each piece is the body of its table or the right side of its
// key; an empty one is left out. Leaves go by the material "leaf", the ground by "soil".
#pragma once
#include <fmt/format.h>

#include <string>

namespace bpms::test {

// Bodies of materials; a spectrum is written as in the file: 0.4, [[650, 0.1], ...] or "file.csv".
inline std::string lambertian(const std::string& reflectance) {
  return fmt::format("type = \"lambertian\"\nreflectance = {}\n", reflectance);
}
inline std::string bilambertian(const std::string& reflectance, const std::string& transmittance) {
  return fmt::format("type = \"bilambertian\"\nreflectance = {}\ntransmittance = {}\n", reflectance,
                     transmittance);
}

// What has a radiance equal to its reflectance factor where everything else is black.
inline std::string sun_at(double zenith_deg, double azimuth_deg, const std::string& irradiance = "\"brf\"") {
  return fmt::format("{{ zenith_deg = {:.9g}, azimuth_deg = {:.9g}, irradiance = {} }}", zenith_deg,
                     azimuth_deg, irradiance);
}
inline const char* const white_sky = "{ type = \"isotropic\", radiance = 1.0 }";

// Bodies of the one sensor.
inline std::string views(const std::string& list) {
  return "name = \"views\"\ntype = \"brf\"\nviews = " + list + "\n";
}
inline std::string principal_plane(const std::string& vza_deg) {
  return "name = \"pp\"\ntype = \"brf\"\nplane = \"principal\"\nvza_deg = " + vza_deg + "\n";
}

// towards: look_at or direction, and zoom or fov_deg.
inline std::string camera(const std::string& location, const std::string& towards, int width_px,
                          int height_px) {
  return fmt::format(
      "name = \"camera\"\ntype = \"perspective\"\nlocation = {}\n{}\nwidth_px = {}\nheight_px = {}\n",
      location, towards, width_px, height_px);
}

struct SceneText {
  std::string domain = "size_m = [2, 2]";
  std::string leaf{}, soil{};
  std::string ground = soil.empty() ? "" : "soil";
  std::string discs{}, mesh{};  // files of the one prototype, of "leaf"
  std::string positions = "[[0, 0, 0]]";
  std::string sun{}, sky{};
  std::string sensor{};
  std::string wavelengths_nm{}, bands{};  // the list, or the body of [bands]
  std::string sampling{};

  std::string str() const {
    std::string out = "[domain]\n" + domain + "\n";
    const auto table = [&](const std::string& name, const std::string& body) {
      if (!body.empty()) out += name + "\n" + body + (body.ends_with('\n') ? "" : "\n");
    };
    const auto keyed = [](const char* key, const std::string& value) {
      return value.empty() ? "" : std::string(key) + " = " + value + "\n";
    };
    table("[materials.leaf]", leaf);
    table("[materials.soil]", soil);
    table("[ground]", ground.empty() ? "" : "type = \"plane\"\nmaterial = \"" + ground + "\"");
    if (!discs.empty() || !mesh.empty()) {
      const std::string file = discs.empty() ? "mesh = \"" + mesh : "discs = \"" + discs;
      table("[prototypes.canopy]", file + "\"\nmaterial = \"leaf\"");
      table("[[instances]]", "prototype = \"canopy\"\npositions = " + positions);
    }
    table("[illumination]", keyed("sun", sun) + keyed("sky", sky));
    table("[[sensors]]", sensor);
    table("[bands]", keyed("wavelengths_nm", wavelengths_nm) + bands);
    table("[sampling]", sampling);
    return out;
  }
};

}  // namespace bpms::test
