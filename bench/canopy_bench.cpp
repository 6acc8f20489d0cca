// Large stands, each at a size and at twice it, with the ratio of the two (2: linear): clones in rows, clones
// at random with a least distance, and plants that are all different. Seconds to read canopy.toml, to make
// the scene's geometry, to build the intersector and to trace the gap fraction at ten angles; bytes as the
// system sees them. The files are made in a temporary folder.
//   bench_canopy [CLONES [DIFFERENT]]      (1000000, 10000)
#include <fmt/core.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <string>

#include "bench/process_status.h"
#include "core/random.h"
#include "core/text.h"
#include "plant/canopy/overlap.h"
#include "scene/importers/plants.h"
#include "scene/structure/gap_fraction.h"

namespace {

using namespace bpms;
// Seconds since it was made, by the clock and of all threads together: a busy machine does not add to those.
class Stopwatch {
 public:
  double wall() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - wall_).count();
  }
  double processors() const { return static_cast<double>(std::clock() - clock_) / CLOCKS_PER_SEC; }
  std::string text() const { return fmt::format("{:.2f} s (threads {:.2f} s)", wall(), processors()); }

 private:
  std::chrono::steady_clock::time_point wall_ = std::chrono::steady_clock::now();
  std::clock_t clock_ = std::clock();
};

// A cereal of one tiller: `leaves` arching blades up the stem, an ear.
std::string cereal(int leaves, std::uint64_t number) {
  Philox random(7, number);
  std::string word = "units cm\n[", blocks;
  for (int k = 1; k <= leaves; ++k) {
    word += "s[+l]";
    blocks +=
        fmt::format("s {} {{ material stem a_length {:.3f} a_radius 0.15 }}\n", k, random.uniform(6, 10));
    blocks += fmt::format("+ {} {{ a_twist {:.2f} }}\n", k, 180.0 * k + random.uniform(-30, 30));
    blocks += fmt::format(
        "l {} {{ material leaf a_length {:.3f} a_width {:.3f} f_inclination n 0 {:.2f} 0.5 {:.2f} 1 {:.2f} "
        "f_width n 0 0.5 0.4 1 1 0 f_curvature n 0 40 1 5 }}\n",
        k, random.uniform(15, 25), random.uniform(0.9, 1.6), random.uniform(10, 25), random.uniform(30, 50),
        random.uniform(60, 110));
  }
  return word + "h]\n" + blocks + "h { material ear a_length 8 a_radius 0.5 }\n";
}

class Folder {
 public:
  Folder() {
    std::string name = (std::filesystem::temp_directory_path() / "bpms-bench-XXXXXX").string();
    path_ = mkdtemp(name.data());
  }
  ~Folder() {
    std::error_code code;
    std::filesystem::remove_all(path_, code);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  std::string write(const std::string& name, const std::string& text) const {
    std::filesystem::create_directories((path_ / name).parent_path());
    std::ofstream(path_ / name, std::ios::binary) << text;
    return (path_ / name).string();
  }

 private:
  std::filesystem::path path_;
};

struct StandTimes {
  double read = 0, scene = 0, intersector = 0, gaps = 0;  // of all threads together
};

std::vector<double> ten_angles_deg() {
  std::vector<double> out;
  for (int k = 0; k < 9; ++k) out.push_back(10.0 * k);
  out.push_back(57.5);
  return out;
}

StandTimes measure(const std::string& file) {
  StandTimes out;
  const double before = status_mib("VmRSS");
  const Stopwatch reading;
  const Canopy canopy = read_canopy(file);
  out.read = reading.processors();
  fmt::print("{:9} plants, {} different: read {}, {:.0f} MiB, {} notes\n", canopy.placements.size(),
             canopy.plants.size(), reading.text(), status_mib("VmRSS") - before, canopy.notes.size());
  const Stopwatch making;
  Scene scene;
  MaterialNames names(scene);
  scene.domain = {canopy.size_m, canopy.periodic};
  add_canopy(canopy, {file}, names, scene);
  out.scene = making.processors();
  std::size_t triangles = 0;
  for (const Prototype& p : scene.prototypes) triangles += p.mesh->triangles.size();
  fmt::print("  scene {}, {} triangles, {:.0f} MiB\n", making.text(), triangles,
             status_mib("VmRSS") - before);
  const Stopwatch building;
  const GapScene rays(scene);
  out.intersector = building.processors();
  fmt::print("  intersector {}, {:.0f} MiB\n", building.text(), status_mib("VmRSS") - before);
  const Stopwatch tracing;
  GapOptions options;
  options.target_se = 0.002;
  options.rays = 1u << 20;
  const std::vector<Gap> gaps = gap_fraction(rays, gap_directions(ten_angles_deg()), options);
  out.gaps = tracing.processors();
  double worst = 0;
  for (const Gap& gap : gaps) worst = std::max(worst, gap.plant.standard_error);
  fmt::print("  gap fraction at 10 angles {}, P(0) {:.3f}, standard errors up to {:.4f}\n", tracing.text(),
             gaps[0].plant.p, worst);
  std::fflush(stdout);
  return out;
}

void compare(const char* what, const std::string& single, const std::string& twice) {
  fmt::print("{}\n", what);
  const StandTimes one = measure(single), two = measure(twice);
  fmt::print("  twice as many: read x {:.2f}  scene x {:.2f}  intersector x {:.2f}  gaps x {:.2f}\n",
             two.read / one.read, two.scene / one.scene, two.intersector / one.intersector,
             two.gaps / one.gaps);
}

std::string stand(const Folder& folder, const std::string& name, double area_m2, const std::string& plants,
                  const std::string& planting) {
  const double side = std::sqrt(area_m2);
  return folder.write(
      name, fmt::format("[domain]\nsize_m = [{0:.9g}, {0:.9g}]\n{1}[planting]\n{2}", side, plants, planting));
}

}  // namespace

int main(int argc, char** argv) {
  const double clones = argc > 1 ? std::atof(argv[1]) : 1e6;
  const int different = argc > 2 ? std::atoi(argv[2]) : 10'000;
  const Folder folder;
  std::string four;
  for (std::uint64_t k = 0; k < 4; ++k) {
    folder.write(fmt::format("clone{}.bpms", k), cereal(5, k));
    four += fmt::format("[[plants]]\nfile = \"clone{}.bpms\"\nscale = {{ mean = 1, sd = 0.05 }}\n", k);
  }
  const std::string rows =
      "pattern = \"rows\"\nrow_spacing_m = { mean = 0.15, sd = 0.005 }\nrow_width_m = 0.03\ndensity_per_m2 = "
      "250\n";
  compare("clones in rows, 250 per m2", stand(folder, "rows.toml", clones / 250, four, rows),
          stand(folder, "rows2.toml", 2 * clones / 250, four, rows));
  const std::string hard = "pattern = \"hard_core\"\ndensity_per_m2 = 250\nmin_distance_m = 0.03\n";
  compare("clones no nearer than 3 cm", stand(folder, "hard.toml", clones / 250, four, hard),
          stand(folder, "hard2.toml", 2 * clones / 250, four, hard));

  const std::string once = rows + "mode = \"explicit\"\n", set = "[[plants]]\nfolder = \"different\"\n";
  for (int k = 0; k < different; ++k)
    folder.write(fmt::format("different/p{:06}.bpms", k), cereal(5, 100 + static_cast<std::uint64_t>(k)));
  compare("plants that are all different", stand(folder, "half.toml", 0.5 * different / 250, set, once),
          stand(folder, "all.toml", 1.0 * different / 250, set, once));

  fmt::print("overlap between clones in rows\n");
  double seconds[2] = {};
  for (int k = 0; k < 2; ++k) {
    const std::string file =
        stand(folder, "overlap.toml", (k + 1) * clones / 250 / 100, four, rows + "[overlap]\n");
    const Stopwatch reading;
    const Canopy canopy = read_canopy(file);
    seconds[k] = reading.processors();
    fmt::print("{:9} plants: {}, {:.4f} of the leaf area\n", canopy.placements.size(), reading.text(),
               canopy.overlap->fraction);
  }
  fmt::print("  twice as many: x {:.2f}\n", seconds[1] / seconds[0]);
}
