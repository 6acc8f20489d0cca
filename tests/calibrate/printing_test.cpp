// What is printed is what is calibrated with: sheets rasterised by other programs, found by the detectors and
// compared with the coordinates beside them.
#include "calibrate/targets/printing/printed_page.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "calibrate/targets/target_kind.h"
#include "tests/data.h"

namespace bpms {
namespace {

bool have_program(const std::string& name) {
  return std::system(("command -v " + name + " > /dev/null").c_str()) == 0;
}

struct Sheet {
  const char *name, *spec, *paper;
  const char* program;  // rasterises it
};
void PrintTo(const Sheet& s, std::ostream* out) {
  *out << s.spec << " by " << s.program;
}

class Printed : public ::testing::TestWithParam<Sheet> {};
TEST_P(Printed, PointsLieWhereTheBoardsFileHasThem) {
  const bool pdf = std::string(GetParam().program) == "pdftocairo";
  if (!have_program(GetParam().program)) {
    if (test::data_required()) FAIL() << "required program is absent: " << GetParam().program;
    GTEST_SKIP() << "needs " << GetParam().program << " (scripts/setup --test)";
  }
  const test::TemporaryFolder folder;
  const Target target = parse_target(GetParam().spec);
  const PrintedPage page = lay_out(draw_target(target), GetParam().paper);
  // Rasterised finely, then seen by a camera of 150 pixels an inch with a blur of 0.7 px: the edges that the
  // programs draw are rounded to a fraction of their own pixels.
  constexpr int fine = 4, fine_dpi = 600;
  constexpr double dpi = static_cast<double>(fine_dpi) / fine;
  const std::string sheet = folder.write(pdf ? "b.pdf" : "b.svg", pdf ? pdf_of(page) : svg_of(page));
  const std::string command =
      pdf ? fmt::format("pdftocairo -r {} -png -singlefile {} {}", fine_dpi, sheet, folder / "b")
          : fmt::format("rsvg-convert -d {0} -p {0} -f png -o {1} {2}", fine_dpi, folder / "b.png", sheet);
  ASSERT_EQ(std::system(command.c_str()), 0);
  const cv::Mat sharp = cv::imread(folder / "b.png", cv::IMREAD_GRAYSCALE);
  ASSERT_FALSE(sharp.empty());
  EXPECT_NEAR(sharp.cols, page.width * fine_dpi / 25.4, 1);
  EXPECT_NEAR(sharp.rows, page.height * fine_dpi / 25.4, 1);
  constexpr double blur_px = 0.7;
  cv::Mat blurred, picture;
  cv::GaussianBlur(sharp, blurred, cv::Size(), fine * blur_px);
  const cv::Size size(sharp.cols / fine, sharp.rows / fine);
  cv::resize(blurred(cv::Rect(0, 0, fine * size.width, fine * size.height)), picture, size, 0, 0,
             cv::INTER_AREA);

  Detection found = detect_target(picture, target);
  ASSERT_EQ(found.corners.size(), static_cast<std::size_t>(target.size())) << found.trouble;
  const std::vector<Eigen::Vector3d> points =
      parse_board("b.toml", board_toml(target)).points_m();  // as they are written
  // libapriltag's corners are off by up to 0.3 px where edges run along rows of pixels, but alike on all four
  // sides of a tag: of tags the middles are compared.
  const std::size_t together = target.kind == "apriltag" ? 4 : 1;
  double worst = 0;
  for (std::size_t i = 0; i < found.corners.size(); i += together) {
    Eigen::Vector2d off = Eigen::Vector2d::Zero();
    for (std::size_t k = i; k < i + together; ++k) {
      const ImageCorner& corner = found.corners[k];
      const Eigen::Vector2d mm =
          page.origin + 1000 * points[static_cast<std::size_t>(corner.point)].head<2>();
      const Eigen::Vector2d each = corner.pixel - (mm * dpi / 25.4 - Eigen::Vector2d(0.5, 0.5));
      EXPECT_LT(each.norm(), 0.4);
      off += each / static_cast<double>(together);
    }
    worst = std::max(worst, off.norm());
  }
  fmt::print("{} by {}: worst {:.4f} px\n", GetParam().spec, GetParam().program, worst);
  EXPECT_LT(worst, 0.05);
}
INSTANTIATE_TEST_SUITE_P(
    Kinds, Printed,
    ::testing::Values(Sheet{"ChessboardPdf", "chessboard:9x6:20mm", "", "pdftocairo"},
                      Sheet{"ChessboardSvg", "chessboard:9x6:20mm", "", "rsvg-convert"},
                      Sheet{"CharucoPdf", "charuco:7x5:30mm:22mm:DICT_4X4_50", "", "pdftocairo"},
                      Sheet{"CharucoSvg", "charuco:7x5:30mm:22mm:DICT_4X4_50", "A3", "rsvg-convert"},
                      Sheet{"ApriltagPdf", "apriltag:4x3:40mm:10mm", "", "pdftocairo"},
                      Sheet{"ApriltagSvg", "apriltag:4x3:40mm:10mm:50", "", "rsvg-convert"},
                      Sheet{"CirclesPdf", "circles:7x6:25mm:15mm", "", "pdftocairo"},
                      Sheet{"AsymmetricSvg", "asymmetric_circles:4x11:16mm:12mm", "", "rsvg-convert"}),
    [](const ::testing::TestParamInfo<Sheet>& one) { return std::string(one.param.name); });

TEST(PrintedPage, KeepsBarsAndTextOutOfTheWhiteAroundTheBoard) {
  for (const char* spec :
       {"chessboard:9x6:25mm", "charuco:5x4:10mm:7mm:DICT_4X4_50", "apriltag:1x1:15mm:3mm"}) {
    const Drawing drawing = draw_target(parse_target(spec));
    const PrintedPage page = lay_out(drawing, "");
    const Eigen::Vector2d low = page.origin + 1000 * drawing.quiet_low,
                          high = page.origin + 1000 * drawing.quiet_high;
    const std::size_t of_board = drawing.black.size();
    int long_bars = 0;
    for (std::size_t i = of_board; i < page.black.size(); ++i) {
      const auto& [x, y, w, h] = page.black[i];
      EXPECT_TRUE(x + w <= low.x() || x >= high.x() || y + h <= low.y() || y >= high.y())
          << spec << " bar " << i;
      EXPECT_TRUE(x >= 5 && y >= 5 && x + w <= page.width - 5 && y + h <= page.height - 5)
          << spec << " bar " << i;
      long_bars += w == check_bar_mm || h == check_bar_mm;
    }
    EXPECT_EQ(long_bars, 2);
    for (const auto& text : page.texts) EXPECT_GT(text.y - text.size, high.y());
    for (std::size_t i = 0; i < of_board; ++i) {  // a board ends before its white does
      EXPECT_GT(page.black[i].x, low.x());
      EXPECT_LT(page.black[i].y + page.black[i].height, high.y());
    }
  }
}

TEST(PrintedPage, SaysWhenThePaperIsTooSmallOrUnknown) {
  const Drawing drawing = draw_target(parse_target("chessboard:9x6:45mm"));
  BPMS_EXPECT_ERROR(lay_out(drawing, "A4"), ErrorKind::bad_input, "the board with its bars needs");
  BPMS_EXPECT_ERROR(lay_out(drawing, "A33"), ErrorKind::bad_input, "no paper 'A33'");
  EXPECT_EQ(lay_out(drawing, "A2 landscape").paper, "A2 landscape");
  EXPECT_EQ(lay_out(drawing, "").paper, "A2 landscape");
  EXPECT_GT(lay_out(draw_target(parse_target("chessboard:9x6:300mm")), "").width, 3000);
}

}  // namespace
}  // namespace bpms
