#include "scene/structure/surface_sums.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/parallel.h"
#include "core/units.h"
#include "scene/structure/facets.h"

namespace bpms {
namespace {

constexpr std::size_t own_layers = 400;  // of a prototype's profile
constexpr int turns = 180;               // a cell of the orientation is as wide as one

// What one task adds up; tasks are merged in order.
struct Sums {
  Sums(std::size_t materials, double height_m, std::size_t layers)
      : leaf_profile(0, height_m, layers), other_profile(leaf_profile), areas(materials) {}
  std::map<std::uint32_t, FacetOrientation> leaves;  // by material
  FacetOrientation others;
  HeightProfile leaf_profile, other_profile;
  std::vector<SurfaceSums::OfMaterial> areas;
  double stem_m2 = 0;
};

void add_height(const Facet& facet, const Eigen::Matrix3d& turn, double scale, double raised, double area,
                HeightProfile& to) {
  const auto z = [&](const Eigen::Vector3d& p) { return scale * turn.row(2).dot(p) + raised; };
  if (facet.disc_radius_m > 0) {
    const double up = turn.row(2).dot(facet.area_vector.normalized());
    const double sine = std::sqrt(std::max(0.0, 1 - up * up));
    to.add_disc(z(facet.corners[0]), scale * static_cast<double>(facet.disc_radius_m) * sine, area);
  } else {
    to.add_triangle({z(facet.corners[0]), z(facet.corners[1]), z(facet.corners[2])}, area);
  }
}

class PrototypeSums {
 public:
  PrototypeSums(const Scene& scene, const Ground& ground, std::uint32_t prototype,
                const std::vector<std::uint32_t>& instances, const SurfaceSumsOptions& options, Sums& out)
      : scene_(scene),
        ground_(ground),
        prototype_(scene.prototypes[prototype]),
        instances_(instances),
        options_(options),
        out_(out) {}

  void add() {
    double factor = 0;
    for (const std::uint32_t i : instances_) factor += std::pow(scene_.instances[i].scale, 2);
    visit_facets(prototype_, [&](const Facet& facet) {
      const double area = factor * facet.area_vector.norm();
      (facet.leaf ? out_.areas[facet.material].leaf_m2 : out_.areas[facet.material].other_m2) += area;
      if (facet.organ != no_organ && prototype_.mesh->organs[facet.organ].kind == "stem")
        out_.stem_m2 += area;
    });
    const double facets = static_cast<double>(facet_count(prototype_));
    const double visits = facets * static_cast<double>(instances_.size());
    if (visits <= options_.most_turned || instances_.size() == 1)
      turn_one_by_one();
    else
      turn_together();
    if (visits <= options_.most_raised || instances_.size() == 1)
      heights_one_by_one();
    else
      heights_together();
  }

 private:
  FacetOrientation& orientation(const Facet& facet) {
    return facet.leaf ? out_.leaves[facet.material] : out_.others;
  }

  void turn_one_by_one() {
    for (const std::uint32_t i : instances_) {
      const Instance& instance = scene_.instances[i];
      const Eigen::Matrix3d turn = std::pow(instance.scale, 2) * instance.rotation.matrix();
      visit_facets(prototype_, [&](const Facet& facet) { orientation(facet).add(turn * facet.area_vector); });
    }
  }

  void turn_together() {
    std::map<std::uint32_t, FacetOrientation> own_leaves;
    FacetOrientation own_others;
    visit_facets(prototype_, [&](const Facet& facet) {
      (facet.leaf ? own_leaves[facet.material] : own_others).add(facet.area_vector);
    });
    const auto everything = [&](auto how) {
      for (const auto& of : own_leaves) how(of.second, out_.leaves[of.first]);
      how(own_others, out_.others);
    };
    std::vector<double> by_turn(turns);
    for (const std::uint32_t i : instances_) {
      const Instance& instance = scene_.instances[i];
      const double factor = std::pow(instance.scale, 2);
      if (!instance.rotation.upright()) {
        everything([&](const FacetOrientation& from, FacetOrientation& to) {
          to.add(from, factor, instance.rotation.matrix());
        });
        continue;
      }
      const Eigen::Vector3d x = instance.rotation * Eigen::Vector3d::UnitX();
      const double turn = std::atan2(x.y(), x.x()) / (2 * pi) * turns;
      by_turn[static_cast<std::size_t>(std::lround(turn) + turns) % turns] += factor;
    }
    for (std::size_t k = 0; k < by_turn.size(); ++k) {
      if (by_turn[k] > 0)
        everything([&](const FacetOrientation& from, FacetOrientation& to) {
          to.add(from, by_turn[k], 2 * pi * static_cast<double>(k) / turns);
        });
    }
  }

  void heights_one_by_one() {
    const bool level = !ground_.terrain;
    for (const std::uint32_t i : instances_) {
      const Instance& instance = scene_.instances[i];
      const Eigen::Matrix3d turn = instance.rotation.matrix();
      visit_facets(prototype_, [&](const Facet& facet) {
        double raised = instance.position_m.z() - ground_.height_m;
        if (!level) {
          const Eigen::Vector3d at = instance.position_m + instance.scale * (turn * facet.middle());
          raised = instance.position_m.z() - ground_.height_at(at.head<2>());
        }
        add_height(facet, turn, instance.scale, raised,
                   std::pow(instance.scale, 2) * facet.area_vector.norm(),
                   facet.leaf ? out_.leaf_profile : out_.other_profile);
      });
    }
  }

  void heights_together() {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    visit_facets(prototype_, [&](const Facet& facet) {
      const bool disc = facet.disc_radius_m > 0;
      for (std::size_t c = 0; c < (disc ? 1 : 3); ++c) {
        low = std::min(low, facet.corners[c].z() - static_cast<double>(facet.disc_radius_m));
        high = std::max(high, facet.corners[c].z() + static_cast<double>(facet.disc_radius_m));
      }
    });
    HeightProfile leaf(low, high, own_layers), other = leaf;
    visit_facets(prototype_, [&](const Facet& facet) {
      add_height(facet, Eigen::Matrix3d::Identity(), 1, 0, facet.area_vector.norm(),
                 facet.leaf ? leaf : other);
    });
    for (const std::uint32_t i : instances_) {
      const Instance& instance = scene_.instances[i];
      const double raised = instance.position_m.z() - ground_.height_at(instance.position_m.head<2>().eval());
      const double factor = std::pow(instance.scale, 2);
      if (instance.rotation.upright()) {
        out_.leaf_profile.add(leaf, instance.scale, raised, factor);
        out_.other_profile.add(other, instance.scale, raised, factor);
      } else {
        const Eigen::Matrix3d turn = instance.rotation.matrix();
        visit_facets(prototype_, [&](const Facet& facet) {
          add_height(facet, turn, instance.scale, raised, factor * facet.area_vector.norm(),
                     facet.leaf ? out_.leaf_profile : out_.other_profile);
        });
      }
    }
  }

  const Scene& scene_;
  const Ground& ground_;
  const Prototype& prototype_;
  const std::vector<std::uint32_t>& instances_;
  const SurfaceSumsOptions& options_;
  Sums& out_;
};

void merge(const Sums& from, const Scene& scene, SurfaceSums& out) {
  for (const auto& [material, facets] : from.leaves) {
    out.leaves.add(facets);
    out.leaves_of_material[scene.materials[material]].add(facets);
  }
  out.others.add(from.others);
  out.leaf_profile.add(from.leaf_profile);
  out.other_profile.add(from.other_profile);
  double other = 0;
  for (std::size_t m = 0; m < from.areas.size(); ++m) {
    const SurfaceSums::OfMaterial& area = from.areas[m];
    if (area.leaf_m2 == 0 && area.other_m2 == 0) continue;
    SurfaceSums::OfMaterial& to = out.materials[scene.materials[m]];
    to.leaf_m2 += area.leaf_m2;
    to.other_m2 += area.other_m2;
    out.leaf_area_m2 += area.leaf_m2;
    other += area.other_m2;
  }
  out.stem_area_m2 += from.stem_m2;
  out.other_area_m2 += other - from.stem_m2;
}

double mixed_g(const SurfaceSums& sums, double leaf, double other) {
  const double l = sums.leaf_area_m2, o = 0.5 * (sums.stem_area_m2 + sums.other_area_m2);
  return ((l > 0 ? l * leaf : 0) + (o > 0 ? o * other : 0)) / (l + o);
}

}  // namespace

double SurfaceSums::leaf_g(double zenith) const {
  return leaves.g(zenith);
}
double SurfaceSums::plant_g(double zenith) const {
  return mixed_g(*this, leaves.g(zenith), others.g(zenith));
}
double SurfaceSums::leaf_g(double zenith, double azimuth) const {
  return leaves.g(zenith, azimuth);
}
double SurfaceSums::plant_g(double zenith, double azimuth) const {
  return mixed_g(*this, leaves.g(zenith, azimuth), others.g(zenith, azimuth));
}

SurfaceSums surface_sums(const Scene& scene, const Ground& ground, const SurfaceSumsOptions& options) {
  std::vector<std::vector<std::uint32_t>> instances(scene.prototypes.size());
  for (std::uint32_t i = 0; i < scene.instances.size(); ++i)
    instances[scene.instances[i].prototype].push_back(i);
  const std::size_t tasks = std::min<std::size_t>(16, scene.prototypes.size());
  std::vector<Sums> sums(tasks, Sums(scene.materials.size(), options.height_m, options.layers));
  parallel_for(tasks, [&](std::size_t task) {
    for (std::size_t p = task; p < scene.prototypes.size(); p += tasks)
      if (!instances[p].empty())
        PrototypeSums(scene, ground, static_cast<std::uint32_t>(p), instances[p], options, sums[task]).add();
  });
  SurfaceSums out;
  out.leaf_profile = out.other_profile = HeightProfile(0, options.height_m, options.layers);
  for (const Sums& part : sums) merge(part, scene, out);
  return out;
}

}  // namespace bpms
