// Gaps, overlap, effective G and Gamma of random canopies against closed forms. One drawing of a canopy has
// gaps of its own, so that all is taken over independent drawings: their mean, and its standard error from
// their spread.
#include <Eigen/Geometry>

#include "core/random.h"
#include "core/units.h"
#include "simulate/output/derived.h"
#include "tests/simulate/scene_text.h"
#include "tests/simulate/spread.h"

namespace bpms::test {
namespace {

constexpr std::uint64_t drawings = 24;
// Exceeded by Student's t of 23 degrees of freedom as rarely as 3.5 by a normal variable (4.7e-4, both
// sides).
constexpr double most_t = 4.08;

constexpr double sza_deg = 40, side_m = 3;
struct View {
  double vza_deg, vaa_deg;
};
// The first three lie 45 degrees and more from the sun, the last in the hot spot.
constexpr View looks[] = {{30, 90}, {50, 180}, {10, 250}, {sza_deg, 0}};
constexpr std::size_t n_looks = std::size(looks), hot_spot = n_looks - 1;

// What is drawn: discs as leaves, and closed cylinders of any direction, six times as long as they are thick,
// as stems; each by its area over the ground's, of cylinders half of their surface.
struct Mix {
  double discs = 0, stems = 0;
  double area() const { return discs + stems; }
};
constexpr double rho = 0.5, tau = 0.3, rho_stem = 0.4;

std::string stems_of(double area_index, double radius_m, std::uint64_t seed) {
  Philox random(seed, 11);
  const double length = 6 * radius_m, half_area = pi * radius_m * (length + radius_m);
  std::string out;
  for (long i = std::lround(area_index * side_m * side_m / half_area); i > 0; --i) {
    const double up = random.uniform(-1, 1), turn = random.uniform(0, 2 * pi),
                 across = std::sqrt(1 - up * up);
    const Eigen::Vector3d along =
        0.5 * length * Eigen::Vector3d(across * std::cos(turn), across * std::sin(turn), up);
    const Eigen::Vector3d at(random.uniform(-0.5, 0.5) * side_m, random.uniform(-0.5, 0.5) * side_m,
                             random.uniform(0.1, 2.1));
    const Eigen::Vector3d from = at - along, to = at + along;
    out += fmt::format("cylinder {} {} {} {} {} {} {}\n", from.x(), from.y(), from.z(), to.x(), to.y(),
                       to.z(), radius_m);
  }
  return out;
}

// Of one drawing, by quantity: gap towards the sun; by view its gap, overlap, effective G and Gamma.
struct Quantities {
  std::vector<double> sun_gap = std::vector<double>(1), sun_g = sun_gap;
  std::vector<double> gap = std::vector<double>(n_looks), overlap = gap, g = gap, gamma = gap;
};

Quantities drawing(const Mix& mix, double radius_m, std::uint64_t seed) {
  const TemporaryFolder folder;
  SceneText text = canopy_text(folder, {.lai = mix.discs,
                                        .radius_m = radius_m,
                                        .size_m = {side_m, side_m},
                                        .bottom_m = 0.1,
                                        .top_m = 2.1,
                                        .seed = seed});
  text.leaf = bilambertian(fmt::format("{}", rho), fmt::format("{}", tau));
  text.sun = sun_at(sza_deg, 0);
  std::string list;
  for (const View& look : looks) list += fmt::format("[{}, {}], ", look.vza_deg, look.vaa_deg);
  text.sensor = views("[" + list + "]");
  text.sampling = "samples = 32768\nmax_order = 1\n";
  std::string more;
  if (mix.stems > 0) {
    folder.write("stems.txt", stems_of(mix.stems, radius_m / 2, seed));
    more = "[materials.stem]\n" + lambertian(fmt::format("{}", rho_stem)) +
           "[prototypes.stems]\nshapes = \"stems.txt\"\nmaterial = \"stem\"\n"
           "[[instances]]\nprototype = \"stems\"\npositions = [[0, 0, 0]]\n";
  }
  const Simulation simulation = read_simulation(folder.write("scene.toml", text.str() + more));
  // To the rounding of the numbers of discs and stems, some hundreds at least.
  EXPECT_NEAR(intercepting_area_m2(simulation.scene) / (side_m * side_m), mix.area(), 1e-3 * mix.area());
  const Result result = simulate(simulation, seed);
  return {result.sun_gap.value,
          effective_g_of_suns(simulation, result).value,
          result.sensors[0].gap.value,
          overlap_function(simulation, result, 0).value,
          effective_g(simulation, result, 0).value,
          effective_gamma(simulation, result, 0).value};
}

std::vector<Quantities> draw(const Mix& mix, double radius_m) {
  std::vector<Quantities> out;
  for (std::uint64_t seed = 1; seed <= drawings; ++seed) out.push_back(drawing(mix, radius_m, seed));
  return out;
}

Mean mean_over(const std::vector<Quantities>& all, std::vector<double> Quantities::*quantity,
               std::size_t at) {
  std::vector<double> values;
  for (const Quantities& one : all) values.push_back((one.*quantity).at(at));
  return mean_of(values);
}

// `most_error`: how large the error may be for the comparison to mean anything.
void expect_mean(const Mean& found, double expected, double most_error, const std::string& what) {
  EXPECT_LT(found.error, most_error) << what;
  EXPECT_LT(std::abs(found.value - expected), most_t * found.error)
      << what << ": " << found.value << " +- " << found.error << ", expected " << expected << ", t "
      << (found.value - expected) / found.error;
}

// Extrapolated linearly to elements of no size, from `wide` and `narrow` of half the size: what light and
// sight share near the hot spot grows with the size.
Mean without_size(const Mean& wide, const Mean& narrow) {
  return {2 * narrow.value - wide.value, std::hypot(2 * narrow.error, wide.error)};
}

// (rho + tau) / (3 pi) (sin b - b cos b) + tau / 3 cos b of leaves, b between the directions of propagation
// (Ross 1981). A convex body of any direction shows all normals alike, as spherical leaves do of which one
// half of the surface is the one-sided area; it lets nothing through.
double expected_gamma(const Mix& mix, const View& look) {
  const Domain domain;
  const double cosine = direction_from_angles(radians(sza_deg), 0, domain)
                            .dot(direction_from_angles(radians(look.vza_deg), radians(look.vaa_deg), domain));
  const double b = pi - std::acos(std::min(1.0, cosine));
  const double back = (std::sin(b) - b * std::cos(b)) / (3 * pi);
  const double leaf = (rho + tau) * back + tau / 3 * std::cos(b), stem = rho_stem * back;
  return (mix.discs * leaf + mix.stems * stem) / mix.area();
}

double cosine_of(const View& look) {
  return std::cos(radians(look.vza_deg));
}

void expect_closed_forms(const Mix& mix) {
  const std::vector<Quantities> wide = draw(mix, 0.02), narrow = draw(mix, 0.01);
  const double k = 0.5 * mix.area();  // every element has the mean projection 1/2
  const double p_s = std::exp(-k / std::cos(radians(sza_deg)));
  for (const auto* all : {&wide, &narrow}) {
    expect_mean(mean_over(*all, &Quantities::sun_gap, 0), p_s, 0.02 * p_s, "gap towards the sun");
    expect_mean(mean_over(*all, &Quantities::sun_g, 0), 0.5, 0.01, "G towards the sun");
    for (std::size_t look = 0; look < n_looks; ++look) {
      const double p_v = std::exp(-k / cosine_of(looks[look]));
      expect_mean(mean_over(*all, &Quantities::gap, look), p_v, 0.02 * p_v, fmt::format("gap {}", look));
      expect_mean(mean_over(*all, &Quantities::g, look), 0.5, 0.01, fmt::format("G {}", look));
    }
    // What is seen in the hot spot is sunlit: P(s, v) = P(s).
    expect_mean(mean_over(*all, &Quantities::overlap, hot_spot), p_s * (1 - p_s), 0.01, "overlap, hot spot");
  }
  for (std::size_t look = 0; look < hot_spot; ++look) {
    const auto without = [&](std::vector<double> Quantities::*quantity) {
      return without_size(mean_over(wide, quantity, look), mean_over(narrow, quantity, look));
    };
    expect_mean(without(&Quantities::overlap), 0, 0.005, fmt::format("overlap {}", look));
    const double gamma = expected_gamma(mix, looks[look]);
    // A factor of 1.03 must show: 0.03 / most_t.
    expect_mean(without(&Quantities::gamma), gamma, 0.03 / most_t * gamma, fmt::format("Gamma {}", look));
  }
}

TEST(Drawings, OfLeavesHaveTheGapsAndTheScatteringOfSphericalLeaves) {
  expect_closed_forms({.discs = 1.5});
}

// Stems cast shadows and scatter: they belong to the area.
TEST(Drawings, OfLeavesAndStemsCountBothAreas) {
  expect_closed_forms({.discs = 0.8, .stems = 0.6});
}

// A square leaf of 1 m2 beside a closed box of 0.2 x 0.2 x 1 m as its stem, twice as large; and a cylinder.
TEST(InterceptingArea, IsOneSideOfLeavesAndHalfTheSurfaceOfTheRest) {
  const TemporaryFolder folder;
  std::string obj =
      "g leaf1\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\nf 1 2 3 4\n"
      "g stem\n";
  for (const double z : {0.0, 1.0})
    for (const auto& [x, y] : {std::pair{0.0, 0.0}, {0.2, 0.0}, {0.2, 0.2}, {0.0, 0.2}})
      obj += fmt::format("v {} {} {}\n", x, y, z);
  obj += "f 8 7 6 5\nf 9 10 11 12\nf 5 6 10 9\nf 6 7 11 10\nf 7 8 12 11\nf 8 5 9 12\n";
  folder.write("plant.obj", obj);
  folder.write("post.txt", "cylinder 0 0 0 0 0 1 0.1\n");
  const SceneText text{.domain = "size_m = [9, 9]",
                       .leaf = lambertian("0.5"),
                       .soil = lambertian("0.2"),
                       .mesh = "plant.obj",
                       .positions = "[[0, 0, 0]]\nscale = 2",
                       .sun = sun_at(0, 0),
                       .sensor = views("[[0, 0]]"),
                       .sampling = "samples = 32"};
  const auto area = [&](const std::string& more) {
    return intercepting_area_m2(read_simulation(folder.write("scene.toml", text.str() + more)).scene);
  };
  const double plant = 4 * (1 + 0.5 * (4 * 0.2 + 2 * 0.04));
  EXPECT_NEAR(area("[materials.bark]\ntype = \"lambertian\"\nreflectance = 0.3\n[prototypes.post]\nshapes = "
                   "\"post.txt\"\nmaterial = \"bark\"\n[[instances]]\nprototype = \"post\"\npositions = [[3, "
                   "0, 0], [0, 3, 0]]\n"),
              plant + 2 * 0.5 * (2 * pi * 0.1 + 2 * pi * 0.01), 1e-6);
}

}  // namespace
}  // namespace bpms::test
