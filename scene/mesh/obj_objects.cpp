#include "scene/mesh/obj_objects.hpp"

#include <algorithm>
#include <numeric>

#include "scene/mesh/obj.hpp"

namespace drape {
namespace {

/// Extracts the faces of some vertices (ascending) as a separate mesh.
Mesh part_of(const Mesh& mesh, const std::vector<int>& vertices) {
  std::vector<int> numbers(static_cast<std::size_t>(mesh.positions.rows()), -1);
  Mesh part;
  part.positions.resize(static_cast<Eigen::Index>(vertices.size()), 3);
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    numbers[static_cast<std::size_t>(vertices[i])] = static_cast<int>(i);
    part.positions.row(static_cast<Eigen::Index>(i)) = mesh.positions.row(vertices[i]);
  }
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    Triangle triangle = mesh.triangles[t];
    for (int& v : triangle) v = numbers[static_cast<std::size_t>(v)];
    if (*std::ranges::min_element(triangle) < 0) continue;
    part.triangles.push_back(triangle);
    if (mesh.uvs.empty()) continue;
    const auto first = mesh.uvs.begin() + static_cast<std::ptrdiff_t>(3 * t);
    part.uvs.insert(part.uvs.end(), first, first + 3);
  }
  return part;
}

}  // namespace

std::vector<ObjObject> read_drape_objects(const SourceText& source) {
  constexpr std::string_view object = "\no ", cloth = "\no cloth\n";
  const std::string_view text = source.text();
  if (!text.starts_with("# drape: frame") || text.find(cloth) == std::string_view::npos) return {};
  const Mesh all = read_obj_mesh(source);
  std::vector<int> of_cloth(static_cast<std::size_t>(all.positions.rows()));
  std::iota(of_cloth.begin(), of_cloth.end(), 0);
  std::vector<ObjObject> objects(1, {"cloth", {}});
  for (std::size_t at = text.find(object); at != std::string_view::npos; at = text.find(object, at + 1)) {
    const std::size_t begin = at + object.size();
    const std::string name(text.substr(begin, text.find('\n', begin) - begin));
    if (name == "cloth") continue;
    const std::vector<int> vertices = read_obj_group(source, name);
    std::vector<int> others;  // the cloth's vertices, including unused ones
    std::ranges::set_difference(of_cloth, vertices, std::back_inserter(others));
    of_cloth = std::move(others);
    objects.push_back({name, part_of(all, vertices)});
    objects.back().mesh.uvs.clear();
  }
  objects.front().mesh = part_of(all, of_cloth);
  return objects;
}

}  // namespace drape
