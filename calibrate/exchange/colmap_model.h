// A reconstruction in COLMAP's form: cameras, images with poses and keypoints, points with their tracks.
// Read from a folder with cameras, images and points3D, as .bin or .txt; written as .txt. COLMAP puts the
// centre of the first pixel at (0.5, 0.5): principal points and keypoints are shifted by half a pixel here,
// so that in these structs pixel centres are integers. X_cam = R X_world + t, x right, y down, z forward. The
// unit of the world is the maker's: COLMAP's own models have no scale.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "calibrate/pose.h"
#include "calibrate/rig.h"

namespace bpms {

struct ColmapImage {
  std::uint32_t id = 0;  // in the file
  std::string name;
  Pose cam_from_world;
  int camera = 0;  // index into ColmapModel::cameras
  std::vector<Eigen::Vector2d> keypoints_px;
  std::vector<int> points;  // of each keypoint: index into ColmapModel::points, or -1
};

struct ColmapPoint {
  std::uint64_t id = 0;
  Eigen::Vector3d x_world = Eigen::Vector3d::Zero();
  std::uint8_t red = 0, green = 0, blue = 0;
  double error_px = -1;  // mean reprojection error; -1: not known
  struct Sighting {
    int image = 0, keypoint = 0;  // indices
  };
  std::vector<Sighting> track;
};

struct ColmapModel {
  std::vector<Camera> cameras;  // their poses are not used; named by their id, "7"
  std::vector<ColmapImage> images;
  std::vector<ColmapPoint> points;

  int find_image(const std::string& name) const;  // index, or -1
};

// What the three files hold, and what they are called in messages.
struct ColmapFiles {
  std::string cameras_path, cameras, images_path, images, points_path, points;
};
ColmapModel parse_colmap_text(const ColmapFiles& files);
ColmapModel parse_colmap_binary(const ColmapFiles& files);

// Of a folder; .bin where both kinds are there, as COLMAP itself does.
ColmapModel read_colmap_model(const std::string& folder);
// cameras.txt, images.txt, points3D.txt, the names in `..._path` below `folder`. Ids are those of the model
// where they are all different and not 0, else counted from 1. bad_input for a lens that COLMAP does not
// have.
ColmapFiles colmap_text(const ColmapModel& model, const std::string& folder);
void write_colmap_model(const ColmapModel& model, const std::string& folder, bool overwrite);

}  // namespace bpms
