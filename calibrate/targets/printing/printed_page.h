// A target on a sheet of paper, in millimetres from the sheet's upper left corner: the board, a bar of 100 mm
// along each axis to measure what the printer made of it, and a line of text. Bars and text keep out of the
// white that the board needs around it.
#pragma once
#include <string>
#include <vector>

#include "calibrate/targets/drawing.h"

namespace bpms {

constexpr double check_bar_mm = 100;

struct PrintedPage {
  struct Text {
    double x = 0, y = 0;  // where the base line begins
    double size = 3;
    std::string text;  // ASCII
  };
  std::string paper;  // "A4"; empty: of its own size
  double width = 0, height = 0;
  std::vector<Drawing::Rectangle> black;
  std::vector<Drawing::Disc> discs;
  std::vector<Text> texts;
  Eigen::Vector2d origin = Eigen::Vector2d::Zero();  // of the board's frame
};

std::vector<std::string> paper_names();
// `paper` as "A4", "A4 landscape", or empty: the smallest on which the board fits, else a sheet as large as
// it takes. bad_input when the board does not fit on the paper asked for.
PrintedPage lay_out(const Drawing& drawing, const std::string& paper);

std::string pdf_of(const PrintedPage& page);  // PDF 1.4
std::string svg_of(const PrintedPage& page);

}  // namespace bpms
