// [[plants]] of which each stands once, with its own geometry, in the order of their files or shuffled.
#include <numeric>

#include "plant/canopy/plant_files.h"
#include "plant/canopy/plant_sources.h"

namespace bpms {
namespace {

constexpr std::uint64_t shuffle_stream = 0x7368756666ull;  // beside those of pattern and plants

class ExplicitSource : public PlantSource {
 public:
  ExplicitSource(const TomlValue& entries, bool shuffled) : entries_(entries), shuffled_(shuffled) {
    for (std::size_t i = 0; i < entries.size(); ++i) {
      const TomlValue entry = entries[i];
      if (const TomlValue probability = entry.get("probability"))
        probability.reject("where planting.mode is \"explicit\" each plant stands once");
      const CloneVariation variation(entry);
      for (const std::string& file : plant_files(entry)) {
        files_.push_back(file);
        variations_.push_back(variation);
      }
    }
  }

  PlantSet stand(std::size_t count, std::uint64_t seed) override {
    const std::size_t given = files_.size();
    if (given < count)
      entries_.reject(
          fmt::format("{} plant files, expected {}: planting.mode is \"explicit\" and each stands "
                      "once",
                      given, count));
    std::vector<std::size_t> order(given);
    std::iota(order.begin(), order.end(), std::size_t{0});
    Philox random(seed, shuffle_stream);
    for (std::size_t i = 0; shuffled_ && i < count; ++i)
      std::swap(order[i], order[i + random.below(given - i)]);
    order.resize(count);
    std::vector<std::string> files;
    std::vector<CloneVariation> variations;
    for (const std::size_t i : order) files.push_back(files_[i]), variations.push_back(variations_[i]);
    variations_ = std::move(variations);
    PlantSet out = read_plant_files(files);
    for (CanopyPlant& plant : out.plants) plant.probability = 1 / static_cast<double>(count);
    if (count < given)
      out.notes.push_back(fmt::format("{} of {} plant files stand, one at each place", count, given));
    return out;
  }

  PlantDraw draw(std::size_t k, Philox& random) const override {
    PlantDraw out;
    out.plant = static_cast<std::uint32_t>(k);
    out.rotation = rotation(out.plant, random);
    out.scale = variations_[k].scale(random);
    return out;
  }
  double rotation(std::uint32_t plant, Philox& random) const override {
    return variations_[plant].rotation(random);
  }

 private:
  TomlValue entries_;
  bool shuffled_;
  std::vector<std::string> files_;
  std::vector<CloneVariation> variations_;
};

}  // namespace

std::unique_ptr<PlantSource> explicit_source(const TomlValue& entries, bool shuffled) {
  return std::make_unique<ExplicitSource>(entries, shuffled);
}

}  // namespace bpms
