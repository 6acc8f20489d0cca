#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "apps/bpms/verb.h"
#include "apps/bpms/verbs.h"
#include "core/atomic_file.h"
#include "core/error.h"
#include "core/nearest.h"
#include "core/progress.h"
#include "core/text.h"
#include "core/units.h"
#include "scene/importers/any_scene.h"
#include "scene/pictures/picture.h"
#include "scene/pictures/subject.h"
#include "scene/pictures/viewer_document.h"

namespace bpms {
namespace {

struct ViewArguments {
  std::string file;
  std::vector<std::string> views;
  std::string size, tolerance, colour = "material";
  double azimuth_deg = 215, elevation_deg = 30, fov_deg = 0;
  bool direction = false;  // azimuth or elevation was given
  bool transparent = false, no_legend = false, no_scale_bar = false;
  int samples = 16;
};

constexpr const char* view_mark = "{view}";
constexpr double picture_tolerance_m = 1e-4;

MeshOptions mesh_options(double tolerance_m) {
  MeshOptions out;
  out.tolerance_m = tolerance_m;
  out.parameters = true;
  return out;
}

double tolerance_of(const std::string& text) {
  constexpr double least_m = 1e-7, most_m = 1;
  const double out = parse_length(text, {"--tolerance"});
  if (!(out >= least_m && out <= most_m))
    bad_input({"--tolerance"}, "{}: expected a length from 0.0001mm to 1m", in_quotes(text));
  return out;
}

void read_size(const std::string& text, PictureOptions& out) {
  if (text.empty()) return;
  constexpr long long least = 64, most = 16384;
  const std::size_t cross = text.find('x');
  const auto width = parse_integer(text.substr(0, cross));
  const auto height = cross == std::string::npos ? width : parse_integer(text.substr(cross + 1));
  if (!width || !height || cross == std::string::npos || std::min(*width, *height) < least ||
      std::max(*width, *height) > most)
    bad_input({"--size"}, "{}: expected pixels such as 1200x900, each from {} to {}", in_quotes(text), least,
              most);
  out.width = static_cast<int>(*width), out.height = static_cast<int>(*height);
}

PictureOptions picture_options(const ViewArguments& options) {
  PictureOptions out;
  read_size(options.size, out);
  for (const std::string& name : options.views) out.views.push_back(named_view(name));
  if (out.views.empty())
    out.views.push_back({options.direction ? "own" : "oblique", options.azimuth_deg, options.elevation_deg});
  out.fov_deg = options.fov_deg;
  out.colour = options.colour;
  out.transparent = options.transparent;
  out.legend = !options.no_legend, out.scale_bar = !options.no_scale_bar;
  out.samples = options.samples;
  return out;
}

Scene subject(const ViewArguments& options, double tolerance_m) {
  return picture_subject(read_any_scene(options.file, mesh_options(tolerance_m)), options.file);
}

// For a page: as fine as can be drawn smoothly.
Scene subject_for_page(const ViewArguments& options) {
  constexpr std::uint64_t most_triangles = 2'000'000;
  if (!options.tolerance.empty()) return subject(options, tolerance_of(options.tolerance));
  Scene out;
  for (const double tolerance_m : {1e-4, 5e-4, 2e-3}) {
    out = subject(options, tolerance_m);
    if (drawn_triangles(out) <= most_triangles) {
      if (tolerance_m > picture_tolerance_m)
        out.notes.push_back(fmt::format("plants are drawn to within {} (--tolerance says otherwise)",
                                        length_in_words(tolerance_m)));
      return out;
    }
  }
  out.notes.push_back(
      fmt::format("{:.1f} million triangles: expect the page to turn slowly without a good "
                  "graphics card; a smaller stand or coarser meshes help",
                  1e-6 * static_cast<double>(drawn_triangles(out))));
  return out;
}

Json picture_json(const Picture& picture) {
  Json panels = Json::array();
  for (const PicturePanel& panel : picture.panels)
    panels.push_back({{"view", panel.view.name},
                      {"azimuth_deg", panel.view.azimuth_deg},
                      {"elevation_deg", panel.view.elevation_deg},
                      {"metres_per_pixel", panel.metres_per_pixel},
                      {"bar_m", panel.bar_m}});
  Json legend = Json::array();
  for (const auto& entry : picture.colouring.entries)
    legend.push_back({{"label", entry.label}, {"colour", hex_colour(entry.colour)}});
  Json out{{"width_px", picture.image.width},
           {"height_px", picture.image.height},
           {"colour", picture.colouring.name},
           {"panels", panels}};
  if (picture.colouring.is_scale)
    out["scale"] = {
        {"title", picture.colouring.title}, {"low", picture.colouring.low}, {"high", picture.colouring.high}};
  else
    out["legend"] = legend;
  return out;
}

// One file with all views, or, where its name says {view}, one for each.
std::vector<std::pair<std::string, PictureOptions>> pictures_of(const std::string& output,
                                                                const PictureOptions& all) {
  const std::size_t mark = output.find(view_mark);
  if (mark == std::string::npos) return {{output, all}};
  std::vector<std::pair<std::string, PictureOptions>> out;
  for (const PictureView& view : all.views) {
    PictureOptions one = all;
    one.views = {view};
    out.emplace_back(std::string(output).replace(mark, std::string(view_mark).size(), view.name), one);
  }
  return out;
}

void note_all(const Scene& scene) {
  for (const std::string& message : scene.notes) note(message);
}

Provenance made_from(const Cli& cli, const ViewArguments& options, const Scene& scene) {
  Provenance out = provenance(cli);
  out.add_input(options.file);
  for (const std::string& input : scene.inputs)
    if (input != options.file) out.add_input(input);
  return out;
}

Json counts(const Scene& scene) {
  return {{"instances", scene.instances.size()},
          {"prototypes", scene.prototypes.size()},
          {"triangles", drawn_triangles(scene)},
          {"notes", scene.notes}};
}

void run_picture(const Cli& cli, const ViewArguments& options) {
  const auto pictures = pictures_of(cli.common.output, picture_options(options));
  std::vector<std::string> files;
  for (const auto& picture : pictures) files.push_back(picture.first);
  require_outputs(cli, files);
  const Scene scene =
      subject(options, options.tolerance.empty() ? picture_tolerance_m : tolerance_of(options.tolerance));
  note_all(scene);
  Json report = counts(scene);
  report["pictures"] = Json::array();
  for (const auto& [file, how] : pictures) {
    const Picture picture = draw_picture(scene, how);
    write_file(file, encode_png(picture.image), cli.common.overwrite);
    report["pictures"].push_back({{"file", file}});
    report["pictures"].back().update(picture_json(picture));
  }
  deliver_report(cli, "view", report, made_from(cli, options, scene));
}

void run_page(const Cli& cli, const ViewArguments& options) {
  const Scene scene = subject_for_page(options);
  note_all(scene);
  const Provenance from = made_from(cli, options, scene);
  const std::string name = std::filesystem::path(options.file).filename().string();
  Json document = viewer_document(scene, name, options.colour);
  document["version"] = version();
  document["provenance"] = from.json();
  const std::string page = viewer_page(document);
  write_file(cli.common.output, page, cli.common.overwrite);
  Json report = counts(scene);
  report["page"] = {{"file", cli.common.output}, {"bytes", page.size()}};
  deliver_report(cli, "view", report, from);
}

void run(const Cli& cli, const ViewArguments& options) {
  const std::string& output = require_output(cli);
  if (output.ends_with(".png")) return run_picture(cli, options);
  if (output.ends_with(".html")) return run_page(cli, options);
  bad_input({output}, "expected a name that ends in .png (a picture) or .html (to turn and look into)");
}

}  // namespace

void add_view(Cli& cli) {
  auto options = std::make_shared<ViewArguments>();
  CLI::App* verb = add_verb(
      cli, "view", "a picture (PNG) of a plant, a canopy or a scene, or a page (HTML) to look into it",
      "bpms view canopy.toml --views front,top --colour length -o stand.png",
      [&cli, options] { run(cli, *options); });
  verb->add_option("file", options->file, "plant (.bpms), canopy.toml, scene.toml or mesh file")->required();
  CLI::Option* views =
      verb->add_option(
              "--views", options->views,
              "front, back, side, left, top, oblique: side by side, or a file each with -o NAME_{view}.png")
          ->delimiter(',');
  const auto given = [options](const std::string&) { options->direction = true; };
  verb->add_option("--azimuth", options->azimuth_deg,
                   "of the direction to the eye, degrees clockwise from north (default 215)")
      ->check(CLI::Range(-360.0, 360.0))
      ->excludes(views)
      ->each(given);
  verb->add_option("--elevation", options->elevation_deg,
                   "of the eye above the horizon, degrees (default 30)")
      ->check(CLI::Range(-90.0, 90.0))
      ->excludes(views)
      ->each(given);
  verb->add_option("--fov", options->fov_deg,
                   "perspective: degrees across the larger side (default: orthographic)")
      ->check(CLI::Range(1.0, 150.0));
  verb->add_option("--size", options->size, "of the whole picture (default 1200x900; views 500x640 each)");
  verb->add_option(
      "--colour", options->colour,
      "organ, material (default), kind, plant, length, area, height, leaf_inclination, or a property");
  verb->add_option(
      "--tolerance", options->tolerance,
      "largest distance between triangles and surface (default 0.1mm; pages of large stands: more)");
  verb->add_option("--samples", options->samples, "rays for each pixel (default 16)")
      ->check(CLI::Range(1, 4096));
  verb->add_flag("--transparent", options->transparent, "no background");
  verb->add_flag("--no-legend", options->no_legend, "without the legend");
  verb->add_flag("--no-scale-bar", options->no_scale_bar, "without the bar of known length");
}

}  // namespace bpms
