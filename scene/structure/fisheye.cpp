#include "scene/structure/fisheye.h"

#include <array>
#include <cmath>

#include "core/interrupt.h"
#include "core/parallel.h"
#include "core/units.h"

namespace bpms {
namespace {

constexpr std::array<double, 3> sky_colour{255, 255, 255}, leaf_colour{38, 92, 52}, other_colour{104, 78, 54};

}  // namespace

FisheyePicture fisheye_picture(const GapScene& scene, const Eigen::Vector2d& at, int pixels, int rays) {
  FisheyePicture out;
  out.image.width = out.image.height = pixels;
  const auto side = static_cast<std::size_t>(pixels);
  out.image.rgb.assign(side * side * 3, 255);
  const Eigen::Vector3f from = scene.on_ground(at);
  std::vector<double> gap(side), all(side);  // by row
  parallel_for(side, [&](std::size_t row) {
    throw_if_interrupted();
    for (std::size_t column = 0; column < side; ++column) {
      std::array<double, 3> sum{};
      int inside = 0;
      for (int k = 0; k < rays * rays; ++k) {
        const auto place = [&](std::size_t pixel, int sub) {
          return 2 * (static_cast<double>(pixel) + (sub + 0.5) / rays) / pixels - 1;
        };
        const double x = place(column, k % rays), y = -place(row, k / rays);
        const double zenith = std::hypot(x, y) * pi / 2;
        if (zenith >= pi / 2) continue;
        const double azimuth = std::atan2(y, x);
        const Eigen::Vector3f way = Eigen::Vector3d(std::sin(zenith) * std::cos(azimuth),
                                                    std::sin(zenith) * std::sin(azimuth), std::cos(zenith))
                                        .cast<float>();
        const bool leaf = scene.meets_leaf(from, way), other = !leaf && scene.meets_other(from, way);
        const std::array<double, 3>& colour = leaf ? leaf_colour : other ? other_colour : sky_colour;
        for (std::size_t c = 0; c < 3; ++c) sum[c] += colour[c];
        ++inside;
        // The solid angle of a part of the picture.
        const double weight = zenith > 0 ? std::sin(zenith) / zenith : 1;
        all[row] += weight;
        if (!leaf && !other) gap[row] += weight;
      }
      for (std::size_t c = 0; c < 3 && inside > 0; ++c)
        out.image.rgb[3 * (row * side + column) + c] =
            static_cast<std::uint8_t>(std::lround(sum[c] / inside));
    }
  });
  double gaps = 0, whole = 0;
  for (std::size_t row = 0; row < side; ++row) gaps += gap[row], whole += all[row];
  out.gap_share = whole > 0 ? gaps / whole : 0;
  return out;
}

}  // namespace bpms
