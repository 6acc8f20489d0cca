#include "tests/materials/lobe_checks.h"

#include <algorithm>

#include "core/random.h"

namespace bpms::test {
namespace {

constexpr double views_deg[] = {0, 20, 50, 75};
// Significance of 1 % over all lobes and views of the program, some two hundred tests.
constexpr double significance = 0.01 / 200;

class LobeCheck {
 public:
  LobeCheck(const SurfaceLobe& lobe, std::size_t bands, double view_deg, std::uint64_t seed)
      : lobe_(lobe), bands_(bands), view_(direction(view_deg, 35)), random_(seed) {}

  // Draws over a grid of bins, against the integral of the pdf over each.
  void draws_its_pdf() {
    constexpr int draws = 200'000;
    std::vector<double> expected(bins, 0.0);
    double inside = 0;
    for (int half = 0; half < 2; ++half)
      for (int i = 0; i < zeniths * fine; ++i)
        for (int k = 0; k < azimuths * fine; ++k) {
          const double cosine = (i + 0.5) / (zeniths * fine);
          const double azimuth = 2 * pi * (k + 0.5) / (azimuths * fine);
          const double sine = std::sqrt(1 - cosine * cosine);
          const Eigen::Vector3d light(sine * std::cos(azimuth), sine * std::sin(azimuth),
                                      half == 0 ? cosine : -cosine);
          const double part = static_cast<double>(lobe_.lobe->pdf(view_, light.cast<float>())) * 2 * pi /
                              (zeniths * fine * azimuths * fine);
          expected[bin(half, i / fine, k / fine)] += part * draws;
          inside += part;
        }
    std::vector<double> seen(bins, 0.0);
    double none = 0;
    for (int draw = 0; draw < draws; ++draw) {
      Eigen::Vector3f light;
      if (!next(light)) {
        none += 1;
        continue;
      }
      ASSERT_NEAR(light.norm(), 1, 1e-5);
      const double azimuth = std::atan2(light.y(), light.x());
      const double turn = azimuth < 0 ? azimuth + 2 * pi : azimuth;
      const int i = std::min(static_cast<int>(std::abs(light.z()) * zeniths), zeniths - 1);
      const int k = std::min(static_cast<int>(turn / (2 * pi) * azimuths), azimuths - 1);
      seen[bin(light.z() > 0 ? 0 : 1, i, k)] += 1;
    }
    constexpr double midpoints = 1e-3;  // error of the integral over all
    EXPECT_LT(inside, 1 + midpoints);
    const double drawn = std::min(inside, 1.0);
    EXPECT_NEAR(draws - none, draws * drawn,
                4.5 * std::sqrt(draws * drawn * (1 - drawn)) + midpoints * draws);
    // Bins of few are put together, with what was not drawn.
    double rest_seen = none, rest_expected = draws * std::max(0.0, 1 - inside), sum = 0, dof = -1;
    for (std::size_t b = 0; b < bins; ++b) {
      if (expected[b] < 20) {
        rest_seen += seen[b];
        rest_expected += expected[b];
        continue;
      }
      sum += (seen[b] - expected[b]) * (seen[b] - expected[b]) / expected[b];
      dof += 1;
    }
    if (rest_expected > 20) {
      sum += (rest_seen - rest_expected) * (rest_seen - rest_expected) / rest_expected;
      dof += 1;
    } else {
      EXPECT_LT(rest_seen, rest_expected + 5 * std::sqrt(rest_expected) + 5);
    }
    ASSERT_GT(dof, 5);
    seen_.chi_square = sum, seen_.freedom = dof;
    EXPECT_GT(chi_square_above(sum, dof), significance) << "chi-square " << sum << " over " << dof;
  }

  // Mean of the weights against the quadrature of the values, per band; their bound.
  void weighs_its_albedo(const LobeLimits& limits) {
    const std::vector<double> albedo = quadrature();
    constexpr int draws = 80'000;
    std::vector<double> sum(bands_, 0.0), squares(bands_, 0.0);
    double largest = 0;
    for (int draw = 0; draw < draws; ++draw) {
      Eigen::Vector3f light;
      if (!next(light)) continue;
      const double scale =
          std::abs(static_cast<double>(light.z())) / static_cast<double>(lobe_.lobe->pdf(view_, light));
      const std::vector<double> values = values_of(lobe_, view_, light, bands_);
      for (std::size_t band = 0; band < bands_; ++band) {
        const double weight = values[band] * scale;
        ASSERT_GE(weight, 0);
        sum[band] += weight;
        squares[band] += weight * weight;
        if (albedo[band] > 0) largest = std::max(largest, weight / albedo[band]);
      }
    }
    for (std::size_t band = 0; band < bands_; ++band) {
      const double mean = sum[band] / draws;
      const double error = std::sqrt((squares[band] / draws - mean * mean) / draws);
      EXPECT_NEAR(mean, albedo[band], 4 * error + 2e-4 * albedo[band]) << "band " << band;
      EXPECT_LE(albedo[band], limits.largest_albedo) << "band " << band;
      seen_.largest_albedo = std::max(seen_.largest_albedo, albedo[band]);
      if (std::getenv("BPMS_TELL_WEIGHTS") != nullptr)
        fmt::print("    albedo {:.4f} +- {:.4f}, sd of weights / albedo {:.3f}, largest {:.2f}\n", mean,
                   error, error * std::sqrt(draws) / mean, largest);
    }
    EXPECT_LE(largest, limits.largest_weight);
  }

  void exchanges_sun_and_view() {
    for (int pair = 0; pair < 200; ++pair) {
      Eigen::Vector3f light;
      if (!next(light)) continue;
      if (std::abs(light.z()) < 0.02f) continue;  // floats hold little of it there
      // Each is seen from its own side: the frame is turned about x where light comes from below.
      const bool through = light.z() < 0;
      const auto turned = [&](const Eigen::Vector3f& d) {
        return through ? Eigen::Vector3f(d.x(), -d.y(), -d.z()) : d;
      };
      const std::vector<double> one = values_of(lobe_, view_, light, bands_);
      const std::vector<double> other = values_of(lobe_, turned(light), turned(view_), bands_);
      for (std::size_t band = 0; band < bands_; ++band) {
        ASSERT_NEAR(one[band], other[band], 2e-4 * one[band] + 1e-7);  // narrow lobes magnify float rounding
        if (one[band] > 1e-3)
          seen_.exchanged = std::max(seen_.exchanged, std::abs(other[band] / one[band] - 1));
      }
    }
  }

  struct Seen {
    double chi_square = 0, freedom = 0, largest_albedo = 0, exchanged = 0;
  };
  const Seen& seen() const { return seen_; }

 private:
  static constexpr int zeniths = 16, azimuths = 32, fine = 24;
  static constexpr std::size_t bins = 2 * zeniths * azimuths;
  static std::size_t bin(int half, int i, int k) {
    return static_cast<std::size_t>((half * zeniths + i) * azimuths + k);
  }
  bool next(Eigen::Vector3f& light) {
    const auto u = static_cast<float>(random_.uniform()), v = static_cast<float>(random_.uniform());
    return lobe_.lobe->sample(view_, std::min(u, 1 - 1e-7f), std::min(v, 1 - 1e-7f), light);
  }
  // Midpoints, uniform in zenith and azimuth.
  std::vector<double> quadrature() const {
    constexpr int n = 400;
    std::vector<double> out(bands_, 0.0);
    for (const double side : {1.0, -1.0})
      for (int i = 0; i < n; ++i)
        for (int k = 0; k < n; ++k) {
          const double zenith = pi / 2 * (i + 0.5) / n, azimuth = 2 * pi * (k + 0.5) / n;
          const double sine = std::sin(zenith), cosine = std::cos(zenith);
          const Eigen::Vector3d light(sine * std::cos(azimuth), sine * std::sin(azimuth), side * cosine);
          const std::vector<double> values = values_of(lobe_, view_, light.cast<float>(), bands_);
          for (std::size_t band = 0; band < bands_; ++band)
            out[band] += values[band] * cosine * sine * pi / 2 * 2 * pi / (n * n);
        }
    return out;
  }

  const SurfaceLobe& lobe_;
  std::size_t bands_;
  Eigen::Vector3f view_;
  Philox random_;
  Seen seen_;
};

}  // namespace

void check_lobe(const std::string& what, const SurfaceLobe& lobe, std::size_t bands,
                const LobeLimits& limits) {
  ASSERT_FALSE(lobe.lobe->is_delta());
  EXPECT_EQ(lobe.lobe->reciprocal(), limits.reciprocal);
  std::uint64_t seed = 1;
  static int lobes = 0;  // of the program: properties of a test need names of their own
  ++lobes;
  for (const double view_deg : views_deg) {
    SCOPED_TRACE(fmt::format("{}, view at {} degrees", what, view_deg));
    if (std::getenv("BPMS_TELL_WEIGHTS") != nullptr) fmt::print("  {} {}\n", what, view_deg);
    LobeCheck check(lobe, bands, view_deg, seed++);
    check.draws_its_pdf();
    check.weighs_its_albedo(limits);
    if (limits.reciprocal) check.exchanges_sun_and_view();
    // For validation/run: lobe, view, chi-square, degrees of freedom, albedo, change by exchange.
    std::string words = what;
    std::replace(words.begin(), words.end(), '\n', ' ');
    ::testing::Test::RecordProperty(
        fmt::format("lobe_{}_{}", lobes, view_deg),
        fmt::format("{}|{}|{}|{}|{}|{}", words, view_deg, check.seen().chi_square, check.seen().freedom,
                    check.seen().largest_albedo,
                    limits.reciprocal ? fmt::format("{}", check.seen().exchanged) : ""));
  }
}

double chi_square_above(double value, double dof) {
  const double spread = std::sqrt(2 / (9 * dof));
  const double z = (std::cbrt(value / dof) - (1 - 2 / (9 * dof))) / spread;
  return 0.5 * std::erfc(z / std::sqrt(2.0));
}

}  // namespace bpms::test
