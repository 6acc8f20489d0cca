// One page in PDF 1.4. All that is black is one path, so that neighbouring shapes leave no seam when edges
// are smoothed.
#include <cmath>

#include "calibrate/targets/printing/printed_page.h"
#include "core/units.h"

#include <fmt/format.h>

namespace bpms {
namespace {

constexpr double points_per_mm = 72 / 25.4;

// Eight Bezier curves: 4e-6 of the radius out of round.
std::string pdf_disc(const Drawing::Disc& disc) {
  constexpr int arcs = 8;
  const double handle = 4.0 / 3 * std::tan(2 * pi / arcs / 4) * disc.radius;
  const auto on = [&](int i, double along) {
    const double angle = 2 * pi * i / arcs;
    return fmt::format("{:.5f} {:.5f}", disc.x + disc.radius * std::cos(angle) - along * std::sin(angle),
                       disc.y + disc.radius * std::sin(angle) + along * std::cos(angle));
  };
  std::string out = on(0, 0) + " m\n";
  for (int i = 0; i < arcs; ++i)
    out += on(i, handle) + " " + on(i + 1, -handle) + " " + on(i + 1, 0) + " c\n";
  return out;
}

std::string pdf_string(const std::string& text) {
  std::string out = "(";
  for (const char c : text) {
    if (c == '(' || c == ')' || c == '\\') out += '\\';
    out += c;
  }
  return out + ")";
}

std::string page_content(const PrintedPage& page) {
  // Millimetres, y down.
  std::string out = fmt::format("{:.8f} 0 0 {:.8f} 0 {:.6f} cm\n0 g\n", points_per_mm, -points_per_mm,
                                page.height * points_per_mm);
  for (const auto& [x, y, w, h] : page.black)
    out += fmt::format("{:.5f} {:.5f} {:.5f} {:.5f} re\n", x, y, w, h);
  for (const Drawing::Disc& disc : page.discs) out += pdf_disc(disc);
  out += "f\n";
  for (const auto& [x, y, size, text] : page.texts)
    out += fmt::format("BT /F1 {:.3f} Tf 1 0 0 -1 {:.3f} {:.3f} Tm {} Tj ET\n", size, x, y, pdf_string(text));
  return out;
}

}  // namespace

std::string pdf_of(const PrintedPage& page) {
  const std::string content = page_content(page);
  const std::string objects[] = {
      "<< /Type /Catalog /Pages 2 0 R /ViewerPreferences << /PrintScaling /None >> >>",
      "<< /Type /Pages /Kids [3 0 R] /Count 1 >>",
      fmt::format("<< /Type /Page /Parent 2 0 R /MediaBox [0 0 {:.6f} {:.6f}] /Contents 4 0 R /Resources << "
                  "/Font << /F1 5 0 R >> >> >>",
                  page.width * points_per_mm, page.height * points_per_mm),
      fmt::format("<< /Length {} >>\nstream\n{}endstream", content.size(), content),
      "<< /Type /Font /Subtype /Type1 /BaseFont /Helvetica >>"};
  std::string out = "%PDF-1.4\n", table = "0000000000 65535 f \n";
  int number = 0;
  for (const std::string& object : objects) {
    table += fmt::format("{:010} 00000 n \n", out.size());
    out += fmt::format("{} 0 obj\n{}\nendobj\n", ++number, object);
  }
  const std::size_t start = out.size();
  return out + fmt::format("xref\n0 {0}\n{1}trailer\n<< /Size {0} /Root 1 0 R >>\nstartxref\n{2}\n%%EOF\n",
                           number + 1, table, start);
}

}  // namespace bpms
