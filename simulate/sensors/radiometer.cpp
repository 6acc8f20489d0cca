// A point receiver that looks along `direction`: the mean radiance over a cone of full angle fov_deg (0: a
// single ray), every direction in it counting the same; or, with cosine = true, the irradiance of a plane
// that faces that way, over the whole hemisphere.
#include "simulate/sensors/directions.h"
#include "simulate/sensors/placement.h"

namespace bpms {
namespace {

class RadiometerSensor : public Sensor {
 public:
  RadiometerSensor(const Eigen::Vector3d& location_m, const Eigen::Vector3d& look, const Domain& domain)
      : location_m_(location_m), axes_(look), towards_(angles_of(-look, domain)) {}
  double half_angle = 0;
  bool cosine = false;

  std::size_t views() const override { return 1; }
  Ray start(std::size_t, const SensorNumbers& random, const Extent&) const override {
    return ray_of(location_m_, cosine ? cosine_about(axes_, random.u, random.v)
                                      : within_cone(axes_, half_angle, random.u, random.v));
  }
  Measures measures() const override { return cosine ? Measures::irradiance : Measures::radiance; }
  std::optional<Eigen::Vector3d> faces(std::size_t) const override {
    if (cosine) return axes_.axis;
    return std::nullopt;
  }
  double vza_deg(std::size_t) const override { return towards_.zenith_deg; }
  double vaa_deg(std::size_t) const override { return towards_.azimuth_deg; }

 private:
  Eigen::Vector3d location_m_;
  Axes axes_;
  Angles towards_;
};

}  // namespace

std::unique_ptr<Sensor> read_radiometer_sensor(const TomlValue& table, const SensorContext& context) {
  const TomlValue field = table.get("fov_deg");
  const bool cosine = table.boolean_or("cosine", false);
  const SensorPose at = read_placement(table, context.scene);
  auto out = std::make_unique<RadiometerSensor>(at.location_m, at.look, context.scene.domain);
  out->cosine = cosine;
  if (cosine && field) field.reject("with cosine = true the field is the hemisphere: expected no fov_deg");
  if (!cosine && !field)
    table.reject_choice("expected fov_deg (the full angle of the cone), or cosine = true");
  if (field) out->half_angle = 0.5 * radians(field.number(0, 180));
  return out;
}

}  // namespace bpms
