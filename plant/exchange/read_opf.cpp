// OPF as it streams by: the four tables, then the nodes of the topology, each inside the one it hangs on.
#include <algorithm>
#include <cctype>
#include <charconv>
#include <set>

#include "core/nearest.h"
#include "core/text.h"
#include "plant/exchange/mtg_builder.h"
#include "plant/exchange/mtg_text.h"
#include "plant/exchange/opf_parts.h"
#include "plant/exchange/xml.h"

namespace bpms {
namespace {

std::vector<double> opf_numbers(std::string_view text, const SourceLocation& where, const char* what) {
  std::vector<double> out;
  constexpr double largest = 1e12;
  for (std::size_t at = 0;;) {
    at = text.find_first_not_of(" \t\r\n,;", at);
    if (at == std::string_view::npos) return out;
    const std::size_t end = std::min(text.find_first_of(" \t\r\n,;", at), text.size());
    const auto value = parse_number(text.substr(at, end - at));
    if (!value || !(std::abs(*value) <= largest))
      bad_input(where, "found {} in {}, expected finite numbers", in_quotes(text.substr(at, end - at)), what);
    out.push_back(*value);
    at = end;
  }
}

// The word a class's name becomes in the graph: letters only, as an index may follow it.
std::string mtg_symbol(std::string_view name) {
  std::string out;
  for (const char c : name) out += std::isalpha(static_cast<unsigned char>(c)) != 0 ? c : '_';
  return out;
}

class OpfReader {
 public:
  OpfReader(const std::string& path, OpfParts& parts) : path_(path), parts_(parts), builder_(parts.mtg) {
    parts.mtg.file = path;
  }

  void open(const XmlElement& element) {
    const std::string& name = element.name;
    if (path_to_.empty() && name != "opf") bad_input(element.where, "found <{}>, expected <opf>", name);
    path_to_.push_back(name);
    if (name == "topology" || name == "decomp" || name == "follow" || name == "branch") {
      open_node(element);
    } else if (name == "geometry" && !nodes_.empty()) {
      geometry_ = OpfNode{};
      geometry_.vertex = nodes_.back().vertex;
      geometry_.where = element.where;
    } else if (name == "mesh") {
      id_ = number_of(element, "Id");
      if (!parts_.meshes.try_emplace(id_).second) bad_input(element.where, "mesh {} is there already", id_);
      parts_.meshes[id_].where = element.where;
    } else if (name == "material") {
      id_ = number_of(element, "Id");
      const std::string* own = element.attribute("name");
      if (!parts_.materials.try_emplace(id_, own != nullptr ? *own : "").second)
        bad_input(element.where, "material {} is there already", id_);
    } else if (name == "shape") {
      id_ = number_of(element, "Id");
      if (!parts_.shapes.try_emplace(id_).second) bad_input(element.where, "shape {} is there already", id_);
      parts_.shapes[id_].where = element.where;
    } else if (name == "attribute") {
      add_feature(element);
    }
  }

  void close(const std::string& name, std::string_view text, const SourceLocation& where) {
    path_to_.pop_back();
    const std::string& inside = path_to_.empty() ? name : path_to_.back();
    if (name == "topology" || name == "decomp" || name == "follow" || name == "branch") {
      nodes_.pop_back();
    } else if (inside == "mesh" || inside == "faces") {
      close_mesh_part(name, text, where);
    } else if (name == "mesh") {
      finish_mesh();
    } else if (inside == "shape") {
      if (name == "name") parts_.shapes[id_].name = text;
      if (name == "meshIndex") parts_.shapes[id_].mesh = integer(text, where, "meshIndex");
      if (name == "materialIndex") parts_.shapes[id_].material = integer(text, where, "materialIndex");
    } else if (!nodes_.empty() && inside == "geometry") {
      close_geometry_part(name, text, where);
    } else if (!nodes_.empty() && name == "geometry") {
      if (geometry_.shape >= 0) parts_.nodes.push_back(geometry_);
    } else if (!nodes_.empty()) {
      close_attribute(name, text, where);
    }
  }

  void finish() const {
    if (parts_.mtg.vertices.empty()) bad_input({path_}, "no <topology>, expected an OPF plant");
  }

 private:
  struct Open {
    std::size_t vertex = 0;
    std::int32_t last_part = -1;  // the last decomp or follow right inside it
  };

  static long long integer(std::string_view text, const SourceLocation& where, const char* what) {
    const auto value = parse_integer(text);
    constexpr long long largest = 2'000'000'000;
    if (!value || *value < 0 || *value > largest)
      bad_input(where, "found {}, expected {} (a whole number from 0)", in_quotes(text), what);
    return *value;
  }
  static long long number_of(const XmlElement& element, const char* attribute) {
    const std::string* text = element.attribute(attribute);
    if (text == nullptr) bad_input(element.where, "<{}> needs {}=\"...\"", element.name, attribute);
    return integer(*text, element.where, attribute);
  }

  void add_feature(const XmlElement& element) {
    const std::string* name = element.attribute("name");
    const std::string* type = element.attribute("class");
    if (name == nullptr || name->empty()) bad_input(element.where, "<attribute> needs name=\"...\"");
    const bool real = type != nullptr && (*type == "Double" || *type == "Float" || *type == "Metre");
    const bool whole = type != nullptr && (*type == "Integer" || *type == "Long");
    const bool boolean = type != nullptr && *type == "Boolean";
    parts_.mtg.feature_number(*name, real ? "REAL" : whole ? "INT" : boolean ? "BOOLEAN" : "ALPHA");
  }

  void open_node(const XmlElement& element) {
    const std::string* symbol = element.attribute("class");
    if (symbol == nullptr || symbol->empty())
      bad_input(element.where, "<{}> needs class=\"...\"", element.name);
    if ((element.name == "topology") != nodes_.empty())
      bad_input(element.where, "<{}> {}", element.name,
                nodes_.empty() ? "outside of <topology>" : "inside of another node");
    constexpr long long most_scales = 1000;
    const long long scale = number_of(element, "scale");
    if (scale > most_scales) bad_input(element.where, "scale {}, expected one up to {}", scale, most_scales);
    const std::uint32_t number = parts_.mtg.class_number(mtg_symbol(*symbol), static_cast<int>(scale));
    if (parts_.mtg.classes[number].scale != scale)
      bad_input(element.where, "class {} at scale {}, but before at scale {}", in_quotes(*symbol), scale,
                parts_.mtg.classes[number].scale);
    const int index = element.attribute("id") != nullptr ? static_cast<int>(number_of(element, "id")) : -1;
    std::int32_t cursor = nodes_.empty() ? -1 : static_cast<std::int32_t>(nodes_.back().vertex);
    char edge = '/';
    if (element.name == "branch") edge = '+';
    if (element.name == "follow") {
      edge = '<';
      // Inside of what is coarser it follows the part before it; inside of its own scale, what it is in.
      if (parts_.mtg.scale(nodes_.back().vertex) < scale) cursor = nodes_.back().last_part;
    }
    const auto vertex = static_cast<std::size_t>(builder_.add(
        edge, number, index, cursor, element.where, "<" + element.name + " class=\"" + *symbol + "\">"));
    if (!nodes_.empty() && edge != '+') nodes_.back().last_part = static_cast<std::int32_t>(vertex);
    nodes_.push_back({vertex, -1});
  }

  void close_mesh_part(const std::string& name, std::string_view text, const SourceLocation& where) {
    OpfReferenceMesh& mesh = parts_.meshes[id_];
    if (name == "points" || name == "normals") {
      const std::vector<double> numbers = opf_numbers(text, where, name.c_str());
      if (numbers.size() % 3 != 0)
        bad_input(where, "{} numbers in {}, expected three for each point", numbers.size(), name);
      auto& out = name == "points" ? mesh.points : mesh.normals;
      out.clear();
      for (std::size_t i = 0; i < numbers.size(); i += 3)
        out.emplace_back(numbers[i], numbers[i + 1], numbers[i + 2]);
    } else if (name == "textureCoords") {
      const std::vector<double> numbers = opf_numbers(text, where, "textureCoords");
      if (numbers.size() % 2 != 0)
        bad_input(where, "{} numbers in textureCoords, expected two for each point", numbers.size());
      mesh.uv.clear();
      for (std::size_t i = 0; i < numbers.size(); i += 2) mesh.uv.emplace_back(numbers[i], numbers[i + 1]);
    } else if (name == "face") {
      const std::vector<double> corners = opf_numbers(text, where, "face");
      if (corners.size() != 3) bad_input(where, "a face of {} corners, expected 3", corners.size());
      std::array<std::uint32_t, 3> face{};
      for (std::size_t k = 0; k < 3; ++k) {
        const double corner = corners[k];
        if (!(corner >= 0 && corner < static_cast<double>(mesh.points.size()) &&
              corner == std::floor(corner)))
          bad_input(where, "corner {} of a face, but there are {} points", corner, mesh.points.size());
        face[k] = static_cast<std::uint32_t>(corner);
      }
      mesh.faces.push_back(face);
    }
  }

  void finish_mesh() {
    OpfReferenceMesh& mesh = parts_.meshes[id_];
    if (mesh.points.empty()) bad_input(mesh.where, "mesh {} has no points", id_);
    if (!mesh.normals.empty() && mesh.normals.size() != mesh.points.size())
      bad_input(mesh.where, "mesh {} has {} points, but {} normals", id_, mesh.points.size(),
                mesh.normals.size());
    if (!mesh.uv.empty() && mesh.uv.size() != mesh.points.size())
      bad_input(mesh.where, "mesh {} has {} points, but {} textureCoords", id_, mesh.points.size(),
                mesh.uv.size());
    mesh.least_x = mesh.most_x = mesh.points.front().x();
    for (const Eigen::Vector3d& p : mesh.points) {
      mesh.least_x = std::min(mesh.least_x, p.x());
      mesh.most_x = std::max(mesh.most_x, p.x());
    }
    if (mesh.normals.empty()) {
      mesh.normals.assign(mesh.points.size(), Eigen::Vector3d::Zero());
      for (const auto& [a, b, c] : mesh.faces) {
        const Eigen::Vector3d n = (mesh.points[b] - mesh.points[a]).cross(mesh.points[c] - mesh.points[a]);
        for (const std::uint32_t corner : {a, b, c}) mesh.normals[corner] += n;
      }
    }
    if (mesh.uv.empty()) {  // U along x, where organs lie
      const double length = mesh.most_x - mesh.least_x;
      for (const Eigen::Vector3d& p : mesh.points)
        mesh.uv.emplace_back(length > 0 ? (p.x() - mesh.least_x) / length : 0, 0.5);
    }
  }

  void close_geometry_part(const std::string& name, std::string_view text, const SourceLocation& where) {
    if (name == "shapeIndex") {
      geometry_.shape = integer(text, where, "shapeIndex");
    } else if (name == "mat") {
      const std::vector<double> numbers = opf_numbers(text, where, "mat");
      if (numbers.size() != 12)
        bad_input(where, "mat has {} numbers, expected 12 (3 rows of 4)", numbers.size());
      for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 4; ++column)
          geometry_.matrix(row, column) = numbers[static_cast<std::size_t>(4 * row + column)];
    } else if (name == "dUp" || name == "dDwn") {
      if (text == "NaN") {  // Xplo's word for a node without a taper
        geometry_.tapered = false;
        return;
      }
      const std::vector<double> numbers = opf_numbers(text, where, name.c_str());
      if (numbers.size() != 1) bad_input(where, "{} numbers in {}, expected one", numbers.size(), name);
      (name == "dUp" ? geometry_.up : geometry_.down) = numbers[0];
    }
  }

  void close_attribute(const std::string& name, std::string_view text, const SourceLocation& where) {
    if (path_to_.back() != "topology" && path_to_.back() != "decomp" && path_to_.back() != "follow" &&
        path_to_.back() != "branch")
      bad_input(where, "<{}> inside of <{}>, expected a value", name, path_to_.back());
    if (text.empty()) return;
    if (!parts_.mtg.feature(name) && unknown_.insert(name).second)
      parts_.notes.push_back(
          fmt::format("{}: <{}> is not in attributeBDD, taken as text", where.str(), name));
    const std::uint32_t feature = parts_.mtg.feature_number(name, "ALPHA");
    const std::string& type = parts_.mtg.features[feature].type;
    if (!is_mtg_value(type, text))
      bad_input(where, "found {} in <{}>, expected a value of type {}", in_quotes(text), name, type);
    std::string line(text);  // one line, one space: it may go into an MTG
    std::replace_if(
        line.begin(), line.end(), [](char c) { return c == '\t' || c == '\n' || c == '\r'; }, ' ');
    parts_.mtg.set(nodes_.back().vertex, feature, std::move(line));
  }

  const std::string& path_;
  OpfParts& parts_;
  MtgBuilder builder_;
  std::vector<std::string> path_to_;  // names of the open elements
  std::vector<Open> nodes_;
  OpfNode geometry_;
  long long id_ = -1;  // of the mesh, material or shape that is open
  std::set<std::string> unknown_;
};

}  // namespace

OpfParts parse_opf_parts(const std::string& path, std::string_view text) {
  OpfParts out;
  OpfReader reader(path, out);
  read_xml(path, text,
           {[&](const XmlElement& element) { reader.open(element); },
            [&](const std::string& name, std::string_view content, const SourceLocation& where) {
              reader.close(name, content, where);
            }});
  reader.finish();
  return out;
}

OpfPlant parse_opf(const std::string& path, std::string_view text, const OpfOptions& options) {
  OpfParts parts = parse_opf_parts(path, text);
  OpfPlant out;
  place_opf_nodes(parts, options, out);
  out.mtg = std::move(parts.mtg);
  out.notes = std::move(parts.notes);
  return out;
}

OpfPlant read_opf(const std::string& path, const OpfOptions& options) {
  return parse_opf(path, read_text(path), options);
}

}  // namespace bpms
