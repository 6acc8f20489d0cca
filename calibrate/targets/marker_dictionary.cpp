#include "calibrate/targets/marker_dictionary.h"

#include <opencv2/aruco.hpp>
#include <utility>

#include "core/error.h"

namespace bpms {
namespace {

constexpr std::pair<const char*, cv::aruco::PREDEFINED_DICTIONARY_NAME> dictionary_names[] = {
    {"DICT_4X4_50", cv::aruco::DICT_4X4_50},
    {"DICT_4X4_100", cv::aruco::DICT_4X4_100},
    {"DICT_4X4_250", cv::aruco::DICT_4X4_250},
    {"DICT_4X4_1000", cv::aruco::DICT_4X4_1000},
    {"DICT_5X5_50", cv::aruco::DICT_5X5_50},
    {"DICT_5X5_100", cv::aruco::DICT_5X5_100},
    {"DICT_5X5_250", cv::aruco::DICT_5X5_250},
    {"DICT_5X5_1000", cv::aruco::DICT_5X5_1000},
    {"DICT_6X6_50", cv::aruco::DICT_6X6_50},
    {"DICT_6X6_100", cv::aruco::DICT_6X6_100},
    {"DICT_6X6_250", cv::aruco::DICT_6X6_250},
    {"DICT_6X6_1000", cv::aruco::DICT_6X6_1000},
    {"DICT_7X7_50", cv::aruco::DICT_7X7_50},
    {"DICT_7X7_100", cv::aruco::DICT_7X7_100},
    {"DICT_7X7_250", cv::aruco::DICT_7X7_250},
    {"DICT_7X7_1000", cv::aruco::DICT_7X7_1000},
    {"DICT_ARUCO_ORIGINAL", cv::aruco::DICT_ARUCO_ORIGINAL},
    {"DICT_APRILTAG_16h5", cv::aruco::DICT_APRILTAG_16h5},
    {"DICT_APRILTAG_25h9", cv::aruco::DICT_APRILTAG_25h9},
    {"DICT_APRILTAG_36h10", cv::aruco::DICT_APRILTAG_36h10},
    {"DICT_APRILTAG_36h11", cv::aruco::DICT_APRILTAG_36h11},
};

cv::Ptr<cv::aruco::Dictionary> open_dictionary(const std::string& name) {
  for (const auto& [known, code] : dictionary_names) {
    if (name == known) return cv::aruco::getPredefinedDictionary(code);
  }
  bad_input({}, "no dictionary of markers {}", in_quotes(name));
}

}  // namespace

std::vector<std::string> marker_dictionaries() {
  std::vector<std::string> out;
  for (const auto& [name, code] : dictionary_names) out.emplace_back(name);
  return out;
}

int marker_count(const std::string& dictionary) {
  return open_dictionary(dictionary)->bytesList.rows;
}

int marker_bits(const std::string& dictionary) {
  return open_dictionary(dictionary)->markerSize + 2;
}

std::vector<std::vector<bool>> marker_pattern(const std::string& dictionary, int id) {
  const int bits = marker_bits(dictionary);
  cv::Mat image;
  open_dictionary(dictionary)->drawMarker(id, bits, image, 1);
  std::vector<std::vector<bool>> out;
  for (int row = 0; row < bits; ++row) {
    out.emplace_back();
    for (int column = 0; column < bits; ++column)
      out.back().push_back(image.at<unsigned char>(row, column) == 0);
  }
  return out;
}

std::vector<SeenMarker> find_markers(const cv::Mat& grey, const std::string& dictionary) {
  std::vector<std::vector<cv::Point2f>> corners;
  std::vector<int> ids;
  cv::aruco::detectMarkers(grey, open_dictionary(dictionary), corners, ids);
  std::vector<SeenMarker> out;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    const auto corner = [&](std::size_t k) { return Eigen::Vector2d(corners[i][k].x, corners[i][k].y); };
    out.push_back({ids[i], {corner(0), corner(1), corner(2), corner(3)}});
  }
  return out;
}

}  // namespace bpms
