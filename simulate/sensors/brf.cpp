// Whole-domain orthographic view: samples the horizontal cell at the canopy top uniformly and follows
// parallel rays down. In an open domain the footprint lies at the reference height: "top" (as RAMI), "ground"
// or metres.
#include <cmath>

#include "core/units.h"
#include "simulate/sensors/view_list.h"

namespace bpms {
namespace {

struct BrfView {
  double vza_deg, vaa_deg;
  Eigen::Vector3d to_sensor;
};

class BrfSensor : public Sensor {
 public:
  std::vector<BrfView> list;
  enum class Reference { top, ground, metres } reference = Reference::top;
  double reference_m = 0;

  std::size_t views() const override { return list.size(); }
  double vza_deg(std::size_t view) const override { return list[view].vza_deg; }
  double vaa_deg(std::size_t view) const override { return list[view].vaa_deg; }

  std::optional<Eigen::Vector3d> parallel(std::size_t view) const override { return list[view].to_sensor; }

  Ray start(std::size_t view, const SensorNumbers& random, const Extent& extent) const override {
    const Eigen::Vector3d& up = list[view].to_sensor;
    const double height = reference == Reference::top      ? extent.top_m
                          : reference == Reference::ground ? extent.bottom_m
                                                           : reference_m;
    const Eigen::Vector2d at =
        extent.low_m + (extent.high_m - extent.low_m).cwiseProduct(Eigen::Vector2d(random.u, random.v));
    const double margin =
        1e-4 * (1.0 + std::abs(extent.top_m));  // the highest point itself is seen from outside
    const double rise = std::max(0.0, extent.top_m - height) + margin;
    const Eigen::Vector3d origin = Eigen::Vector3d(at.x(), at.y(), height) + up * (rise / up.z());
    Ray out;
    out.origin = origin.cast<float>();
    out.direction = (-up).cast<float>();
    return out;
  }
};

}  // namespace

std::unique_ptr<Sensor> read_brf_sensor(const TomlValue& table, const SensorContext& context) {
  const Domain& domain = context.scene.domain;
  auto out = std::make_unique<BrfSensor>();
  const TomlValue height = table.get("reference_height");
  for (const ViewAngles& view : read_view_list(table, context))
    out->list.push_back({view.vza_deg, view.vaa_deg,
                         direction_from_angles(radians(view.vza_deg), radians(view.vaa_deg), domain)});
  if (height) {
    if (domain.periodic) height.reject("a periodic domain has no reference height: every one sees the same");
    if (height.is_string()) {
      const std::string name = height.one_of({"top", "ground"});
      out->reference = name == "top" ? BrfSensor::Reference::top : BrfSensor::Reference::ground;
    } else {
      out->reference = BrfSensor::Reference::metres;
      out->reference_m = height.number();
    }
  }
  return out;
}

}  // namespace bpms
