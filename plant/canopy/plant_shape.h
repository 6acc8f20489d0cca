// A plant's triangles by organ, with spheres around the plant, its organs and runs of its triangles, and
// which triangles of two plants that stand near each other cross.
#pragma once
#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "plant/canopy.h"
#include "plant/geometry/triangle_crossing.h"

namespace bpms {

struct BoundSphere {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  double radius = 0;
  bool meets(const BoundSphere& other) const {
    const double reach = radius + other.radius;
    return (centre - other.centre).squaredNorm() < reach * reach;
  }
};

// Triangles that follow each other on an organ.
struct TriangleRun {
  BoundSphere sphere;
  std::uint32_t first = 0, count = 0;  // of PlantShape::triangles
};
struct OrganShape {
  BoundSphere sphere;
  bool leaf = false;
  std::uint32_t first = 0, count = 0;  // of PlantShape::runs
};

// A plant's triangles by organ, with spheres around organs and runs.
struct PlantShape {
  BoundSphere sphere;
  std::vector<OrganShape> organs;
  std::vector<TriangleRun> runs;
  std::vector<TriangleCorners> triangles;
  std::vector<double> area_m2;
  double leaf_area_m2 = 0;
};

PlantShape plant_shape(const Mesh& mesh);

// A plant's shape where it stands.
struct PlacedShape {
  const PlantShape* shape = nullptr;
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();  // scale included
  double scale = 1;
  Eigen::Vector3d at = Eigen::Vector3d::Zero();

  PlacedShape(const PlantShape& of, const Placement& p) : shape(&of), scale(p.scale), at(p.position_m) {
    turn = p.scale * (Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), p.up.cast<double>()) *
                      Eigen::AngleAxisd(p.rotation, Eigen::Vector3d::UnitZ()))
                         .toRotationMatrix();
  }
  BoundSphere sphere(const BoundSphere& own) const { return {turn * own.centre + at, scale * own.radius}; }
  TriangleCorners triangle(std::size_t t) const {
    const TriangleCorners& own = shape->triangles[t];
    return {turn * own[0] + at, turn * own[1] + at, turn * own[2] + at};
  }
};

// Marks the triangles of each that cross the other's, leaves against anything; the lists hold one entry a
// triangle.
void mark_crossing(const PlacedShape& a, const PlacedShape& b, std::vector<char>& of_a,
                   std::vector<char>& of_b);
double marked_leaf_area_m2(const PlacedShape& of, const std::vector<char>& marked);

}  // namespace bpms
