#include <CLI/Option.hpp>
#include <algorithm>
#include <filesystem>

#include "apps/bpms/verb.h"
#include "apps/bpms/verbs.h"
#include "core/atomic_file.h"
#include "core/error.h"
#include "core/progress.h"
#include "core/text.h"
#include "core/toml.h"
#include "plant/canopy/overlap.h"
#include "scene/importers/any_scene.h"
#include "scene/structure/structure_report.h"
#include "scene/structure/without_materials.h"
#include "simulate/materials/leaf_optics.h"

namespace bpms {
namespace {

struct DescribeArguments {
  std::string file;
  StructureOptions structure;
  std::string zenith;
  std::string reflectance, transmittance, materials, incidence = "0,30,60";
  int fisheye = 0;
  std::string fisheye_at;
  MeshFileArguments mesh;
  std::vector<std::string> without;  // materials
  bool rays_given = false;
  bool overlap = false;
};

std::vector<std::string> pieces(const std::string& text, char separator) {
  std::vector<std::string> out;
  std::size_t from = 0;
  while (true) {
    const std::size_t to = text.find(separator, from);
    out.push_back(text.substr(from, to - from));
    if (to == std::string::npos) return out;
    from = to + 1;
  }
}

double option_number(const std::string& option, const std::string& text, double low, double high) {
  const std::optional<double> value = parse_number(text);
  if (!value || *value < low || *value > high)
    throw Error(ErrorKind::bad_input, fmt::format("{}: {} where a number from {:g} to {:g} is expected",
                                                  option, in_quotes(text), low, high));
  return *value;
}

std::vector<double> option_numbers(const std::string& option, const std::string& text, double low,
                                   double high) {
  std::vector<double> out;
  for (const std::string& piece : pieces(text, ',')) out.push_back(option_number(option, piece, low, high));
  return out;
}

Scene read_structure(const DescribeArguments& options) {
  Scene scene = read_any_scene(options.file, traced_plants(), options.mesh);
  if (scene.instances.empty())
    bad_input({options.file}, "no plants and no [[instances]]: there is no structure to describe");
  if (!options.without.empty()) return without_materials(std::move(scene), options.without);
  return scene;
}

// "0.1" for all leaves, or "leaf=0.1,flag=0.2" by material.
void add_optics(const std::string& option, const std::string& text, const SurfaceSums& surface,
                double LeafOptics::*which, BandOptics& band) {
  for (const std::string& piece : pieces(text, ',')) {
    const std::size_t equals = piece.rfind('=');
    const double value =
        option_number(option, equals == std::string::npos ? piece : piece.substr(equals + 1), 0, 1);
    if (equals == std::string::npos) {
      for (const auto& of : surface.leaves_of_material) band.of_material[of.first].*which = value;
      continue;
    }
    const std::string name = piece.substr(0, equals);
    if (!surface.leaves_of_material.contains(name))
      throw Error(ErrorKind::bad_input,
                  fmt::format("{}: no leaves are of material {}", option, in_quotes(name)));
    band.of_material[name].*which = value;
  }
}

std::vector<BandOptics> leaf_bands(const DescribeArguments& options, const SurfaceSums& surface,
                                   std::vector<std::string>& inputs) {
  const bool by_hand = !options.reflectance.empty() || !options.transmittance.empty();
  if (by_hand && !options.materials.empty())
    throw Error(ErrorKind::bad_input,
                "--materials and --rho, --tau both give the optics of leaves: choose one");
  if (!options.materials.empty()) {
    std::vector<std::string> names;
    for (const auto& of : surface.leaves_of_material) names.push_back(of.first);
    SceneOptics optics = read_leaf_optics(options.materials, names);
    inputs.insert(inputs.end(), optics.inputs.begin(), optics.inputs.end());
    for (const std::string& message : optics.notes) note(message);
    return optics.bands;
  }
  if (!by_hand) return {};
  BandOptics band;
  add_optics("--rho", options.reflectance, surface, &LeafOptics::reflectance, band);
  if (!options.transmittance.empty())
    add_optics("--tau", options.transmittance, surface, &LeafOptics::transmittance, band);
  for (const auto& [name, of] : band.of_material) {
    constexpr double rounding = 1e-12;
    if (of.reflectance + of.transmittance > 1 + rounding)
      throw Error(ErrorKind::bad_input, fmt::format("--rho and --tau of {} add to {:g}, more than 1",
                                                    in_quotes(name), of.reflectance + of.transmittance));
  }
  return {band};
}

void add_fisheye(const DescribeArguments& options, const GapScene& rays, StructureReport& report) {
  if (options.fisheye <= 0) {
    if (!options.fisheye_at.empty()) throw Error(ErrorKind::bad_input, "--fisheye-at needs --fisheye PIXELS");
    return;
  }
  report.fisheye_at_m = rays.footprint().point(0.5, 0.5);
  if (!options.fisheye_at.empty()) {
    const std::vector<double> at = option_numbers("--fisheye-at", options.fisheye_at, -1e7, 1e7);
    if (at.size() != 2) throw Error(ErrorKind::bad_input, "--fisheye-at: expected X,Y in metres");
    report.fisheye_at_m = {at[0], at[1]};
  }
  report.fisheye = fisheye_picture(rays, report.fisheye_at_m, options.fisheye);
}

// Of the plants as they were planted: the scene knows them as instances only.
double canopy_overlap(const std::string& path) {
  const TomlDocument document = TomlDocument::read(path);
  if (!document.root().has("planting") && !document.root().has("plants"))
    bad_input({path}, "--overlap is for a canopy.toml");
  Canopy canopy = read_canopy(path);
  make_canopy_meshes(canopy);
  return overlap_fraction(canopy);
}

void run(const Cli& cli, DescribeArguments options) {
  options.structure.gaps.seed = cli.common.seed;
  if (!options.zenith.empty())
    options.structure.zenith_deg = option_numbers("--zenith", options.zenith, 0, 89.9);
  if (options.structure.gaps.target_se > 0 && !options.rays_given) options.structure.gaps.rays = 1u << 26;
  const std::vector<double> incidence = option_numbers("--incidence", options.incidence, 0, 90);
  const Scene scene = read_structure(options);
  std::vector<std::string> inputs = scene.inputs;
  const GapScene rays(scene);
  const CanopyStructure structure = canopy_structure(scene, rays, options.structure);
  StructureReport report;
  report.scene = &scene;
  report.structure = &structure;
  report.bands = leaf_bands(options, structure.surface, inputs);
  report.scattering = scattering_tables(structure.surface, report.bands, incidence);
  add_fisheye(options, rays, report);
  if (options.overlap) report.overlap = canopy_overlap(options.file);
  for (const std::string& message : scene.notes) note(message);
  for (const std::string& message : structure.notes) note(message);
  Provenance from = provenance(cli, true);
  from.add_input(options.file);
  for (const std::string& input : inputs)
    if (input != options.file) from.add_input(input);
  if (!cli.common.output.empty())
    write_file(require_output(cli), structure_csv(report), cli.common.overwrite);
  if (!cli.common.json) fmt::print("{}", structure_text(report));
  deliver_report(cli, "describe", structure_json(report), from);
}

}  // namespace

void add_describe(Cli& cli) {
  auto options = std::make_shared<DescribeArguments>();
  CLI::App* verb =
      add_verb(cli, "describe", "structure of a plant, a canopy, a scene or a mesh: areas, angles, G, gaps",
               "bpms describe canopy.toml --json\n  bpms describe tree.obj --leaves foliage -o tree.csv\n"
               "  bpms describe scene.toml --azimuths 12 --target-se 0.002 --fisheye 400 --report stand.html",
               [&cli, options] { run(cli, *options); });
  GapOptions& gaps = options->structure.gaps;
  verb->add_option("file", options->file,
                   "plant (.bpms), canopy.toml, scene.toml or mesh (.ply .obj .glb .gltf)")
      ->required();
  verb->add_option(
      "--zenith", options->zenith,
      "zenith angles of the gap fraction, degrees below 90: 0,30,57.5 (default 0 to 85 by 5, and 57.5)");
  verb->add_option_function<std::uint32_t>(
          "--rays",
          [options](std::uint32_t rays) { options->structure.gaps.rays = rays, options->rays_given = true; },
          "rays for each zenith angle (default 65536); with --target-se at most")
      ->check(CLI::Range(32, 1 << 28));
  verb->add_option("--target-se", gaps.target_se,
                   "ends a zenith angle when the standard errors of its gap fractions are below")
      ->check(CLI::Range(1e-6, 0.5));
  verb->add_option("--azimuths", options->structure.sectors,
                   "sectors of azimuth that gaps are told for (default 1)")
      ->check(CLI::Range(1, 360));
  verb->add_option("--layers", options->structure.layers, "layers of the profile of leaf area (default 20)")
      ->check(CLI::Range(1, 10000));
  verb->add_option(
      "--rho", options->reflectance,
      "reflectance of leaves, for their area scattering phase function: 0.1, or leaf=0.1,flag=0.12");
  verb->add_option("--tau", options->transmittance, "their transmittance, likewise (default 0)");
  verb->add_option("--materials", options->materials, "a scene.toml whose [materials] and [bands] give both");
  verb->add_option("--incidence", options->incidence, "zenith angles of the light for it (default 0,30,60)");
  verb->add_flag("--overlap", options->overlap,
                 "share of the leaf area of a canopy.toml that crosses other plants");
  verb->add_option("--fisheye", options->fisheye,
                   "a hemispherical picture of the gaps in the report, so many pixels wide")
      ->check(CLI::Range(16, 4096));
  verb->add_option("--fisheye-at", options->fisheye_at,
                   "where on the ground: X,Y in metres (default the middle)");
  verb->add_option("--without", options->without, "materials whose surfaces are left out, as dead leaves");
  verb->add_option("--leaves", options->mesh.leaves, "groups or materials of a mesh file that are leaves")
      ->delimiter(',');
  verb->add_option("--unit", options->mesh.unit, "unit of a mesh file: m, cm, mm ... (default m)");
  verb->add_option("--up", options->mesh.up,
                   "axis that is up in a mesh file (default y for glTF, z for the rest)")
      ->check(CLI::IsMember({"y", "z"}));
}

}  // namespace bpms
