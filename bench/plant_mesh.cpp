// What the surface of a plant costs: read from its text, meshed, for cereal-like plants that are all
// different (a stand in which no two plants share a mesh). Prints microseconds of processor time a plant and
// ratios.
#include <fmt/core.h>

#include <algorithm>
#include <ctime>
#include <vector>

#include "plant/plant_mesh.h"

namespace {

// The processor's time, which other programs on the machine disturb least.
double microseconds(std::clock_t ticks, int runs) {
  return 1e6 * static_cast<double>(ticks) / CLOCKS_PER_SEC / runs;
}

// Six internodes with a leaf each, thirteen leaves of tillers, a head: 20 organs with a surface.
std::string cereal(int seed) {
  const auto vary = [&](int k) { return 1 + 0.1 * (((seed * 7919 + k * 104729) % 1000) / 500.0 - 1); };
  std::string word = "[", blocks;
  int leaf = 0, turn = 0;
  const auto add_leaf = [&] {
    ++leaf, ++turn;
    word += "[+l]";
    blocks += fmt::format("+ {} {{ a_twist {} }}\n", turn, 137.5 * turn);
    blocks += fmt::format(
        "l {} {{ a_length {:.4f} a_width {:.4f}\n f_inclination s 0 {:.3f} 0.3 25 0.6 {:.3f} 1 {:.3f}\n"
        " f_width s 0 0.5 0.2 0.9 0.4 1 0.7 0.8 0.9 0.4 1 0 }}\n",
        leaf, 20 * vary(leaf), 1.2 * vary(leaf + 31), 12 * vary(leaf + 57), 50 * vary(leaf + 3),
        90 * vary(leaf + 11));
  };
  for (int s = 1; s <= 6; ++s) {
    word += "s";
    blocks += fmt::format("s {} {{ a_length {:.4f} a_radius 0.18 }}\n", s, 9 * vary(s + 90));
    add_leaf();
  }
  for (int k = 0; k < 7; ++k) add_leaf();
  word += "h]";
  blocks += "h 1 { a_length 8 a_radius 0.5 }\n";
  return "units cm\n" + word + "\n" + blocks;
}

}  // namespace

int main() {
  using namespace bpms;
  constexpr int plants = 200;
  std::vector<std::string> texts;
  for (int k = 0; k < plants; ++k) texts.push_back(cereal(k));
  for (const double tolerance_m : {1e-4, 5e-4}) {
    double best_parse = 1e300, best_mesh = 1e300;
    std::size_t triangles = 0, organs = 0;
    for (int round = 0; round < 5; ++round) {
      std::vector<Plant> read;
      const auto start = std::clock();
      for (const std::string& text : texts) read.push_back(parse_plant("cereal.bpms", text));
      const auto parsed = std::clock();
      triangles = organs = 0;
      for (const Plant& plant : read) {
        const Mesh mesh = plant_mesh(plant, {tolerance_m});
        triangles += mesh.triangles.size();
        organs += mesh.organs.size();
      }
      const auto meshed = std::clock();
      best_parse = std::min(best_parse, microseconds(parsed - start, plants));
      best_mesh = std::min(best_mesh, microseconds(meshed - parsed, plants));
    }
    fmt::print(
        "tolerance {:.1f} mm: {} organs, {} triangles a plant; read {:.0f} us, meshed {:.0f} us ({:.2f} "
        "times)\n",
        tolerance_m * 1e3, organs / plants, triangles / plants, best_parse, best_mesh,
        best_mesh / best_parse);
  }
}
