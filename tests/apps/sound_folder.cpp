#include "tests/apps/sound_folder.h"

#include <gtest/gtest.h>

#include "calibrate/adjustment/synthetic.h"
#include "core/png.h"
#include "tests/calibrate/rendered_board.h"

namespace bpms::test {
namespace {

constexpr const char* grass = R"(units cm
[s[+l]h]
s { material stem  a_length 12  a_radius 0.2 }
+ { a_twist 20  a_inclination 5 }
l { material leaf  a_length 25  a_width 1.2  f_inclination p 15 40 30 }
h { material head  a_length 6  a_radius 0.4 }
)";

constexpr const char* canopy = R"([domain]
size_m = [1.0, 1.0]
boundary = "periodic"
[[plants]]
file = "grass.bpms"
scale = { mean = 1.0, sd = 0.05 }
rotation = { type = "uniform" }
[planting]
pattern = "rows"
row_spacing_m = 0.5
density_per_m2 = 8.0
)";

constexpr const char* scene = R"([domain]
size_m = [1.0, 1.0]
boundary = "periodic"
[materials.leaf]
type = "bilambertian"
reflectance = 0.4
transmittance = 0.3
[materials.soil]
type = "lambertian"
reflectance = "soil.csv"
[ground]
type = "plane"
material = "soil"
[prototypes.crown]
discs = "crown.def"
material = "leaf"
[[instances]]
prototype = "crown"
positions = "places.def"
[illumination]
sun = { zenith_deg = 30.0, azimuth_deg = 0.0, irradiance = "brf" }
[[sensors]]
name = "nadir"
type = "brf"
views = [[0.0, 0.0]]
[bands]
wavelengths_nm = [650.0]
[sampling]
samples = 64
)";

constexpr const char* planted_scene = R"(canopy = "canopy.toml"
[materials]
leaf = { type = "bilambertian", reflectance = 0.4, transmittance = 0.3 }
stem = { type = "lambertian", reflectance = 0.2 }
head = { type = "lambertian", reflectance = 0.2 }
[illumination]
sky = { type = "isotropic", radiance = 1.0 }
[[sensors]]
name = "above"
type = "perspective"
location = [0, 0, 3]
look_at = [0, 0, 0]
fov_deg = 20
width_px = 4
height_px = 4
[sampling]
samples = 32
)";

// Two pinholes, 1000 px and 100 mm apart; the leaf stands 1 m before them.
constexpr const char* rig = R"(units = "m"
pixel_centre = "integer"
[[cameras]]
name = "left"
size_px = [640, 480]
model = "brown_conrady"
parameters = [1000.0, 1000.0, 320.0, 240.0]
cam_from_rig = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0]]
[[cameras]]
name = "right"
size_px = [640, 480]
model = "brown_conrady"
parameters = [1000.0, 1000.0, 320.0, 240.0]
cam_from_rig = [[1, 0, 0, -0.1], [0, 1, 0, 0], [0, 0, 1, 0]]
[covariance]
order = ["left.fx", "right.fx"]
matrix = [[1.0, 0.5], [0.5, 1.0]]
)";

std::string points() {
  std::string out = "plant,axis,rank,organ,feature,point,view,camera,u_px,v_px,sigma_px\n";
  for (int k = 0; k < 5; ++k) {
    out += fmt::format("1,1,1,leaf,midrib,{0},a,left,{1},{2},0.5\n", k, 320 + 2 * k * k, 240 - 20 * k);
    out += fmt::format("1,1,1,leaf,midrib,{0},a,right,{1},{2},0.5\n", k, 220 + 2 * k * k, 240 - 20 * k);
  }
  return out;
}

std::string vectors() {
  std::string out = "plant,axis,rank,organ,feature,point,x_m,y_m,z_m,xx,xy,xz,yy,yz,zz\n";
  for (int k = 0; k < 8; ++k)
    out += fmt::format("1,1,1,leaf,midrib,{},{:.6f},0,{:.6f},1e-8,0,0,1e-8,0,1e-8\n", k, 0.002 * k * k,
                       0.03 * k - 0.001 * k * k);
  return out;
}

std::string leaves() {
  std::string out = "leaf,x,y\n";
  for (int leaf = 1; leaf <= 2; ++leaf) {
    for (int k = 0; k < 8; ++k)
      out += fmt::format("{},{:.2f},{:.2f}\n", leaf, 0.2 * k * k, 3 * k - 0.1 * k * k);
  }
  return out;
}

std::string corners() {
  const Observations seen = observe(synthetic_calibration({.cameras = 1, .frames = 5}), 0.1, 1);
  std::string out = "# filename x y level\n";
  for (const BoardView& view : seen.views) {
    for (const ImageCorner& corner : view.corners)
      out += fmt::format("{} {:.4f} {:.4f} 0\n", view.image, corner.pixel.x(), corner.pixel.y());
  }
  return out;
}

// The bytes as they lie there; read_file would unpack what is compressed.
std::string text_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace

SoundFolder::SoundFolder() {
  write("grass.bpms", grass);
  write("canopy.toml", canopy);
  write("scene.toml", scene);
  write("planted.toml", planted_scene);
  write("soil.csv", "nm,reflectance\n400,0.1\n700,0.2\n1000,0.25\n");
  write("crown.def", "0.05 0 0 0.5 0 0 1\n0.05 0.2 0 0.6 0 1 1\n");
  write("places.def", "0 0 0\n0.3 0.2 0 45\n");
  write("leaf.obj", "o leaf\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  write("rig.toml", rig);
  write("points.csv", points());
  write("vectors.csv", vectors());
  write("leaves.csv", leaves());
  write("corners.vnl", corners());
  write("board.toml", "kind = \"chessboard\"\ncolumns = 9\nrows = 6\nsquare_m = 0.025\n");
  write("fit.json", "{\"report\": \"fit\",\n \"organs\": [],\n \"summary\": {}}\n");
}

std::map<std::string, std::string> content_of(const TemporaryFolder& folder) {
  std::map<std::string, std::string> out;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder / "."))
    out[entry.path().string()] = entry.is_directory() ? "/" : text_of(entry.path().string());
  return out;
}

Edit as_it_is() {
  return [](const TemporaryFolder&) {};
}

Edit replaced(const std::string& file, const std::string& what, const std::string& by) {
  return [=](const TemporaryFolder& folder) {
    std::string text = text_of(folder / file);
    const std::size_t at = text.find(what);
    ASSERT_NE(at, std::string::npos) << file << " does not hold " << what;
    folder.write(file, text.replace(at, what.size(), by));
  };
}

Edit written(const std::string& file, const std::string& content) {
  return [=](const TemporaryFolder& folder) { folder.write(file, content); };
}

Edit removed(const std::string& file) {
  return [=](const TemporaryFolder& folder) { std::filesystem::remove(folder / file); };
}

namespace {
Edit cut_at(const std::string& file, const std::string& mark, std::size_t behind) {
  return [=](const TemporaryFolder& folder) {
    const std::string text = text_of(folder / file);
    const std::size_t at = text.find(mark);
    ASSERT_NE(at, std::string::npos) << file << " does not hold " << mark;
    folder.write(file, text.substr(0, at + behind));
  };
}
}  // namespace

Edit cut_behind(const std::string& file, const std::string& last) {
  return cut_at(file, last, last.size());
}

Edit cut_before(const std::string& file, const std::string& first) {
  return cut_at(file, first, 0);
}

Edit a_folder_instead(const std::string& file) {
  return [=](const TemporaryFolder& folder) {
    std::filesystem::remove(folder / file);
    std::filesystem::create_directory(folder / file);
  };
}

Edit both(Edit first, Edit second) {
  return [=](const TemporaryFolder& folder) {
    first(folder);
    second(folder);
  };
}

Edit board_images(int count) {
  return [=](const TemporaryFolder& folder) {
    const Target target = parse_target("chessboard:9x6:20mm");
    for (int k = 1; k <= count; ++k)
      cv::imwrite(folder / fmt::format("left{}.png", k),
                  render(target, look_at(target, 25 * k, 15 + 10 * k)));
  };
}

Edit blank_image(const std::string& file, int width, int height) {
  return [=](const TemporaryFolder& folder) {
    const auto bytes = static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 3;
    folder.write(file, encode_png({width, height, std::vector<std::uint8_t>(bytes, 90)}));
  };
}

}  // namespace bpms::test
