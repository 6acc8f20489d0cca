#include "scene/pictures/picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scene/pictures/legend.h"
#include "scene/pictures/shaded.h"

namespace bpms {
namespace {

constexpr int margin_px = 18, label_px = 30, bar_px = 44;
constexpr double small_cap_px = 11, bar_thick_px = 4;
constexpr Rgb picture_ink{36, 41, 47};

// Panels share the width that the legend leaves.
std::vector<PicturePanel> lay_out(const PictureOptions& options, int width, int height, int legend_px) {
  std::vector<PicturePanel> out;
  const auto count = static_cast<int>(options.views.size());
  const int each = (width - legend_px) / count;
  const bool labelled = options.labels && count > 1;
  for (int k = 0; k < count; ++k) {
    PicturePanel panel;
    panel.view = options.views[static_cast<std::size_t>(k)];
    panel.left = k * each + margin_px;
    panel.top = margin_px + (labelled ? label_px : 0);
    panel.width = each - 2 * margin_px;
    panel.height = height - panel.top - margin_px - (options.scale_bar ? bar_px : 0);
    out.push_back(panel);
  }
  constexpr int least_px = 16;
  if (out[0].width < least_px || out[0].height < least_px)
    bad_input({"--size"}, "{}x{} pixels leave no room for {} view{} and what stands beside", width, height,
              count, count > 1 ? "s" : "");
  return out;
}

void draw_bar(const PictureOptions& options, PicturePanel& panel, Canvas& canvas) {
  constexpr double most_of_panel = 0.35;
  panel.bar_m = nice_below(most_of_panel * panel.width * panel.metres_per_pixel);
  panel.bar_left = panel.left;
  panel.bar_top = panel.top + panel.height + margin_px;
  const double length = panel.bar_m / panel.metres_per_pixel;
  canvas.rectangle(panel.bar_left, panel.bar_top, panel.bar_left + length, panel.bar_top + bar_thick_px,
                   picture_ink);
  std::string text = length_in_words(panel.bar_m);
  if (options.fov_deg > 0) text += " in the middle";
  canvas.text(text, {panel.bar_left, panel.bar_top + bar_thick_px + 8 + small_cap_px}, small_cap_px,
              picture_ink);
}

}  // namespace

double nice_below(double value) {
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  for (const double step : {5.0, 2.0})
    if (step * power <= value * (1 + 1e-12)) return step * power;
  return power;
}

std::string length_in_words(double metres) {
  constexpr double kilometre = 1000, centimetre = 0.01, millimetre = 0.001, micrometre = 1e-6;
  if (metres >= kilometre) return fmt::format("{:.6g} km", metres / kilometre);
  if (metres >= 1) return fmt::format("{:.6g} m", metres);
  if (metres >= centimetre) return fmt::format("{:.6g} cm", metres / centimetre);
  if (metres >= millimetre) return fmt::format("{:.6g} mm", metres / millimetre);
  return fmt::format("{:.6g} \u00b5m", metres / micrometre);
}

Picture draw_picture(const Scene& scene, const PictureOptions& options) {
  constexpr int one_width = 1200, one_height = 900, panel_width = 500, panel_height = 640;
  const auto count = static_cast<int>(options.views.size());
  const int width = options.width > 0 ? options.width : count > 1 ? count * panel_width : one_width;
  const int height = options.height > 0 ? options.height : count > 1 ? panel_height : one_height;

  std::vector<PictureParts> parts;
  for (const Prototype& prototype : scene.prototypes) parts.push_back(picture_parts(scene, prototype));
  Picture out;
  out.colouring = make_colouring(scene, parts, options.colour);
  const Legend legend(out.colouring, height);
  out.panels = lay_out(options, width, height, options.legend ? legend.width() : 0);

  std::vector<PictureCamera> cameras;
  double scale = 0;
  for (const PicturePanel& panel : out.panels) {
    cameras.push_back(fit_camera(scene, panel.view, panel.width, panel.height, options.fov_deg));
    scale = std::max(scale, cameras.back().metres_per_pixel);
  }
  Canvas canvas(width, height);
  if (!options.transparent) canvas.fill({255, 255, 255});
  const Intersector intersector(scene);
  for (std::size_t k = 0; k < cameras.size(); ++k) {
    PicturePanel& panel = out.panels[k];
    if (!(options.fov_deg > 0)) cameras[k].metres_per_pixel = scale;
    panel.metres_per_pixel = cameras[k].metres_per_pixel;
    draw_shaded({scene, intersector, parts, out.colouring}, cameras[k], options.samples, panel.left,
                panel.top, canvas);
    if (options.labels && count > 1)
      canvas.text(panel.view.name, {panel.left, margin_px + small_cap_px + 2}, small_cap_px + 2, picture_ink);
    if (options.scale_bar) draw_bar(options, panel, canvas);
  }
  if (options.legend) legend.draw(width - legend.width(), margin_px, canvas);
  out.image = canvas.image();
  return out;
}

}  // namespace bpms
