// Lists of discs read back as they were written.
#include "scene/importers/disc_list.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace bpms {
namespace {

RC_GTEST_PROP(DiscLists, ReadBackAsTheyWereWritten, ()) {
  std::vector<Disc> discs;
  const int count = *rc::gen::inRange(1, 20);
  const auto number = [] { return static_cast<float>(*rc::gen::inRange(-1'000'000, 1'000'000)) * 1.37e-5f; };
  for (int i = 0; i < count; ++i) {
    Disc disc;
    for (int k = 0; k < 3; ++k) disc.centre_m[k] = number();
    disc.radius_m = 1e-3f + std::abs(number());
    disc.normal = Eigen::Vector3f(number(), number(), number() + 20).normalized();
    discs.push_back(disc);
  }
  const std::string text = disc_list_text(discs);
  const std::vector<Disc> again = parse_disc_list("discs.def", text);
  RC_ASSERT(again.size() == discs.size());
  for (std::size_t i = 0; i < discs.size(); ++i) {
    RC_ASSERT(again[i].centre_m == discs[i].centre_m);
    RC_ASSERT(again[i].radius_m == discs[i].radius_m);
    RC_ASSERT(again[i].normal == discs[i].normal);
  }
  RC_ASSERT(disc_list_text(again) == text);
}

}  // namespace
}  // namespace bpms
