// The directional-hemispherical reflectance (DHR) from BRF by views: DHR = mean of BRF over cos^2(vza) and
// azimuth, both uniform. Views are drawn within strata, so the mean has no error of quadrature; its standard
// error comes from independent drawings.
#pragma once
#include "tests/simulate/scene_text.h"
#include "tests/simulate/spread.h"

namespace bpms::test {

// Of a scene with a sun and without a sensor. Views beyond 89 degrees (3e-4 of the mean) are seen at 89.
Mean dhr(const TemporaryFolder& folder, SceneText scene);

}  // namespace bpms::test
