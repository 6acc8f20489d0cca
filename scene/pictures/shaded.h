// A view of a scene in the colours of its parts, shaded so that its form is seen: a sun from behind the left
// shoulder with its shadows, and light from the sky as far as the sky is seen. It looks natural and means
// nothing in numbers: `bpms simulate` computes light.
#pragma once
#include "scene/intersect/intersector.h"
#include "scene/pictures/canvas.h"
#include "scene/pictures/colouring.h"
#include "scene/pictures/picture_camera.h"

namespace bpms {

struct ShadedScene {
  const Scene& scene;
  const Intersector& intersector;
  const std::vector<PictureParts>& parts;
  const Colouring& colouring;
};

// Lays the view onto the canvas with its upper left corner at (left, top); `samples` rays a pixel. The same
// on any number of threads.
void draw_shaded(const ShadedScene& of, const PictureCamera& camera, int samples, int left, int top,
                 Canvas& canvas);

}  // namespace bpms
