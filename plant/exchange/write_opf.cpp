// OPF from a mesh and its topology. What follows inside one complex stands beside what it follows, as the
// family's own programs write it; all else inside of what it hangs on.
#include <algorithm>

#include "plant/exchange/opf_parts.h"
#include "plant/exchange/xml.h"
#include "plant/export/formats.h"

namespace bpms {
namespace {

class OpfWriter {
 public:
  OpfWriter(const Mesh& mesh, const Mtg& mtg, const std::vector<std::int32_t>& organs,
            const OpfOptions& options)
      : mesh_(mesh), mtg_(mtg), organs_(organs), per_metre_(1 / options.metres_per_unit) {}

  std::string text() {
    out_ = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<opf version=\"2.0\" editable=\"true\">\n";
    write_meshes();
    write_materials();
    out_ += "\t<attributeBDD>\n";
    for (const MtgFeature& one : mtg_.features)
      out_ += fmt::format("\t\t<attribute name=\"{}\" class=\"{}\"/>\n", element_name(one.name),
                          one.type == "REAL"      ? "Double"
                          : one.type == "INT"     ? "Integer"
                          : one.type == "BOOLEAN" ? "Boolean"
                                                  : "String");
    out_ += "\t</attributeBDD>\n";
    write_topology();
    out_ += "</opf>\n";
    return std::move(out_);
  }

 private:
  void write_meshes() {
    parts_ = split_by_organ(mesh_);
    out_ += "\t<meshBDD>\n";
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      if (parts_[i].triangles.empty()) continue;
      out_ += fmt::format("\t\t<mesh name=\"{}\" shape=\"\" Id=\"{}\" enableScale=\"false\">\n\t\t\t<points>",
                          xml_escaped(mesh_.organs[i].label), i);
      for (const std::uint32_t v : parts_[i].vertices) {
        const Eigen::Vector3d p = per_metre_ * mesh_.positions_m[v].cast<double>();
        out_ += fmt::format("{}\t{}\t{}\t", p.x(), p.y(), p.z());
      }
      out_ += "</points>\n\t\t\t<normals>";
      for (const std::uint32_t v : parts_[i].vertices)
        out_ += fmt::format("{}\t{}\t{}\t", mesh_.normals[v].x(), mesh_.normals[v].y(), mesh_.normals[v].z());
      out_ += "</normals>\n\t\t\t<textureCoords>";
      for (const std::uint32_t v : parts_[i].vertices)
        out_ += fmt::format("{}\t{}\t", mesh_.uv[v].x(), mesh_.uv[v].y());
      out_ += "</textureCoords>\n\t\t\t<faces>\n";
      for (std::size_t t = 0; t < parts_[i].triangles.size(); ++t) {
        const auto& [a, b, c] = parts_[i].triangles[t];
        out_ += fmt::format("\t\t\t\t<face Id=\"{}\">{}\t{}\t{}</face>\n", t, a, b, c);
      }
      out_ += "\t\t\t</faces>\n\t\t</mesh>\n";
    }
    out_ += "\t</meshBDD>\n";
  }

  void write_materials() {
    const MeshMaterials materials = mesh_materials(mesh_);
    out_ += "\t<materialBDD>\n";
    for (std::size_t i = 0; i < materials.names.size(); ++i) {
      const Eigen::Vector3f c = viewer_colour(materials.names[i]);
      const std::string colour = fmt::format("{}\t{}\t{}\t1", c.x(), c.y(), c.z());
      out_ += fmt::format("\t\t<material Id=\"{}\" name=\"{}\">\n", i, xml_escaped(materials.names[i]));
      out_ += "\t\t\t<emission>0\t0\t0\t0</emission>\n";
      out_ += fmt::format("\t\t\t<ambient>{0}</ambient>\n\t\t\t<diffuse>{0}</diffuse>\n", colour);
      out_ += "\t\t\t<specular>0\t0\t0\t1</specular>\n\t\t\t<shininess>10</shininess>\n\t\t</material>\n";
    }
    out_ += "\t</materialBDD>\n\t<shapeBDD>\n";
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      if (parts_[i].triangles.empty()) continue;
      out_ += fmt::format(
          "\t\t<shape Id=\"{0}\">\n\t\t\t<name>{1}</name>\n\t\t\t<meshIndex>{0}</meshIndex>\n"
          "\t\t\t<materialIndex>{2}</materialIndex>\n\t\t</shape>\n",
          i, xml_escaped(mesh_.organs[i].label), materials.of_organ[i]);
    }
    out_ += "\t</shapeBDD>\n";
  }

  std::string element_name(const std::string& name) const {
    const bool fits = !name.empty() && std::isdigit(static_cast<unsigned char>(name[0])) == 0 &&
                      name[0] != '-' && name[0] != '.' &&
                      std::all_of(name.begin(), name.end(), [](unsigned char c) {
                        return std::isalnum(c) != 0 || c == '_' || c == '-' || c == '.' || c >= 128;
                      });
    for (const char* taken :
         {"geometry", "decomp", "follow", "branch", "topology", "mesh", "shape", "material", "attribute"})
      if (name == taken || !fits)
        bad_input({mtg_.file}, "the column {} cannot be written as OPF: its name is not one for an element",
                  in_quotes(name));
    return name;
  }

  const MtgVertex& at(std::size_t v) const { return mtg_.vertices[v]; }

  // Where each vertex's element lies: inside which one (-1: on top), in the order of the vertices.
  void nest() {
    const std::size_t count = mtg_.vertices.size();
    inside_.assign(count, {});
    std::vector<std::int32_t> attached(count), first(count, -1), holder(count, -1);
    for (std::size_t v = count; v-- > 0;)
      if (at(v).complex >= 0) first[static_cast<std::size_t>(at(v).complex)] = static_cast<std::int32_t>(v);
    for (std::size_t v = 0; v < count; ++v) attached[v] = at(v).after >= 0 ? at(v).after : at(v).parent;
    for (std::size_t v = count; v-- > 0;) {
      const std::int32_t complex = at(v).complex;
      if (complex >= 0 && at(static_cast<std::size_t>(complex)).after < 0 &&
          first[static_cast<std::size_t>(complex)] == static_cast<std::int32_t>(v) && at(v).parent >= 0 &&
          at(static_cast<std::size_t>(at(v).parent)).complex != complex)
        attached[static_cast<std::size_t>(complex)] = attached[v];
    }
    edge_.resize(count);
    std::vector<std::int32_t> last_part(count, -1);
    for (std::size_t v = 0; v < count; ++v) {
      const std::int32_t parent = at(v).parent, complex = at(v).complex;
      const bool part = parent < 0 || at(static_cast<std::size_t>(parent)).complex != complex;
      edge_[v] = part ? '/' : at(v).edge;
      holder[v] = part ? complex : attached[v];
      const bool beside = edge_[v] == '<' && attached[v] == parent && complex >= 0 &&
                          last_part[static_cast<std::size_t>(complex)] == parent;
      if (beside) holder[v] = complex;
      if (holder[v] >= 0) {
        inside_[static_cast<std::size_t>(holder[v])].push_back(v);
        if (edge_[v] != '+') last_part[static_cast<std::size_t>(holder[v])] = static_cast<std::int32_t>(v);
      } else {
        tops_.push_back(v);
      }
    }
  }

  void write_topology() {
    nest();
    const bool scene = tops_.size() != 1;
    if (scene) out_ += "\t<topology class=\"Scene\" scale=\"0\" id=\"0\">\n";
    struct Step {
      std::size_t vertex;
      bool close;
    };
    std::vector<Step> stack;
    for (std::size_t i = tops_.size(); i-- > 0;) stack.push_back({tops_[i], false});
    while (!stack.empty()) {
      const Step step = stack.back();
      stack.pop_back();
      const char* name = at(step.vertex).parent < 0 && at(step.vertex).complex < 0 && !scene ? "topology"
                         : edge_[step.vertex] == '/'                                         ? "decomp"
                         : edge_[step.vertex] == '<'                                         ? "follow"
                                                                                             : "branch";
      if (step.close) {
        out_ += fmt::format("</{}>\n", name);
        continue;
      }
      // Ids are unique in the file; the graph's own indices may repeat.
      out_ += fmt::format("<{} class=\"{}\" scale=\"{}\" id=\"{}\">\n", name,
                          xml_escaped(mtg_.classes[at(step.vertex).symbol].symbol), mtg_.scale(step.vertex),
                          step.vertex + 1);
      write_node(step.vertex);
      stack.push_back({step.vertex, true});
      const std::vector<std::size_t>& parts = inside_[step.vertex];
      for (std::size_t i = parts.size(); i-- > 0;) stack.push_back({parts[i], false});
    }
    if (scene) out_ += "\t</topology>\n";
  }

  void write_node(std::size_t vertex) {
    for (const MtgValue& value : at(vertex).values)
      out_ += fmt::format("<{0}>{1}</{0}>\n", mtg_.features[value.feature].name, xml_escaped(value.text));
    const std::int32_t organ = vertex < organs_.size() ? organs_[vertex] : -1;
    if (organ < 0 || parts_[static_cast<std::size_t>(organ)].triangles.empty()) return;
    out_ += fmt::format(
        "<geometry class=\"Mesh\"><shapeIndex>{}</shapeIndex><mat>1\t0\t0\t0\n0\t1\t0\t0\n0\t0\t1\t0</mat>"
        "<dUp>1</dUp><dDwn>1</dDwn></geometry>\n",
        organ);
  }

  const Mesh& mesh_;
  const Mtg& mtg_;
  const std::vector<std::int32_t>& organs_;
  double per_metre_;
  std::vector<MeshOfOrgan> parts_;
  std::vector<std::vector<std::size_t>> inside_;
  std::vector<std::size_t> tops_;
  std::vector<char> edge_;
  std::string out_;
};

}  // namespace

std::string opf_text(const Mesh& mesh, const Mtg& mtg, const std::vector<std::int32_t>& organ_of_vertex,
                     const OpfOptions& options) {
  return OpfWriter(mesh, mtg, organ_of_vertex, options).text();
}

}  // namespace bpms
