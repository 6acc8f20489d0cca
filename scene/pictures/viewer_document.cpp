#include "scene/pictures/viewer_document.h"

#include <bit>
#include <cmath>
#include <map>

#include "core/base64.h"

namespace bpms {
namespace {

static_assert(std::endian::native == std::endian::little, "the arrays are written as they lie in memory");

template <class Number>
std::string base64_of(const std::vector<Number>& numbers) {
  return base64({reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(Number)});
}

Json point_json(const Eigen::Vector3f& p) {
  return {p.x(), p.y(), p.z()};
}

Json mesh_part_json(const PartMesh& mesh) {
  Eigen::Vector3f low = Eigen::Vector3f::Zero(), high = low;
  if (!mesh.positions_m.empty()) low = high = mesh.positions_m[0];
  for (const Eigen::Vector3f& p : mesh.positions_m) low = low.cwiseMin(p), high = high.cwiseMax(p);
  constexpr float steps = 65535.f;
  std::vector<std::uint16_t> coordinates;
  for (const Eigen::Vector3f& p : mesh.positions_m)
    for (int k = 0; k < 3; ++k) {
      const float width = high[k] - low[k];
      coordinates.push_back(
          static_cast<std::uint16_t>(width > 0 ? std::lround(steps * (p[k] - low[k]) / width) : 0));
    }
  std::vector<std::uint16_t> narrow;
  std::vector<std::uint32_t> wide;
  const bool is_narrow = mesh.positions_m.size() <= 65536;
  for (const auto& triangle : mesh.triangles)
    for (const std::uint32_t vertex : triangle) {
      if (is_narrow) narrow.push_back(static_cast<std::uint16_t>(vertex));
      if (!is_narrow) wide.push_back(vertex);
    }
  return {{"low", point_json(low)},
          {"high", point_json(high)},
          {"positions_u16", base64_of(coordinates)},
          {is_narrow ? "indices_u16" : "indices_u32", is_narrow ? base64_of(narrow) : base64_of(wide)},
          {"first_triangle_u32", base64_of(mesh.first_triangle)},
          {"first_vertex_u32", base64_of(mesh.first_vertex)}};
}

Json named_json(const Mesh::Organ::Named& named) {
  Json out = Json::object();
  for (const auto& [name, value] : named) out[name] = value;
  return out;
}

Json parts_json(const PictureParts& parts) {
  Json out = Json::array();
  for (const PicturePart& part : parts.parts) {
    Json one{{"label", part.label},
             {"kind", part.kind},
             {"material", part.material},
             {"length_m", json_number(part.length_m)},
             {"area_m2", json_number(part.area_m2)},
             {"height_m", json_number(part.height_m)},
             {"inclination_deg", json_number(part.inclination_deg)}};
    if (!part.properties.empty()) one["properties"] = named_json(part.properties);
    if (!part.parameters.empty()) one["parameters"] = named_json(part.parameters);
    out.push_back(std::move(one));
  }
  return out;
}

// Poses of each prototype's instances: x, y, z, the quaternion's x, y, z, w, and the scale.
Json instances_json(const Scene& scene) {
  struct Group {
    std::vector<float> poses;
    std::vector<std::uint32_t> plants;
  };
  std::map<std::uint32_t, Group> groups;
  for (std::uint32_t k = 0; k < scene.instances.size(); ++k) {
    const Instance& instance = scene.instances[k];
    Group& group = groups[instance.prototype];
    const Eigen::Vector3f at = instance.position_m.cast<float>();
    const Eigen::Quaternionf turned = instance.rotation.quaternion().cast<float>();
    for (const float value : {at.x(), at.y(), at.z(), turned.x(), turned.y(), turned.z(), turned.w(),
                              static_cast<float>(instance.scale)})
      group.poses.push_back(value);
    group.plants.push_back(instance.plant == no_plant ? k : instance.plant);
  }
  Json out = Json::array();
  for (const auto& [prototype, group] : groups)
    out.push_back({{"prototype", prototype},
                   {"count", group.plants.size()},
                   {"poses_f32", base64_of(group.poses)},
                   {"plants_u32", base64_of(group.plants)}});
  return out;
}

Json colouring_json(const Colouring& colouring) {
  Json entries = Json::array(), colours = Json::array(), scale = nullptr;
  for (const auto& entry : colouring.entries)
    entries.push_back({{"label", entry.label}, {"colour", hex_colour(entry.colour)}});
  for (const std::vector<Rgb>& of : colouring.colour_of) colours.push_back(base64_of(of));
  if (colouring.is_scale) {
    constexpr int stops = 9;
    scale = {{"low", colouring.low}, {"high", colouring.high}, {"colours", Json::array()}};
    for (int k = 0; k < stops; ++k)
      scale["colours"].push_back(hex_colour(scale_colour(static_cast<double>(k) / (stops - 1))));
    if (colouring.some_without_value) scale["no_value"] = hex_colour(no_value_colour);
  }
  return {{"name", colouring.name},
          {"title", colouring.title},
          {"entries", entries},
          {"scale", scale},
          {"colour_of_part_rgb8", colours}};
}

}  // namespace

Json viewer_document(const Scene& scene, const std::string& title, const std::string& colour) {
  std::vector<PictureParts> parts;
  Json prototypes = Json::array(), colourings = Json::array();
  for (const Prototype& prototype : scene.prototypes) {
    parts.push_back(picture_parts(scene, prototype));
    Json one{{"name", prototype.name}};
    one.update(mesh_part_json(part_mesh(prototype, parts.back())));
    one["parts"] = parts_json(parts.back());
    prototypes.push_back(std::move(one));
  }
  make_colouring(scene, parts, colour);  // refuses what is not there
  for (const std::string& name : known_colourings(scene, parts))
    colourings.push_back(colouring_json(make_colouring(scene, parts, name)));
  return {{"title", title},
          {"prototypes", std::move(prototypes)},
          {"instances", instances_json(scene)},
          {"colourings", std::move(colourings)},
          {"colour", colour},
          {"triangles", drawn_triangles(scene)},
          {"notes", scene.notes}};
}

}  // namespace bpms
