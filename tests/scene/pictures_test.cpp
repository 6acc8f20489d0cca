// Pictures against closed forms: silhouettes, the bar of known length, colours and their legend.
#include "scene/pictures/picture.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/parallel.h"
#include "core/units.h"
#include "scene/importers/any_scene.h"
#include "scene/pictures/legend.h"
#include "scene/pictures/subject.h"
#include "scene/pictures/viewer_document.h"
#include "tests/data.h"

namespace bpms::test {
namespace {

constexpr double ball_radius_m = 0.1;

Scene two_balls() {
  Scene scene;
  scene.domain.periodic = false;
  scene.materials = {"leaf", "stem"};
  scene.prototypes.resize(2);
  for (std::uint32_t k = 0; k < 2; ++k) {
    scene.prototypes[k].name = k == 0 ? "one" : "other";
    scene.prototypes[k].shapes = {sphere({0, 0, 0}, ball_radius_m, k)};
    scene.instances.emplace_back();
    scene.instances[k].prototype = k;
    scene.instances[k].position_m = {k == 0 ? -0.2 : 0.2, 0, 0};
  }
  return picture_subject(scene, "two balls");
}

// A box of 0.2 x 0.4 x 0.1 m, its faces looking outwards.
Scene box(const TemporaryFolder& folder) {
  const std::string path = folder.write("box.obj",
                                        "o box\nv -0.1 -0.2 0\nv 0.1 -0.2 0\nv 0.1 0.2 0\nv -0.1 0.2 0\n"
                                        "v -0.1 -0.2 0.1\nv 0.1 -0.2 0.1\nv 0.1 0.2 0.1\nv -0.1 0.2 0.1\n"
                                        "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n");
  return picture_subject(read_any_scene(path, {}), path);
}

PictureOptions bare(const PictureView& view) {
  PictureOptions out;
  out.views = {view};
  out.width = 500, out.height = 400;
  out.transparent = true;
  out.legend = out.scale_bar = out.labels = false;
  return out;
}

double covered_pixels(const RgbImage& image) {
  double sum = 0;
  for (const std::uint8_t a : image.alpha) sum += a / 255.0;
  return sum;
}

// Pixels on an outline are covered in part, as 16 places tell: each is off by less than 1/8 (standard error),
// and 8 bits hold 1/255; four standard errors.
double allowed(double outline_px) {
  return 4 * (1.0 / 8) * std::sqrt(outline_px) + outline_px / 510;
}

Rgb pixel(const RgbImage& image, double x, double y) {
  const auto at =
      3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(x));
  return {image.rgb[at], image.rgb[at + 1], image.rgb[at + 2]};
}

TEST(Pictures, ASphereCoversItsDisc) {
  for (const std::string& name : view_names()) {
    Scene scene = two_balls();
    scene.instances.resize(1);
    const Picture picture = draw_picture(scene, bare(named_view(name)));
    const double radius_px = ball_radius_m / picture.panels[0].metres_per_pixel;
    EXPECT_NEAR(covered_pixels(picture.image), pi * radius_px * radius_px, allowed(2 * pi * radius_px))
        << name;
  }
}

TEST(Pictures, ABoxCoversTheProjectionOfItsFaces) {
  const TemporaryFolder folder;
  const Scene scene = box(folder);
  for (const PictureView& view :
       {named_view("front"), named_view("side"), named_view("top"), PictureView{"own", 30, 40}}) {
    const Picture picture = draw_picture(scene, bare(view));
    const double a = radians(view.azimuth_deg), e = radians(view.elevation_deg);
    const double expected_m2 = 0.4 * 0.1 * std::abs(std::sin(a)) * std::cos(e) +
                               0.2 * 0.1 * std::abs(std::cos(a)) * std::cos(e) + 0.2 * 0.4 * std::sin(e);
    const double scale = picture.panels[0].metres_per_pixel;
    EXPECT_NEAR(covered_pixels(picture.image), expected_m2 / (scale * scale), allowed(1.5 / scale))
        << view.name;
  }
}

TEST(Pictures, TheViewIsFilledAndNothingIsCutOff) {
  const TemporaryFolder folder;
  for (const double fov : {0.0, 60.0}) {
    PictureOptions options = bare({"own", 120, 20});
    options.fov_deg = fov;
    const Picture picture = draw_picture(box(folder), options);
    const PicturePanel& panel = picture.panels[0];
    int left = picture.image.width, right = 0, top = picture.image.height, bottom = 0;
    for (int y = 0; y < picture.image.height; ++y)
      for (int x = 0; x < picture.image.width; ++x)
        if (picture.image.alpha[static_cast<std::size_t>(y * picture.image.width + x)] > 0)
          left = std::min(left, x), right = std::max(right, x), top = std::min(top, y),
          bottom = std::max(bottom, y);
    EXPECT_GE(left, panel.left) << fov;
    EXPECT_LT(right, panel.left + panel.width) << fov;
    // What is wider than high goes from side to side; perspective is fitted about the scene's middle.
    if (fov == 0) {
      EXPECT_LE(left, panel.left + 1);
      EXPECT_GE(right, panel.left + panel.width - 2);
    }
    EXPECT_GT(top, panel.top) << fov;
    EXPECT_LT(bottom, panel.top + panel.height - 1) << fov;
  }
}

TEST(Pictures, TheBarIsAsLongAsItSays) {
  PictureOptions options = bare(named_view("front"));
  options.scale_bar = true, options.transparent = false;
  const Picture picture = draw_picture(two_balls(), options);
  const PicturePanel& panel = picture.panels[0];
  double dark = 0, span = 0;
  for (int x = 0; x < picture.image.width; ++x) {
    dark += pixel(picture.image, x, panel.bar_top + 1)[0] < 128 ? 1 : 0;
    span += pixel(picture.image, x, panel.top + panel.height / 2)[0] < 250 ? 1 : 0;
  }
  // From one ball's outer side to the other's there are 0.6 m, and 0.2 m of them are white.
  EXPECT_NEAR(dark / span, panel.bar_m / 0.4, 2.0 / span * (1 + panel.bar_m / 0.4));  // a pixel at each end
  EXPECT_EQ(panel.bar_m, 0.2);  // 1, 2, 5 times a power of ten, and 0.35 of 0.6 m at most
}

// Shading multiplies the colour, in linear light: what the material's colour makes of it is one number.
TEST(Pictures, MaterialsHaveTheColoursOfTheLegend) {
  PictureOptions options = bare(named_view("front"));
  options.transparent = false, options.legend = true;
  const Picture picture = draw_picture(two_balls(), options);
  const PicturePanel& panel = picture.panels[0];
  ASSERT_EQ(picture.colouring.entries.size(), 2u);
  const double middle = panel.left + panel.width / 2.0, height = panel.top + panel.height / 2.0;
  for (std::size_t k = 0; k < 2; ++k) {
    const Rgb& colour = picture.colouring.entries[k].colour;
    const Rgb seen = pixel(picture.image, middle + (k == 0 ? -0.2 : 0.2) / panel.metres_per_pixel, height);
    const double light = linear_of_srgb(seen[1] / 255.0) / linear_of_srgb(colour[1] / 255.0);
    for (const std::size_t c : {0u, 2u})  // half a step of 8 bits in each
      EXPECT_NEAR(seen[c], 255 * srgb_of_linear(light * linear_of_srgb(colour[c] / 255.0)), 1.5)
          << k << " " << c;
    EXPECT_GT(light, 0.2);
    bool in_legend = false;
    for (int y = 0; y < picture.image.height; ++y)
      for (int x = panel.left + panel.width + 10; x < picture.image.width; ++x)
        in_legend |= pixel(picture.image, x, y) == colour;
    EXPECT_TRUE(in_legend) << k;
  }
  EXPECT_EQ(picture.colouring.entries[0].label, "leaf");
  EXPECT_EQ(picture.colouring.entries[1].label, "stem");
}

TEST(Pictures, NumbersGoFromTheScalesLowEndToItsHighEnd) {
  Scene scene = two_balls();
  scene.prototypes[1].shapes = {sphere({0, 0, 0}, 2 * ball_radius_m, 1)};
  std::vector<PictureParts> parts;
  for (const Prototype& prototype : scene.prototypes) parts.push_back(picture_parts(scene, prototype));
  const Colouring area = make_colouring(scene, parts, "area");
  EXPECT_TRUE(area.is_scale);
  EXPECT_NEAR(area.low, 4 * pi * 0.01, 1e-7);  // radii are floats
  EXPECT_NEAR(area.high, 16 * pi * 0.01, 1e-7);
  EXPECT_EQ(area.colour_of[0][0], scale_colour(0));
  EXPECT_EQ(area.colour_of[1][0], scale_colour(1));
  EXPECT_THAT(known_colourings(scene, parts),
              ::testing::ElementsAre("organ", "material", "kind", "plant", "area", "height"));
  BPMS_EXPECT_ERROR(make_colouring(scene, parts, "aera"), ErrorKind::bad_input, "did you mean 'area'");
  BPMS_EXPECT_ERROR(make_colouring(scene, parts, "length"), ErrorKind::bad_input, "no part of this has one");
}

TEST(Pictures, CarriedNumbersColourTheOrgansThatHaveThem) {
  const TemporaryFolder folder;
  Scene scene = box(folder);
  Mesh mesh = *scene.prototypes[0].mesh;
  mesh.organs.push_back(mesh.organs[0]);
  mesh.organs.push_back(mesh.organs[0]);
  mesh.organs[0].properties = {{"age_d", "12"}, {"variety", "Soissons"}};
  mesh.organs[1].properties = {{"age_d", "20"}};
  scene.prototypes[0].mesh = std::make_shared<const Mesh>(mesh);
  scene.prototypes[0].material_of_organ.resize(3, 0);
  const std::vector<PictureParts> parts{picture_parts(scene, scene.prototypes[0])};
  const Colouring age = make_colouring(scene, parts, "age_d");
  EXPECT_EQ(age.low, 12);
  EXPECT_EQ(age.high, 20);
  EXPECT_TRUE(age.some_without_value);
  EXPECT_EQ(age.colour_of[0][2], no_value_colour);
  BPMS_EXPECT_ERROR(make_colouring(scene, parts, "variety"), ErrorKind::bad_input,
                    "nothing here has the name");
}

TEST(Pictures, TheSameOnAnyNumberOfThreads) {
  PictureOptions options = bare({"own", 10, 20});
  options.samples = 4;
  std::string first;
  for (const int count : {1, 3}) {
    set_threads(count);
    const std::string bytes = encode_png(draw_picture(two_balls(), options).image);
    if (first.empty()) first = bytes;
    EXPECT_EQ(bytes, first) << count;
  }
  set_threads(0);
}

TEST(Pictures, NothingToSeeIsSaid) {
  Scene scene;
  scene.domain.periodic = false;
  BPMS_EXPECT_ERROR(picture_subject(scene, "void.toml"), ErrorKind::bad_input, "void.toml: nothing to see");
}

TEST(Pictures, AGroundPlaneIsAsLargeAsTheDomain) {
  Scene scene = two_balls();
  scene.domain.periodic = true;
  scene.domain.size_m = {2, 3};
  scene.ground = Ground{-0.5, 1, nullptr, false};
  scene = picture_subject(scene, "ground");
  ASSERT_EQ(scene.instances.size(), 3u);
  const PictureParts parts = picture_parts(scene, scene.prototypes.back());
  EXPECT_EQ(parts.parts[0].kind, "ground");
  EXPECT_EQ(parts.parts[0].material, "stem");
  EXPECT_DOUBLE_EQ(parts.parts[0].area_m2, 6);
  EXPECT_FALSE(scene.domain.periodic);
}

TEST(Pictures, EveryPrintableLetterHasStrokes) {
  const std::vector<Stroke> unknown = text_strokes("\u4e16", {0, 0}, 6);
  for (char c = '!'; c <= '~'; ++c) {
    const std::vector<Stroke> strokes = text_strokes(std::string(1, c), {0, 0}, 6);
    EXPECT_FALSE(strokes.empty()) << c;
    const bool box =
        strokes.size() == unknown.size() &&
        std::equal(strokes.begin(), strokes.end(), unknown.begin(),
                   [](const Stroke& a, const Stroke& b) { return a.from == b.from && a.to == b.to; });
    EXPECT_FALSE(box) << c;
  }
  EXPECT_GT(text_width("ab", 6), text_width("a", 6) + text_width("b", 6));  // and the gap between
}

TEST(Pictures, LengthsInWordsAndTicks) {
  EXPECT_EQ(length_in_words(0.05), "5 cm");
  EXPECT_EQ(length_in_words(2e-3), "2 mm");
  EXPECT_EQ(length_in_words(500), "500 m");
  EXPECT_EQ(nice_below(0.37), 0.2);
  EXPECT_EQ(nice_below(5), 5);
  EXPECT_THAT(tick_labels(0, 1, 3), ::testing::ElementsAre("0", "0.5", "1"));
  EXPECT_THAT(tick_labels(100, 100.02, 3), ::testing::ElementsAre("100", "100.01", "100.02"));
}

// The viewer's triangles, part by part: a hexagon has its disc's area, an organ all its own.
TEST(Pictures, PartsOfTheViewerKeepTheirAreas) {
  const TemporaryFolder folder;
  Scene scene = box(folder);
  Prototype& prototype = scene.prototypes[0];
  prototype.discs = {{{0, 0, 1}, 0.3f, {0, 0, 1}}, {{1, 0, 1}, 0.2f, {0, 1, 0}}};
  prototype.shapes = {sphere({0, 0, 2}, 0.5)};
  const PictureParts parts = picture_parts(scene, prototype);
  const PartMesh mesh = part_mesh(prototype, parts);
  ASSERT_EQ(parts.parts.size(), 3u);
  ASSERT_EQ(mesh.first_triangle.size(), 4u);
  ASSERT_EQ(mesh.first_vertex.back(), mesh.positions_m.size());
  const double expected[] = {2 * (0.2 * 0.4 + 0.2 * 0.1 + 0.4 * 0.1), pi * (0.09 + 0.04), pi};
  // Floats; a sphere of 16 x 8 facets lies within, by 5 percent of its area.
  const double tolerance[] = {1e-6, 1e-6, 0.05 * pi};
  for (std::size_t k = 0; k < 3; ++k) {
    double area = 0;
    for (std::size_t t = mesh.first_triangle[k]; t < mesh.first_triangle[k + 1]; ++t) {
      std::array<Eigen::Vector3d, 3> corner;
      for (std::size_t c = 0; c < 3; ++c) {
        const std::uint32_t vertex = mesh.triangles[t][c];
        EXPECT_GE(vertex, mesh.first_vertex[k]);
        EXPECT_LT(vertex, mesh.first_vertex[k + 1]);
        corner[c] = mesh.positions_m[vertex].cast<double>();
      }
      area += 0.5 * (corner[1] - corner[0]).cross(corner[2] - corner[0]).norm();
    }
    EXPECT_NEAR(area, expected[k], tolerance[k]) << k;
  }
}

}  // namespace
}  // namespace bpms::test
