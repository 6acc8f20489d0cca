// Files of COLMAP name cameras, images and points by ids; structs hold indices. This joins a model whose
// parts were read with ids, and refuses ids that lead nowhere.
#pragma once
#include <cstdint>
#include <vector>

#include "calibrate/exchange/colmap_model.h"

namespace bpms {

inline constexpr std::uint64_t no_colmap_point = ~std::uint64_t{0};

struct ColmapParts {
  struct CameraPart {
    std::uint32_t id = 0;
    Camera camera;
    SourceLocation where;
  };
  struct ImagePart {
    ColmapImage image;  // its `camera` and `points` are not set
    std::uint32_t camera_id = 0;
    std::vector<std::uint64_t> point_ids;  // of each keypoint
    SourceLocation where;
  };
  struct PointPart {
    ColmapPoint point;  // its track is not set
    struct Sight {
      std::uint32_t image_id = 0, keypoint = 0;
    };
    std::vector<Sight> track;
    SourceLocation where;
  };
  std::vector<CameraPart> cameras;
  std::vector<ImagePart> images;
  std::vector<PointPart> points;
};

ColmapModel join_colmap(ColmapParts parts);

}  // namespace bpms
