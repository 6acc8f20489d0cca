#include "scene/importers/mesh_file.h"

#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <cctype>
#include <cmath>
#include <filesystem>

#include "core/error.h"
#include "core/text.h"
#include "scene/importers/obj_indices.h"

namespace bpms {
namespace {

constexpr float largest_m = 1e7F;

std::string lower(std::string_view text) {
  std::string out(text);
  std::transform(out.begin(), out.end(), out.begin(), [](unsigned char c) { return std::tolower(c); });
  return out;
}

class MeshReader {
 public:
  MeshReader(const std::string& path, double unit, bool y_up) : path_(path), unit_(unit), y_up_(y_up) {}

  // From the file itself, or from `bytes`.
  Mesh read(const std::string_view* bytes) {
    Assimp::Importer importer;
    importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE, aiPrimitiveType_POINT | aiPrimitiveType_LINE);
    constexpr unsigned steps =
        aiProcess_Triangulate | aiProcess_JoinIdenticalVertices | aiProcess_SortByPType;
    const std::string type = std::filesystem::path(path_).extension().string();
    if (lower(type) == ".obj") check_obj_indices(path_, bytes == nullptr ? read_file(path_) : *bytes);
    file_ = bytes == nullptr ? importer.ReadFile(path_, steps)
                             : importer.ReadFileFromMemory(bytes->data(), bytes->size(), steps,
                                                           type.empty() ? "" : type.c_str() + 1);
    if (file_ == nullptr)
      bad_input({path_}, "cannot be read as a mesh: {}", in_quotes(importer.GetErrorString()));
    for (unsigned m = 0; m < file_->mNumMeshes; ++m) {
      normals_ = normals_ && file_->mMeshes[m]->HasNormals();
      uv_ = uv_ && file_->mMeshes[m]->HasTextureCoords(0);
    }
    add_node(*file_->mRootNode, aiMatrix4x4());
    if (mesh_.triangles.empty()) bad_input({path_}, "no triangles");
    return std::move(mesh_);
  }

 private:
  Eigen::Vector3f turned(const aiVector3D& v) const {
    return y_up_ ? Eigen::Vector3f(v.x, -v.z, v.y) : Eigen::Vector3f(v.x, v.y, v.z);
  }

  static Eigen::Vector3f unit_or_up(const Eigen::Vector3f& v) {
    const float length = v.norm();
    return length > 0 && std::isfinite(length) ? Eigen::Vector3f(v / length) : Eigen::Vector3f::UnitZ();
  }

  void add_node(const aiNode& node, const aiMatrix4x4& parent) {
    const aiMatrix4x4 transform = parent * node.mTransformation;
    for (unsigned i = 0; i < node.mNumMeshes; ++i) add_mesh(*file_->mMeshes[node.mMeshes[i]], transform);
    for (unsigned i = 0; i < node.mNumChildren; ++i) add_node(*node.mChildren[i], transform);
  }

  void add_mesh(const aiMesh& part, const aiMatrix4x4& transform) {
    const auto first = static_cast<std::uint32_t>(mesh_.positions_m.size());
    // Normals turn by the inverse transpose (scales may differ by axis); a mirrored part's faces turn round.
    aiMatrix3x3 rotation(transform);
    const bool mirrored = rotation.Determinant() < 0;
    rotation = rotation.Inverse().Transpose();
    for (unsigned v = 0; v < part.mNumVertices; ++v) {
      const Eigen::Vector3f p = turned(transform * part.mVertices[v]) * static_cast<float>(unit_);
      if (!p.allFinite()) bad_input({path_}, "vertex {} is not finite", v);
      if (p.cwiseAbs().maxCoeff() > largest_m) bad_input({path_}, "vertex {} lies beyond 1e7 m", v);
      mesh_.positions_m.push_back(p);
      if (normals_) mesh_.normals.push_back(unit_or_up(turned(rotation * part.mNormals[v])));
      if (uv_) mesh_.uv.emplace_back(part.mTextureCoords[0][v].x, part.mTextureCoords[0][v].y);
    }
    Mesh::Organ organ;
    organ.id = static_cast<int>(mesh_.organs.size());
    organ.label = part.mName.C_Str();
    if (part.mMaterialIndex < file_->mNumMaterials)
      organ.material = file_->mMaterials[part.mMaterialIndex]->GetName().C_Str();
    if (organ.material == "DefaultMaterial") organ.material.clear();  // Assimp's word for none
    organ.kind = names_a_leaf(organ.material) || names_a_leaf(organ.label) ? "leaf" : "mesh";
    for (unsigned f = 0; f < part.mNumFaces; ++f) {
      const aiFace& face = part.mFaces[f];
      if (face.mNumIndices != 3) continue;
      mesh_.triangles.push_back({first + face.mIndices[0], first + face.mIndices[mirrored ? 2 : 1],
                                 first + face.mIndices[mirrored ? 1 : 2]});
      mesh_.organ_of_triangle.push_back(static_cast<std::uint32_t>(mesh_.organs.size()));
      organ.area_m2 += triangle_area_m2(mesh_, mesh_.triangles.size() - 1);
    }
    mesh_.organs.push_back(std::move(organ));
  }

  const std::string& path_;
  double unit_;
  bool y_up_;
  const aiScene* file_ = nullptr;
  bool normals_ = true, uv_ = true;
  Mesh mesh_;
};

}  // namespace

std::shared_ptr<const Mesh> read_mesh_file(const std::string& path, double metres_per_unit, bool y_up) {
  if (!std::filesystem::exists(path)) fail(ErrorKind::missing_resource, {path}, "no such file");
  return std::make_shared<const Mesh>(MeshReader(path, metres_per_unit, y_up).read(nullptr));
}

std::shared_ptr<const Mesh> parse_mesh(const std::string& path, std::string_view bytes,
                                       double metres_per_unit, bool y_up) {
  return std::make_shared<const Mesh>(MeshReader(path, metres_per_unit, y_up).read(&bytes));
}

bool mesh_file_is_y_up(const std::string& path) {
  const std::string type = lower(std::filesystem::path(path).extension().string());
  return type == ".gltf" || type == ".glb";
}

bool names_a_leaf(std::string_view name) {
  return lower(name).find("leaf") != std::string::npos;
}

}  // namespace bpms
