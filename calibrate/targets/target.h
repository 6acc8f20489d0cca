// Calibration targets: known points on a board or in space. One file a kind in this folder, and one line in
// target_kind.cpp. Frame of a board: x along a row, y down the columns, z away from a viewer who faces the
// board; the first point is the origin. Metres.
#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

namespace bpms {

// A length between two points of a target that was measured by itself.
struct ScaleBar {
  int a = 0, b = 0;  // points
  double length_m = 0, sigma_m = 0;
};

// An AprilTag (36h11) of a control frame. Frame of a tag: its centre, x right, y down as the tag is read,
// z into the surface that it is glued to. size_m is the outside edge of the black border.
struct TargetTag {
  int id = 0;
  double size_m = 0;
  Eigen::Matrix3d r_target_from_tag = Eigen::Matrix3d::Identity();
  Eigen::Vector3d centre_m = Eigen::Vector3d::Zero();
};

// A surveyed point that no detector finds: it is digitised in the images.
struct ControlPoint {
  std::string name;
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();
};

struct Target {
  std::string name = {};  // tells targets apart where there are several
  std::string kind = "chessboard";
  int columns = 0;  // inner corners of a chessboard, squares of a ChArUco board, tags, circles in a row
  int rows = 0;
  double square_m = 0;  // a square's side; of a board of circles their pitch
  bool stands = false;  // in one place in all frames (a control frame, a wall), or held anew in each
  // Of each point, in the target's frame; empty: the points are exact.
  std::vector<Eigen::Matrix3d> covariance_m2 = {};
  std::vector<ScaleBar> scale_bars = {};

  double mark_m = 0;            // side of a ChArUco marker or of a tag on a board, diameter of a circle
  double gap_m = 0;             // between the black borders of the tags on a board
  int first_id = 0;             // of a board's markers or tags
  std::string dictionary = {};  // of a ChArUco board's markers, as OpenCV names it
  // ChArUco as OpenCV before 4.7 drew it on an even number of rows: the upper left square is white.
  bool first_square_white = false;
  std::vector<TargetTag> tags = {};  // of a control frame
  std::vector<ControlPoint> control_points = {};
  // Where the points of a board were measured to be; empty: as it was designed.
  std::vector<Eigen::Vector3d> measured_m = {};

  int size() const;
  std::vector<Eigen::Vector3d> points_m() const;  // in the order of its kind; row by row on a grid
  // (1 - x^2, 1 - y^2) of each point of a flat board with x, y in [-1, 1] over the board: the shape of its
  // two bending terms. Zeros on what is no flat board.
  std::vector<Eigen::Vector2d> bending() const;
  std::string point_name(int point) const;  // "3.1": corner 1 of tag 3; the name of a control point; "17"
};

// "chessboard:9x6:25mm" and so on, or the path of a board.toml, a control_frame.toml or a board in YAML of
// other programs.
Target parse_target(const std::string& text);
bool is_target_file(const std::string& text);
// Several at once: names are made different; bad_input where two could be taken for each other in an image.
std::vector<Target> parse_targets(const std::vector<std::string>& texts);
Target read_board(const std::string& path);
Target parse_board(const std::string& path, std::string_view text);
std::string board_toml(const Target& target);

}  // namespace bpms
