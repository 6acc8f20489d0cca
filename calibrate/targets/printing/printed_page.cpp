#include "calibrate/targets/printing/printed_page.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/nearest.h"

namespace bpms {
namespace {

struct Paper {
  const char* name;
  double width, height;
};
constexpr Paper papers[] = {{"A4", 210, 297}, {"letter", 215.9, 279.4}, {"A3", 297, 420},
                            {"A2", 420, 594}, {"A1", 594, 841},         {"A0", 841, 1189}};

constexpr double margin = 8;       // where printers do not print
constexpr double bar_strip = 9;    // for the upright bar, left of the board
constexpr double foot_strip = 18;  // for the lying bar and the text, below it
constexpr double line_width = 0.3, tick = 3;
constexpr const char* landscape = " landscape";

Eigen::Vector2d least_sheet(const Eigen::Vector2d& board) {
  return (board + Eigen::Vector2d(bar_strip, foot_strip))
             .cwiseMax(Eigen::Vector2d(bar_strip + check_bar_mm, foot_strip + check_bar_mm)) +
         Eigen::Vector2d::Constant(2 * margin);
}

Paper turned(const Paper& paper) {
  return {paper.name, paper.height, paper.width};
}

PrintedPage sheet(const Eigen::Vector2d& least, const std::string& wanted) {
  const auto holds = [&](const Paper& p) { return p.width >= least.x() && p.height >= least.y(); };
  PrintedPage out;
  const auto take = [&](const Paper& p, bool lying) {
    out.paper = std::string(p.name) + (lying ? landscape : "");
    out.width = p.width;
    out.height = p.height;
    return out;
  };
  const bool lying_wanted = wanted.ends_with(landscape);
  const std::string name = wanted.substr(0, wanted.find(' '));
  for (const Paper& paper : papers) {
    if (!wanted.empty() && name != paper.name) continue;
    if (wanted.empty() && name != paper.name && std::string(paper.name) == "letter") continue;
    if (!lying_wanted && holds(paper)) return take(paper, false);
    if (holds(turned(paper))) return take(turned(paper), true);
    if (!wanted.empty())
      bad_input({}, "the board with its bars needs {:.0f} x {:.0f} mm; {} has {} x {} mm", least.x(),
                least.y(), wanted, paper.width, paper.height);
  }
  if (!wanted.empty()) bad_input({}, "no paper {}{}", in_quotes(wanted), did_you_mean(wanted, paper_names()));
  out.width = std::ceil(least.x());
  out.height = std::ceil(least.y());
  constexpr double largest_pdf = 200 * 25.4;  // Acrobat's limit for a page
  if (std::max(out.width, out.height) > largest_pdf)
    bad_input({}, "the board with its bars needs {:.0f} x {:.0f} mm; a page ends at {:.0f} mm", out.width,
              out.height, largest_pdf);
  return out;
}

void add_bars(PrintedPage& page) {
  const double x0 = margin + bar_strip, y0 = page.height - margin - tick;
  page.black.push_back({x0, y0 - line_width / 2, check_bar_mm, line_width});
  const double x1 = margin + tick / 2, y1 = margin;
  page.black.push_back({x1 - line_width / 2, y1, line_width, check_bar_mm});
  // Ticks outside the bar's length: it is measured between their inner edges.
  for (const double end : {-line_width, check_bar_mm}) {
    page.black.push_back({x0 + end, y0 - tick / 2, line_width, tick});
    page.black.push_back({x1 - tick / 2, y1 + end, tick, line_width});
  }
}

}  // namespace

std::vector<std::string> paper_names() {
  std::vector<std::string> out;
  for (const Paper& paper : papers) {
    out.emplace_back(paper.name);
    out.push_back(std::string(paper.name) + landscape);
  }
  return out;
}

PrintedPage lay_out(const Drawing& drawing, const std::string& paper) {
  constexpr double mm = 1000;
  const Eigen::Vector2d low = mm * drawing.quiet_low, board = mm * drawing.quiet_high - low;
  PrintedPage out = sheet(least_sheet(board), paper);
  const Eigen::Vector2d room(out.width - 2 * margin - bar_strip, out.height - 2 * margin - foot_strip);
  out.origin = Eigen::Vector2d(margin + bar_strip, margin) + (room - board) / 2 - low;
  for (const auto& [x, y, w, h] : drawing.black)
    out.black.push_back({out.origin.x() + mm * x, out.origin.y() + mm * y, mm * w, mm * h});
  for (const Drawing::Disc& disc : drawing.discs)
    out.discs.push_back({out.origin.x() + mm * disc.x, out.origin.y() + mm * disc.y, mm * disc.radius});
  add_bars(out);
  constexpr double text_mm = 2.6;
  const double x = margin + bar_strip, y = out.height - margin - 3 * tick;
  out.texts.push_back({x, y, text_mm, drawing.caption});
  out.texts.push_back({x, y + text_mm + 1, text_mm,
                       "Print at 100 %. Both bars are 100 mm between their ticks: measure them, "
                       "then --measured-bar X Y."});
  return out;
}

}  // namespace bpms
