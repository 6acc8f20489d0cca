// Lists of shapes: whatever the bytes, one located line or shapes whose boxes, areas and crossings are finite
// and agree: a line through the box's middle meets nothing outside of the box.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "scene/importers/shape_list.h"
#include "tests/fuzz/answer.h"

namespace {

void cross(const bpms::Shape& shape) {
  Eigen::Vector3d middle, half;
  bpms::shape_box(shape, middle, half);
  if (!middle.allFinite() || !half.allFinite() || !std::isfinite(bpms::shape_area_m2(shape))) std::abort();
  const double size = half.norm();
  for (const Eigen::Vector3d& d :
       {Eigen::Vector3d(0, 0, 1), Eigen::Vector3d(0.6, 0, -0.8), Eigen::Vector3d(1, 0, 0)}) {
    std::array<bpms::ShapeCrossing, 2> out;
    const int count = bpms::shape_crossings(shape, middle - 3 * size * d, d, out);
    for (int k = 0; k < count; ++k) {
      const bpms::ShapeCrossing& c = out[static_cast<std::size_t>(k)];
      constexpr double rounding = 1e-5;
      if (!(std::abs(c.t - 3 * size) <= size * (1 + rounding))) std::abort();
      const bpms::ShapePoint p = bpms::shape_point(shape, c.part, c.at.cast<float>());
      if (!p.position.allFinite() || !p.normal.allFinite() || !p.dp_du.allFinite() || !p.dp_dv.allFinite())
        std::abort();
      if (!(p.uv.minCoeff() >= 0 && p.uv.maxCoeff() <= 1)) std::abort();
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  bpms::fuzz::answer("fuzz.shapes", [&] {
    bpms::Scene scene;
    bpms::MaterialNames names(scene);
    for (const bpms::Shape& shape :
         bpms::parse_shape_list("fuzz.shapes", text, "bark", {"fuzz.shapes"}, names)) {
      if (shape.material >= scene.materials.size()) std::abort();
      cross(shape);
    }
  });
  return 0;
}
