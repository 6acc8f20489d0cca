#include "scene/geometry/assemble.h"

#include <algorithm>
#include <functional>

#include "core/error.h"

namespace bpms {
namespace {

// Bytes that a primitive written out and one more instance take, roughly (scene/intersect/traced_build.cpp).
constexpr double written_bytes = 150, instance_bytes = 400;
constexpr double most_instances = 5e7, most_written = 1e8;  // what is beyond is refused, or taken apart

bool has_normals(const Mesh& mesh) {
  return !mesh.normals.empty();
}

// Appends a mesh where an instance puts it.
void append(const Mesh& own, const std::vector<std::uint32_t>& materials, const Instance& at, Prototype& out,
            Mesh& mesh) {
  const auto vertex = static_cast<std::uint32_t>(mesh.positions_m.size());
  const auto organ = static_cast<std::uint32_t>(mesh.organs.size());
  for (const Eigen::Vector3f& p : own.positions_m)
    mesh.positions_m.push_back((at.position_m + at.scale * (at.rotation * p.cast<double>())).cast<float>());
  for (const Eigen::Vector3f& n : own.normals)
    mesh.normals.push_back((at.rotation * n.cast<double>()).cast<float>());
  // All (U,V) of a part that has none are 0: then there are no tangents either.
  mesh.uv.resize(vertex, Eigen::Vector2f::Zero());
  mesh.uv.insert(mesh.uv.end(), own.uv.begin(), own.uv.end());
  mesh.uv.resize(mesh.positions_m.size(), Eigen::Vector2f::Zero());
  for (const auto& [a, b, c] : own.triangles) mesh.triangles.push_back({vertex + a, vertex + b, vertex + c});
  for (std::size_t k = 0; k < own.triangles.size(); ++k)
    mesh.organ_of_triangle.push_back(organ + (own.organ_of_triangle.empty() ? 0 : own.organ_of_triangle[k]));
  for (Mesh::Organ o : own.organs) {
    o.length_m *= at.scale;
    o.area_m2 *= at.scale * at.scale;
    o.volume_m3 *= at.scale * at.scale * at.scale;
    o.centroid_m = at.position_m + at.scale * (at.rotation * o.centroid_m);
    mesh.organs.push_back(std::move(o));
  }
  out.material_of_organ.insert(out.material_of_organ.end(), materials.begin(), materials.end());
}

void append(const Prototype& own, const Instance& at, Prototype& out, Mesh& mesh) {
  const auto place = [&](const Eigen::Vector3f& p) {
    return Eigen::Vector3f((at.position_m + at.scale * (at.rotation * p.cast<double>())).cast<float>());
  };
  for (std::size_t k = 0; k < own.discs.size(); ++k) {
    const Disc& d = own.discs[k];
    out.discs.push_back({place(d.centre_m), static_cast<float>(at.scale * d.radius_m),
                         (at.rotation * d.normal.cast<double>()).cast<float>()});
    out.material_of_disc.push_back(own.material_of_disc.empty() ? own.disc_material
                                                                : own.material_of_disc[k]);
  }
  const auto first_organ = static_cast<std::uint32_t>(mesh.organs.size());
  for (std::size_t k = 0; k < own.shapes.size(); ++k) {
    Shape shape = own.shapes[k];
    shape.centre_m = place(shape.centre_m);
    shape.rotation = Rotation(at.rotation.quaternion() * shape.rotation.quaternion());
    shape.size_m = (at.scale * shape.size_m.cast<double>()).cast<float>();
    out.shapes.push_back(shape);
    const std::uint32_t organ = own.organ_of(k);
    out.organ_of_shape.push_back(organ == no_organ ? no_organ : first_organ + organ);
  }
  if (own.mesh) append(*own.mesh, own.material_of_organ, at, out, mesh);
}

class Assembler {
 public:
  Assembler(const std::vector<Assembly>& assemblies, AssemblyLayout layout, Scene& scene)
      : assemblies_(assemblies), scene_(scene), layout_(layout), first_(scene.prototypes.size()) {}

  void resolve() {
    const std::size_t nodes = first_ + assemblies_.size();
    uses_.assign(nodes, 0);
    for (const Instance& i : scene_.instances) uses_[i.prototype] += 1;
    find_order();
    // Parents before children: how often each would stand if nothing were written out.
    for (auto k = order_.rbegin(); k != order_.rend(); ++k)
      for (const Instance& part : assemblies_[*k].parts) uses_[part.prototype] += uses_[first_ + *k];
    primitives_.assign(nodes, 0);
    expands_to_.assign(nodes, 1);
    normals_.assign(nodes, Normals::none);
    written_.assign(assemblies_.size(), 0);
    for (std::size_t p = 0; p < first_; ++p) {
      const Prototype& own = scene_.prototypes[p];
      primitives_[p] = static_cast<double>(own.discs.size() + own.shapes.size() +
                                           (own.mesh ? own.mesh->triangles.size() : 0));
      if (own.mesh && !own.mesh->triangles.empty())
        normals_[p] = has_normals(*own.mesh) ? Normals::yes : Normals::no;
    }
    for (const std::size_t k : order_) choose(k);
    place_all();
  }

 private:
  // Whether the meshes below have normals at their vertices; they share one only when they all do or none.
  enum class Normals { none, yes, no, mixed };

  // Children before parents.
  void find_order() {
    std::vector<char> seen(assemblies_.size(), 0);
    const std::function<void(std::size_t)> visit = [&](std::size_t k) {
      if (seen[k] != 0) return;
      seen[k] = 1;
      for (const Instance& part : assemblies_[k].parts)
        if (part.prototype >= first_) visit(part.prototype - first_);
      order_.push_back(k);
    };
    for (std::size_t k = 0; k < assemblies_.size(); ++k) visit(k);
  }

  void choose(std::size_t k) {
    const std::size_t node = first_ + k;
    double apart = 0;
    for (const Instance& part : assemblies_[k].parts) {
      apart += expands_to_[part.prototype];
      primitives_[node] += primitives_[part.prototype];
      const Normals n = normals_[part.prototype];
      if (n != Normals::none && n != normals_[node])
        normals_[node] = normals_[node] == Normals::none ? n : Normals::mixed;
    }
    const double uses = uses_[node];
    const bool smaller = uses > 1 && primitives_[node] * written_bytes < uses * (apart - 1) * instance_bytes;
    const bool fits = primitives_[node] <= most_written;
    const bool wanted =
        layout_ == AssemblyLayout::by_memory ? smaller : layout_ == AssemblyLayout::written_out;
    written_[k] = static_cast<char>(wanted && fits && uses > 0 && normals_[node] != Normals::mixed);
    expands_to_[node] = written_[k] != 0 ? 1 : apart;
  }

  void place_all() {
    double total = 0;
    for (const Instance& i : scene_.instances) total += expands_to_[i.prototype];
    if (total > most_instances)
      fail(ErrorKind::missing_resource, {},
           "the parts of the prototypes make {:.3g} instances, more than {:.0g} cannot be held", total,
           most_instances);
    std::vector<Instance> out;
    out.reserve(static_cast<std::size_t>(total));
    for (const Instance& i : scene_.instances) place(i, out);
    scene_.instances = std::move(out);
  }

  void place(const Instance& at, std::vector<Instance>& out) {
    if (at.prototype < first_) {
      out.push_back(at);
      return;
    }
    const std::size_t k = at.prototype - first_;
    if (written_[k] != 0) {
      out.push_back(at);
      out.back().prototype = prototype_of(k);
      return;
    }
    for (const Instance& part : assemblies_[k].parts) place(within(at, part), out);
  }

  std::uint32_t prototype_of(std::size_t k) {
    made_.resize(assemblies_.size(), no_plant);
    if (made_[k] != no_plant) return made_[k];
    Prototype out;
    out.name = assemblies_[k].name;
    auto mesh = std::make_shared<Mesh>();
    const std::function<void(const Instance&)> write = [&](const Instance& at) {
      if (at.prototype < first_) {
        append(scene_.prototypes[at.prototype], at, out, *mesh);
        return;
      }
      for (const Instance& part : assemblies_[at.prototype - first_].parts) write(within(at, part));
    };
    Instance whole;
    whole.prototype = static_cast<std::uint32_t>(first_ + k);
    write(whole);
    if (!mesh->organs.empty()) out.mesh = std::move(mesh);
    made_[k] = static_cast<std::uint32_t>(scene_.prototypes.size());
    scene_.prototypes.push_back(std::move(out));
    return made_[k];
  }

  const std::vector<Assembly>& assemblies_;
  Scene& scene_;
  AssemblyLayout layout_;
  std::size_t first_;
  std::vector<std::size_t> order_;
  std::vector<double> uses_, primitives_, expands_to_;  // by node: prototypes, then assemblies
  std::vector<Normals> normals_;
  std::vector<char> written_;
  std::vector<std::uint32_t> made_;  // the prototype that was made of an assembly
};

}  // namespace

Instance within(const Instance& outer, const Instance& inner) {
  Instance out;
  out.prototype = inner.prototype;
  out.plant = outer.plant;
  out.position_m = outer.position_m + outer.scale * (outer.rotation * inner.position_m);
  out.rotation = Rotation(outer.rotation.quaternion() * inner.rotation.quaternion());
  out.scale = outer.scale * inner.scale;
  return out;
}

std::vector<std::size_t> find_cycle(std::size_t prototypes, const std::vector<Assembly>& assemblies) {
  std::vector<char> finished(assemblies.size(), 0);
  std::vector<std::size_t> chain;
  const std::function<bool(std::size_t)> visit = [&](std::size_t k) {
    const auto again = std::find(chain.begin(), chain.end(), k);
    if (again != chain.end()) {
      chain.erase(chain.begin(), again);
      chain.push_back(k);
      return true;
    }
    if (finished[k] != 0) return false;
    chain.push_back(k);
    for (const Instance& part : assemblies[k].parts)
      if (part.prototype >= prototypes && visit(part.prototype - prototypes)) return true;
    chain.pop_back();
    finished[k] = 1;
    return false;
  };
  for (std::size_t k = 0; k < assemblies.size(); ++k)
    if (visit(k)) return chain;
  return {};
}

void resolve_assemblies(const std::vector<Assembly>& assemblies, Scene& scene) {
  resolve_assemblies(assemblies, AssemblyLayout::by_memory, scene);
}

void resolve_assemblies(const std::vector<Assembly>& assemblies, AssemblyLayout layout, Scene& scene) {
  Assembler(assemblies, layout, scene).resolve();
}

}  // namespace bpms
