#include "scene/pictures/shaded.h"

#include <algorithm>
#include <cmath>

#include "core/parallel.h"
#include "core/random.h"
#include "core/units.h"

namespace bpms {
namespace {

// Parts of the light, chosen by eye: a white surface in full sun and under the whole sky is white.
constexpr double sun_light = 0.68, sky_light = 0.5, light_everywhere = 0.3;  // the last: of the sky's
constexpr double through_leaf = 0.45;      // of the sun, on the side that is turned away from it
constexpr double lower_side_paler = 0.18;  // leaves from below
constexpr double sun_elevation_deg = 48, sun_left_of_eye_deg = 40, sun_radius = 0.03;

struct Light {
  Eigen::Vector3d sun;
};

Light light_for(const PictureCamera& camera) {
  // From the eye's left (clockwise, seen from above) and above; a view from above has its left too.
  const Eigen::Vector3d level_back = Eigen::Vector3d(camera.frame.right.y(), -camera.frame.right.x(), 0);
  const double turn = radians(sun_left_of_eye_deg), up = radians(sun_elevation_deg);
  const Eigen::Vector3d level = std::cos(turn) * level_back - std::sin(turn) * camera.frame.right;
  return {std::cos(up) * level + std::sin(up) * Eigen::Vector3d::UnitZ()};
}

// Two unit vectors across a third.
void across(const Eigen::Vector3d& n, Eigen::Vector3d& a, Eigen::Vector3d& b) {
  a = (std::abs(n.z()) < 0.9 ? Eigen::Vector3d::UnitZ() : Eigen::Vector3d::UnitX()).cross(n).normalized();
  b = n.cross(a);
}

class Shader {
 public:
  Shader(const ShadedScene& of, const PictureCamera& camera)
      : of_(of), camera_(camera), light_(light_for(camera)) {}

  // The light from one point of the picture; false where nothing stands.
  bool shade(double x, double y, std::uint32_t sample, std::uint64_t pixel, Eigen::Vector3d& out) const {
    Hit hit;
    const Ray ray = camera_.ray(x, y);
    if (of_.intersector.intersect(ray, hit) != Escape::hit) return false;
    const Eigen::Vector3d to_eye = -ray.direction.cast<double>();
    Eigen::Vector3d normal = hit.shading_normal.cast<double>();
    const bool geometric_side = hit.geometric_normal.cast<double>().dot(to_eye) >= 0;
    if (!geometric_side) normal = -normal;
    const std::uint32_t prototype = of_.scene.instances[hit.id.instance].prototype;
    const PictureParts& parts = of_.parts[prototype];
    const std::uint32_t part = part_of_hit(parts, of_.scene, hit);
    const std::string& kind = parts.parts[part].kind;
    const bool thin = kind == "leaf" || kind == "disc";
    out = base(of_.colouring.colour_of[prototype][part], thin && !geometric_side) *
          (sun_on(hit, normal, thin, sample, pixel) + sky_on(hit, normal, sample, pixel));
    return true;
  }

 private:
  static Eigen::Vector3d base(const Rgb& colour, bool paler) {
    Eigen::Vector3d out;
    for (int k = 0; k < 3; ++k) out[k] = linear_of_srgb(colour[static_cast<std::size_t>(k)] / 255.0);
    if (paler) out += lower_side_paler * (Eigen::Vector3d::Ones() - out);
    return out;
  }
  double sun_on(const Hit& hit, const Eigen::Vector3d& normal, bool thin, std::uint32_t sample,
                std::uint64_t pixel) const {
    Eigen::Vector3d a, b;
    across(light_.sun, a, b);
    const double r = sun_radius * std::sqrt(sobol_owen(sample, 4, pixel));
    const double turn = 2 * pi * sobol_owen(sample, 5, pixel);
    const Eigen::Vector3d to = (light_.sun + r * (std::cos(turn) * a + std::sin(turn) * b)).normalized();
    const double cosine = normal.dot(to);
    const double part = cosine > 0 ? cosine : thin ? -through_leaf * cosine : 0;
    if (!(part > 0)) return 0;
    return of_.intersector.occluded(from(hit, to)) ? 0 : sun_light * part;
  }
  double sky_on(const Hit& hit, const Eigen::Vector3d& normal, std::uint32_t sample,
                std::uint64_t pixel) const {
    Eigen::Vector3d a, b;
    across(normal, a, b);
    const double u = sobol_owen(sample, 2, pixel), turn = 2 * pi * sobol_owen(sample, 3, pixel);
    const Eigen::Vector3d to =
        std::sqrt(u) * (std::cos(turn) * a + std::sin(turn) * b) + std::sqrt(1 - u) * normal;
    const bool open = !of_.intersector.occluded(from(hit, to));
    // The sky is brighter above than the ground's light is from below.
    const double seen = open ? 0.7 + 0.3 * to.z() : 0;
    return sky_light * (light_everywhere + (1 - light_everywhere) * seen);
  }
  static Ray from(const Hit& hit, const Eigen::Vector3d& to) {
    Ray out;
    out.origin = hit.position;
    out.direction = to.cast<float>();
    out.from = hit.id;
    out.from_normal = hit.geometric_normal;
    out.from_extent = hit.extent;
    return out;
  }

  const ShadedScene& of_;
  const PictureCamera& camera_;
  Light light_;
};

}  // namespace

void draw_shaded(const ShadedScene& of, const PictureCamera& camera, int samples, int left, int top,
                 Canvas& canvas) {
  const Shader shader(of, camera);
  const auto rows = static_cast<std::size_t>(camera.height);
  const int columns = static_cast<int>(camera.width);
  parallel_for(rows, [&](std::size_t row) {
    for (int column = 0; column < columns; ++column) {
      // Pixels next to each other must not share their noise.
      const std::uint64_t pixel =
          (static_cast<std::uint64_t>(row) << 32) + static_cast<std::uint64_t>(column);
      Eigen::Vector3d sum = Eigen::Vector3d::Zero(), light;
      int met = 0;
      for (int k = 0; k < samples; ++k) {
        const auto sample = static_cast<std::uint32_t>(k);
        const double x = column + sobol_owen(sample, 0, pixel);
        const double y = static_cast<double>(row) + sobol_owen(sample, 1, pixel);
        if (!shader.shade(x, y, sample, pixel, light)) continue;
        sum += light;
        ++met;
      }
      if (met == 0) continue;
      Rgb colour{};
      for (int c = 0; c < 3; ++c)
        colour[static_cast<std::size_t>(c)] =
            static_cast<std::uint8_t>(std::lround(255 * srgb_of_linear(std::clamp(sum[c] / met, 0.0, 1.0))));
      canvas.over(left + column, top + static_cast<int>(row), colour, static_cast<double>(met) / samples);
    }
  });
}

}  // namespace bpms
