// A stand as one GLB: a mesh for each kind of plant with a primitive an organ, kept once; a node a clone, or
// one node a kind with EXT_mesh_gpu_instancing (Khronos, ratified by vendors) where clones are many.
#include "core/provenance.h"
#include "plant/export/glb_parts.h"
#include "plant/export/stand_parts.h"

namespace bpms {
namespace {

struct GlbPlace {
  Eigen::Vector3f translation;
  Eigen::Quaternionf rotation;
  float scale = 1;
};

// The same place with y up: the axis of a rotation turns as points do.
GlbPlace glb_place(const StandItem& item) {
  GlbPlace out;
  const double scale = std::cbrt(item.world_from_plant.linear().determinant());
  const Eigen::Quaterniond q(Eigen::Matrix3d(item.world_from_plant.linear() / scale));
  out.translation = y_up(Eigen::Vector3d(item.world_from_plant.translation()).cast<float>());
  const Eigen::Vector3f axis = y_up(Eigen::Vector3d(q.vec()).cast<float>());
  out.rotation = Eigen::Quaternionf(static_cast<float>(q.w()), axis.x(), axis.y(), axis.z()).normalized();
  out.scale = static_cast<float>(scale);
  return out;
}

class StandGlb {
 public:
  explicit StandGlb(const Stand& stand) : stand_(stand), materials_(stand) {}

  std::string bytes(std::size_t node_limit) {
    for (std::size_t p = 0; p < stand_.meshes.size(); ++p) add_mesh(p);
    Json document{{"asset", {{"version", "2.0"}, {"generator", "bpms " + version()}}}, {"scene", 0}};
    if (stand_.items.size() > node_limit) {
      add_instances();
      for (const char* key : {"extensionsUsed", "extensionsRequired"})
        document[key] = Json::array({"EXT_mesh_gpu_instancing"});
    } else {
      add_nodes();
    }
    Json root{{"name", "stand"}};
    if (!children_.empty()) root["children"] = children_;
    nodes_.push_back(root);
    document["scenes"] = Json::array({Json{{"nodes", Json::array({nodes_.size() - 1})}}});
    document["nodes"] = std::move(nodes_);
    if (!materials_.names.empty()) document["materials"] = glb_materials(materials_.names);
    if (!meshes_.empty()) {
      document["meshes"] = std::move(meshes_);
      document["accessors"] = std::move(buffer_.accessors);
      document["bufferViews"] = std::move(buffer_.views);
      document["buffers"] = Json::array({Json{{"byteLength", buffer_.bytes.size()}}});
    }
    return glb_bytes(document, std::move(buffer_.bytes));
  }

 private:
  void add_mesh(std::size_t p) {
    const Mesh& mesh = *stand_.meshes[p];
    const std::vector<MeshOfOrgan> parts = split_by_organ(mesh);
    Json primitives = Json::array();
    for (std::size_t i = 0; i < parts.size(); ++i) {
      if (parts[i].triangles.empty()) continue;
      Json primitive = glb_primitive(buffer_, mesh, parts[i], materials_.of_organ[p][i]);
      primitive["extras"] = glb_extras(mesh.organs[i]);
      primitive["extras"]["name"] = mesh.organs[i].label;
      primitives.push_back(std::move(primitive));
    }
    number_.push_back(primitives.empty() ? -1 : static_cast<int>(meshes_.size()));
    if (!primitives.empty())
      meshes_.push_back({{"name", stand_.names[p]}, {"primitives", std::move(primitives)}});
  }

  void add_nodes() {
    for (std::size_t i = 0; i < stand_.items.size(); ++i) {
      const StandItem& item = stand_.items[i];
      const GlbPlace place = glb_place(item);
      const auto& q = place.rotation;
      const auto& t = place.translation;
      Json node{{"name", fmt::format("{}_{}", stand_.names[item.mesh], i)},
                {"translation", {t.x(), t.y(), t.z()}},
                {"rotation", {q.x(), q.y(), q.z(), q.w()}},
                {"scale", {place.scale, place.scale, place.scale}},
                {"extras", {{"plant_id", i}}}};
      if (number_[item.mesh] >= 0) node["mesh"] = number_[item.mesh];
      children_.push_back(nodes_.size());
      nodes_.push_back(std::move(node));
    }
  }

  void add_instances() {
    for (std::size_t p = 0; p < stand_.meshes.size(); ++p) {
      std::vector<float> translations, rotations, scales;
      for (const StandItem& item : stand_.items) {
        if (item.mesh != p) continue;
        const GlbPlace place = glb_place(item);
        translations.insert(translations.end(), place.translation.begin(), place.translation.end());
        const auto& q = place.rotation.coeffs();  // x y z w, as glTF has them
        rotations.insert(rotations.end(), q.begin(), q.end());
        scales.insert(scales.end(), 3, place.scale);
      }
      if (translations.empty() || number_[p] < 0) continue;
      Json attributes{{"TRANSLATION", buffer_.add_floats(translations, 3, "VEC3")},
                      {"ROTATION", buffer_.add_floats(rotations, 4, "VEC4")},
                      {"SCALE", buffer_.add_floats(scales, 3, "VEC3")}};
      children_.push_back(nodes_.size());
      nodes_.push_back({{"name", stand_.names[p]},
                        {"mesh", number_[p]},
                        {"extensions", {{"EXT_mesh_gpu_instancing", {{"attributes", attributes}}}}}});
    }
  }

  const Stand& stand_;
  StandMaterials materials_;
  GlbBuffer buffer_;
  std::vector<int> number_;  // of each plant's mesh in the file; -1: no surface
  Json meshes_ = Json::array(), nodes_ = Json::array(), children_ = Json::array();
};

}  // namespace

void write_stand_glb(const std::string& path, const Stand& stand, const StandFileOptions& options) {
  write_file(path, StandGlb(stand).bytes(options.most_nodes), options.overwrite);
}

}  // namespace bpms
