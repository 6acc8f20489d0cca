// One page in SVG, in millimetres. All that is black is one path.
#include <fmt/format.h>

#include "calibrate/targets/printing/printed_page.h"

namespace bpms {

std::string svg_of(const PrintedPage& page) {
  std::string out = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.6g}mm\" height=\"{1:.6g}mm\" "
      "viewBox=\"0 0 {0:.6g} {1:.6g}\">\n<rect width=\"{0:.6g}\" height=\"{1:.6g}\" fill=\"white\"/>\n<path "
      "fill=\"black\" d=\"",
      page.width, page.height);
  for (const auto& [x, y, w, h] : page.black)
    out += fmt::format("M{:.5f} {:.5f}h{:.5f}v{:.5f}h{:.5f}z\n", x, y, w, h, -w);
  for (const auto& [x, y, r] : page.discs)
    out += fmt::format("M{0:.5f} {1:.5f}a{2:.5f} {2:.5f} 0 1 0 {3:.5f} 0a{2:.5f} {2:.5f} 0 1 0 {4:.5f} 0z\n",
                       x - r, y, r, 2 * r, -2 * r);
  out += "\"/>\n";
  for (const auto& [x, y, size, text] : page.texts)
    out += fmt::format(
        "<text x=\"{:.3f}\" y=\"{:.3f}\" font-size=\"{:.3f}\" font-family=\"sans-serif\">{}"
        "</text>\n",
        x, y, size, text);
  return out + "</svg>\n";
}

}  // namespace bpms
