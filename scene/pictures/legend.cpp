#include "scene/pictures/legend.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace bpms {
namespace {

constexpr double cap_px = 10, title_cap_px = 11;
constexpr int row_px = 22, swatch_px = 14, gap_px = 10, pad_px = 16, title_px = 30, bar_width_px = 20;
constexpr int bar_steps = 5;
constexpr Rgb legend_ink{36, 41, 47};

}  // namespace

std::vector<std::string> tick_labels(double low, double high, int count) {
  std::vector<std::string> out;
  constexpr int most_digits = 9;
  for (int digits = 3; digits <= most_digits; ++digits) {
    out.clear();
    for (int k = 0; k < count; ++k)
      out.push_back(fmt::format("{:.{}g}", low + (high - low) * k / (count - 1), digits));
    if (std::set<std::string>(out.begin(), out.end()).size() == out.size()) break;
  }
  return out;
}

Legend::Legend(const Colouring& colouring, int picture_height) : colouring_(colouring) {
  double text = 0;
  if (colouring.is_scale) {
    ticks_ = colouring.high > colouring.low ? tick_labels(colouring.low, colouring.high, bar_steps)
                                            : std::vector{fmt::format("{:.4g}", colouring.low)};
    std::reverse(ticks_.begin(), ticks_.end());
    for (const std::string& tick : ticks_) text = std::max(text, text_width(tick, cap_px));
    bar_height_ = std::clamp(picture_height / 2, 60, 320);
    if (colouring.some_without_value) text = std::max(text, text_width("no value", cap_px));
  } else {
    entries_ = colouring.entries;
    const auto room =
        static_cast<std::size_t>(std::max(2, (picture_height - 2 * title_px - row_px) / row_px));
    if (entries_.size() > room) {
      const std::size_t more = entries_.size() - room + 1;
      entries_.resize(room - 1);
      entries_.push_back({fmt::format("and {} more", more), {255, 255, 255}});
    }
    for (const auto& entry : entries_) text = std::max(text, text_width(entry.label, cap_px));
  }
  const double wide =
      std::max(text + gap_px + std::max(swatch_px, bar_width_px), text_width(colouring.title, title_cap_px));
  width_ = static_cast<int>(std::ceil(wide)) + 2 * pad_px;
}

void Legend::draw(int left, int top, Canvas& canvas) const {
  const double x = left + pad_px;
  double y = top + title_cap_px;
  canvas.text(colouring_.title, {x, y}, title_cap_px, legend_ink);
  y += title_px - title_cap_px + 2;
  const auto swatch = [&](const Rgb& colour, const std::string& label) {
    canvas.rectangle(x, y, x + swatch_px, y + swatch_px, colour);
    canvas.text(label, {x + swatch_px + gap_px, y + 0.5 * (swatch_px + cap_px)}, cap_px, legend_ink);
    y += row_px;
  };
  if (!colouring_.is_scale) {
    for (const auto& entry : entries_) swatch(entry.colour, entry.label);
    return;
  }
  for (int k = 0; k < bar_height_; ++k)
    canvas.rectangle(x, y + k, x + bar_width_px, y + k + 1,
                     scale_colour(ticks_.size() > 1 ? 1 - (k + 0.5) / bar_height_ : 0.5));
  for (std::size_t k = 0; k < ticks_.size(); ++k) {
    const double place =
        ticks_.size() > 1 ? static_cast<double>(k) / static_cast<double>(ticks_.size() - 1) : 0.5;
    const double at = y + place * bar_height_;
    canvas.rectangle(x + bar_width_px, at - 0.5, x + bar_width_px + 4, at + 0.5, legend_ink);
    canvas.text(ticks_[k], {x + bar_width_px + gap_px, at + 0.5 * cap_px}, cap_px, legend_ink);
  }
  y += bar_height_ + row_px;
  if (colouring_.some_without_value) swatch(no_value_colour, "no value");
}

}  // namespace bpms
