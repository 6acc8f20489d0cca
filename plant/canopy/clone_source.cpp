// [[plants]] as clones: each place draws one of the plants by its probability.
#include <algorithm>

#include "plant/canopy/plant_files.h"
#include "plant/canopy/plant_sources.h"

namespace bpms {
namespace {

class CloneSource : public PlantSource {
 public:
  explicit CloneSource(const TomlValue& entries) {
    double total = 0;
    for (std::size_t i = 0; i < entries.size(); ++i) {
      const TomlValue entry = entries[i];
      const TomlValue share = entry.get("probability");
      const double probability = share ? share.number(0, 1e9) : 1.0;
      const CloneVariation variation(entry);
      const std::vector<std::string> files = plant_files(entry);
      for (const std::string& file : files) {
        files_.push_back(file);
        probabilities_.push_back(probability / static_cast<double>(files.size()));
        variations_.push_back(variation);
      }
      total += probability;
    }
    if (!(total > 0)) entries.reject("no plant has a probability above 0");
    double sum = 0;
    for (std::size_t i = 0; i < probabilities_.size(); ++i) {
      probabilities_[i] /= total;
      cumulative_.push_back(sum += probabilities_[i]);
      if (probabilities_[i] > 0) last_ = i;
    }
  }

  PlantSet stand(std::size_t, std::uint64_t) override {
    PlantSet out = read_plant_files(files_);
    for (std::size_t i = 0; i < out.plants.size(); ++i) out.plants[i].probability = probabilities_[i];
    return out;
  }

  PlantDraw draw(std::size_t, Philox& random) const override {
    const auto found = std::upper_bound(cumulative_.begin(), cumulative_.end(), random.uniform());
    PlantDraw out;
    // Rounding may leave a rest: it goes to the last that can occur.
    out.plant =
        static_cast<std::uint32_t>(std::min(static_cast<std::size_t>(found - cumulative_.begin()), last_));
    out.rotation = rotation(out.plant, random);
    out.scale = variations_[out.plant].scale(random);
    return out;
  }
  double rotation(std::uint32_t plant, Philox& random) const override {
    return variations_[plant].rotation(random);
  }

 private:
  std::vector<std::string> files_;
  std::vector<double> probabilities_, cumulative_;
  std::vector<CloneVariation> variations_;
  std::size_t last_ = 0;
};

}  // namespace

std::unique_ptr<PlantSource> clone_source(const TomlValue& entries) {
  return std::make_unique<CloneSource>(entries);
}

}  // namespace bpms
