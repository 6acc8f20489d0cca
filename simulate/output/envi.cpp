#include "simulate/output/envi.h"

#include <fmt/format.h>

#include <bit>
#include <cmath>

#include "simulate/output/output.h"
#include "simulate/output/quantity.h"

namespace bpms {
namespace {

void append_float(std::string& to, float value) {
  const auto bits = std::bit_cast<std::uint32_t>(value);
  for (int byte = 0; byte < 4; ++byte) to += static_cast<char>((bits >> (8 * byte)) & 0xffu);
}

// Braces end a value of the header, commas part a list.
std::string plain(std::string text) {
  for (char& c : text)
    if (c == '{' || c == '}' || c == ',' || c == '\n' || c == '\r') c = ' ';
  return text;
}

template <class Item>
std::string list_of(std::size_t count, Item item) {
  std::string out = "{";
  for (std::size_t i = 0; i < count; ++i) out += (i == 0 ? "" : ", ") + item(i);
  return out + "}";
}

}  // namespace

EnviCube envi_cube(const Simulation& simulation, const SensorResult& result, bool standard_errors,
                   const std::string& provenance) {
  const Sensor& sensor = *result.sensor;
  const Bands& bands = simulation.bands;
  const std::size_t count = bands.written(), pixels = result.samples.size();
  const bool image = sensor.is_image();
  const Quantity quantity = image ? light_quantity(sensor) : reflectance_quantity(simulation.light, sensor);
  const std::vector<double> scale =
      image ? std::vector<double>(count, light_scale(sensor)) : reflectance_scale(simulation, Origin::total);
  const Estimates& whole = result.radiance.front();
  const std::vector<double>& from = standard_errors ? whole.standard_error : whole.value;
  EnviCube out;
  out.pixels.reserve(pixels * count * 4);
  for (std::size_t band = 0; band < count; ++band)
    for (std::size_t pixel = 0; pixel < pixels; ++pixel) {
      const double value = from[pixel * count + band] * scale[band];
      const bool known = result.samples[pixel] > 0 && std::isfinite(value);
      append_float(out.pixels, known ? static_cast<float>(value) : envi_no_value);
    }
  std::string what = (standard_errors ? "standard error of " : "") + std::string(quantity.words);
  std::string& text = out.header;
  text = fmt::format("ENVI\ndescription = {{{}; {}; units {}; {}}}\n", plain(what), plain(sensor.name),
                     quantity.units, plain(provenance));
  text += fmt::format(
      "samples = {}\nlines = {}\nbands = {}\nheader offset = 0\nfile type = ENVI Standard\ndata type = 4\n"
      "interleave = bsq\nbyte order = 0\ndata ignore value = {}\n",
      image ? static_cast<std::size_t>(sensor.width()) : pixels, image ? sensor.height() : 1, count,
      static_cast<int>(envi_no_value));
  if (image) text += "sensor type = Unknown\n";
  const bool named = !bands.responses.empty(), known_nm = std::isfinite(bands.written_nm(0));
  text +=
      "band names = " +
      list_of(count,
              [&](std::size_t b) {
                if (named) return plain(bands.written_name(b));
                return known_nm ? fmt::format("{:g} nm", bands.written_nm(b)) : fmt::format("band {}", b + 1);
              }) +
      "\n";
  if (known_nm)
    text += "wavelength units = Nanometers\nwavelength = " +
            list_of(count, [&](std::size_t b) { return fmt::format("{:.9g}", bands.written_nm(b)); }) + "\n";
  if (!image) {
    const auto angles = [&](auto angle) {
      return list_of(pixels, [&](std::size_t v) { return fmt::format("{:g}", angle(v)); });
    };
    text += "view zenith deg = " + angles([&](std::size_t v) { return sensor.vza_deg(v); }) + "\n";
    text += "view azimuth deg = " + angles([&](std::size_t v) { return sensor.vaa_deg(v); }) + "\n";
  }
  return out;
}

std::string envi_path(const Simulation& simulation, std::size_t sensor, const std::string& prefix,
                      bool standard_errors) {
  return prefix + (prefix.ends_with('/') ? "" : "_") + sensor_identifier(simulation, sensor) +
         (standard_errors ? "_se" : "") + ".img";
}

std::string envi_header_path(const std::string& image_path) {
  return image_path.substr(0, image_path.size() - 4) + ".hdr";
}

}  // namespace bpms
