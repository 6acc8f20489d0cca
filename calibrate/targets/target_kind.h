// What a kind of target answers for: how it is written down, where its points are, how it is found in an
// image and what is printed. A new kind is one file and one line in target_kind.cpp.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "calibrate/observations.h"
#include "calibrate/targets/drawing.h"
#include "calibrate/targets/target.h"
#include "core/toml.h"

namespace cv {
class Mat;
}

namespace bpms {

// What was found of a target in an image.
struct Detection {
  std::vector<ImageCorner> corners;  // in the order of the points; empty: not found
  std::string trouble;               // why nothing was found
  std::vector<std::string> remarks;  // what was left out, and why
  bool found() const { return !corners.empty(); }
};

// The parts of "kind:part:part" on the command line, taken one after the other.
class SpecParts {
 public:
  SpecParts(std::string_view text, std::string_view form);
  std::string_view next(const char* what);  // bad_input when there is none left
  std::pair<int, int> counts(int fewest, int most);
  double length(const char* what, double largest_m);
  bool empty() const { return rest_.empty(); }
  [[noreturn]] void reject(const std::string& message) const;

 private:
  std::string text_;
  std::string_view rest_;
  std::string form_;
};

class TargetKind {
 public:
  virtual ~TargetKind() = default;
  virtual std::string_view name() const = 0;
  // "chessboard:COLUMNSxROWS:SQUARE"; empty: only from a file.
  virtual std::string_view form() const { return {}; }
  virtual std::string_view example() const { return {}; }
  virtual void parse(SpecParts& parts, Target& target) const;
  virtual void read(const TomlValue& root, Target& target) const = 0;  // its own keys
  virtual std::string toml(const Target& target) const = 0;
  // Refuses what cannot be: a message, or nothing.
  virtual std::string nonsense(const Target&) const { return {}; }

  virtual std::vector<Eigen::Vector3d> designed_points_m(const Target& target) const = 0;
  virtual bool flat() const { return true; }
  virtual std::string point_name(const Target& target, int point) const;

  virtual Detection detect(const cv::Mat& grey, const Target& target) const = 0;  // of an 8-bit image
  // Looks the same after half a turn: the points then come in either order.
  virtual bool half_turn_alike(const Target&) const { return false; }
  // What is in both lists is taken for each other ("tag36h11 5").
  virtual std::vector<std::string> looks(const Target& target) const = 0;

  virtual Drawing draw(const Target& target) const;
};

const TargetKind& target_kind(const std::string& name);
std::vector<std::string> target_kind_names();
std::vector<std::string> target_forms();  // of all that can be given on the command line
Detection detect_target(const cv::Mat& grey, const Target& target);
Drawing draw_target(const Target& target);

}  // namespace bpms
