// The stereo solve against OpenCV's on the same corners: bench_calibrate [corners.vnl], a 9x6 board of 25 mm
// in 640x480 images; without a file, 13 synthetic pairs. Ours: initial estimate, robust search for outliers,
// least squares with the board's bending, iid covariance; and, listed by itself, the uncertainty by frame.
// OpenCV's: calibrateCamera of both cameras, then stereoCalibrate of everything (flat board, no covariance,
// no search for outliers).
#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <opencv2/calib3d.hpp>
#include <vector>

#include "calibrate/adjustment/synthetic.h"
#include "calibrate/calibrate.h"

namespace {

using namespace bpms;

struct Outcome {
  double seconds = HUGE_VAL;  // least of the repetitions: load only adds
  double baseline_mm = 0;
  double rms_px = 0;  // per axis
};

struct OpenCvInput {
  std::vector<std::vector<cv::Point3f>> board;
  std::vector<std::vector<cv::Point2f>> left, right;
};

OpenCvInput opencv_input(const Observations& observations, const Target& target) {
  std::vector<cv::Point3f> board;
  for (const Eigen::Vector3d& x : target.points_m())
    board.emplace_back(static_cast<float>(x.x()), static_cast<float>(x.y()), 0.0F);
  std::map<std::string, std::array<std::vector<cv::Point2f>, 2>> frames;
  for (const BoardView& view : observations.views) {
    auto& corners = frames[view.frame].at(static_cast<std::size_t>(view.camera));
    for (const ImageCorner& corner : view.corners)
      corners.emplace_back(static_cast<float>(corner.pixel.x()), static_cast<float>(corner.pixel.y()));
  }
  OpenCvInput out;
  for (const auto& [frame, corners] : frames) {
    if (corners[0].size() != board.size() || corners[1].size() != board.size()) continue;
    out.board.push_back(board);
    out.left.push_back(corners[0]);
    out.right.push_back(corners[1]);
  }
  return out;
}

void solve_opencv(const OpenCvInput& input, Outcome& out) {
  const auto start = std::chrono::steady_clock::now();
  const cv::Size size(640, 480);
  const cv::TermCriteria precise(cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 1000, 1e-12);
  cv::Mat k1, d1, k2, d2, r, t, e, f;
  std::vector<cv::Mat> rotations, translations;
  cv::calibrateCamera(input.board, input.left, size, k1, d1, rotations, translations, cv::CALIB_FIX_K3,
                      precise);
  cv::calibrateCamera(input.board, input.right, size, k2, d2, rotations, translations, cv::CALIB_FIX_K3,
                      precise);
  const double rms = cv::stereoCalibrate(input.board, input.left, input.right, k1, d1, k2, d2, size, r, t, e,
                                         f, cv::CALIB_USE_INTRINSIC_GUESS | cv::CALIB_FIX_K3, precise);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  out = {std::min(out.seconds, seconds), 1e3 * cv::norm(t), rms / std::sqrt(2.0)};
}

}  // namespace

int main(int argc, char** argv) {
  try {
    Target target = parse_target("chessboard:9x6:25mm");
    const Observations observations = argc > 1 ? read_corners(argv[1], 640, 480, target.size())
                                               : observe(synthetic_calibration({}), 0.15, 1);
    const OpenCvInput input = opencv_input(observations, target);
    Outcome ours, opencv;
    double uncertainty = HUGE_VAL;
    constexpr int repetitions = 7;
    for (int i = 0; i < repetitions; ++i) {
      const Calibration c = calibrate(observations, target);
      ours = {std::min(ours.seconds, c.solve_seconds), 1e3 * c.pairs.at(0).baseline_m, c.residual_rms_px};
      uncertainty = std::min(uncertainty, c.uncertainty_seconds);
      solve_opencv(input, opencv);
    }
    fmt::print("{:8} {:>9} {:>12} {:>8}\n", "", "solve s", "baseline mm", "rms px");
    fmt::print("{:8} {:9.3f} {:12.3f} {:8.4f}\n", "bpms", ours.seconds, ours.baseline_mm, ours.rms_px);
    fmt::print("{:8} {:9.3f} {:12.3f} {:8.4f}\n", "opencv", opencv.seconds, opencv.baseline_mm,
               opencv.rms_px);
    fmt::print("bpms takes {:.2f} of OpenCV's time; uncertainty by frame and half sets {:.3f} s more\n",
               ours.seconds / opencv.seconds, uncertainty);
  } catch (const std::exception& error) {
    fmt::print(stderr, "error: {}\n", error.what());
    return 1;
  }
  return 0;
}
