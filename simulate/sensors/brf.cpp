// Whole-domain orthographic view: samples the horizontal cell at the canopy top uniformly and follows
// parallel rays down. In an open domain the footprint lies at the reference height: "top" (as RAMI), "ground"
// or metres.
#include <cmath>

#include "core/units.h"
#include "simulate/number_list.h"
#include "simulate/sensors/sensor.h"

namespace bpms {
namespace {

constexpr double steepest_deg = 89.0;  // beyond, a ray crosses a periodic domain more often than makes sense

struct View {
  double vza_deg, vaa_deg;
  Eigen::Vector3d to_sensor;
};

class BrfSensor : public Sensor {
 public:
  std::vector<View> list;
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

double within_sight(const TomlValue& value) {
  const double vza_deg = value.number();
  if (!(std::abs(vza_deg) <= steepest_deg))
    value.reject(
        fmt::format("view zenith {} degrees: expected at most {} from the vertical", vza_deg, steepest_deg));
  return vza_deg;
}

}  // namespace

std::unique_ptr<Sensor> read_brf_sensor(const TomlValue& table, const SensorContext& context) {
  const Domain& domain = context.scene.domain;
  auto out = std::make_unique<BrfSensor>();
  const auto add = [&](double vza_deg, double vaa_deg) {
    out->list.push_back(
        {vza_deg, vaa_deg, direction_from_angles(radians(vza_deg), radians(vaa_deg), domain)});
  };
  const TomlValue plane = table.get("plane");
  const TomlValue views = table.get("views");
  const TomlValue zeniths = table.get("vza_deg");
  const TomlValue height = table.get("reference_height");
  if (static_cast<bool>(plane) == static_cast<bool>(views))
    table.reject_choice("expected one of plane = \"principal\" | \"cross\" and views = [[vza, vaa], ...]");
  if (plane) {
    const std::string name = plane.one_of({"principal", "cross"});
    if (context.light.suns.empty())
      plane.reject("the principal and the cross plane need a sun: give views = [[vza, vaa], ...]");
    const double turn = name == "principal" ? 180.0 : 90.0;
    for (const double vza : read_number_list(table.require("vza_deg"), within_sight))
      add(vza, context.light.suns.front().azimuth_deg + turn);
  } else {
    if (zeniths) zeniths.reject("views already say their zeniths: expected vza_deg with plane only");
    for (std::size_t i = 0; i < views.size(); ++i) {
      const std::vector<double> pair = views[i].numbers(2);
      add(within_sight(views[i][0]), pair[1]);
    }
    if (out->list.empty()) views.reject("expected at least one [vza, vaa]");
  }
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
