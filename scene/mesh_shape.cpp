#include "scene/mesh_shape.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <stdexcept>

#include "scene/table_reader.hpp"

namespace drape {
namespace {

constexpr double most_triangles = 8e6;  // same limit as for a grid

/// Returns the number of cells of the given length that fill a distance, at least one.
int cells_in(double distance, double length) {
  const double count = std::max(std::round(distance / length), 1.0);
  if (!(count < most_triangles)) throw std::invalid_argument("a mesh has at most 8 million triangles");
  return static_cast<int>(count);
}

void require_size(double triangles) {
  if (triangles > most_triangles) throw std::invalid_argument("a mesh has at most 8 million triangles");
}

/// Adds texture coordinates that cover a mesh once.
/// @param at the texture coordinates of a vertex
void cover(Mesh& mesh, const std::function<std::array<float, 2>(int)>& at) {
  for (const Triangle& triangle : mesh.triangles) {
    for (const int vertex : triangle) mesh.uvs.push_back(at(vertex));
  }
}

/// Makes rings of 6, 12, 18 … vertices around the centre, joined by triangles that are nearly equilateral.
Mesh make_disc(double radius, int rings) {
  require_size(6.0 * rings * rings);
  Mesh mesh;
  mesh.positions.setZero(1 + Eigen::Index{3} * rings * (rings + 1), 3);
  const auto first = [](int ring) { return ring == 0 ? 0 : 1 + 3 * ring * (ring - 1); };
  for (int ring = 1; ring <= rings; ++ring) {
    for (int i = 0; i < 6 * ring; ++i) {
      const double angle = std::numbers::pi * i / (3 * ring), r = radius * ring / rings;
      mesh.positions.row(first(ring) + i) << r * std::cos(angle), r * std::sin(angle), 0;
    }
  }
  for (int ring = 1; ring <= rings; ++ring) {
    const int inner = 6 * (ring - 1), outer = 6 * ring;
    const auto in = [&](int i) { return first(ring - 1) + (inner == 0 ? 0 : i % inner); };
    const auto out = [&](int i) { return first(ring) + i % outer; };
    for (int sixth = 0; sixth < 6; ++sixth) {
      for (int i = 0; i < ring; ++i) {
        const int o = sixth * ring + i, n = sixth * (ring - 1) + i;
        mesh.triangles.push_back({out(o), out(o + 1), in(n)});
        if (i + 1 < ring) mesh.triangles.push_back({in(n), out(o + 1), in(n + 1)});
      }
    }
  }
  cover(mesh, [&](int vertex) -> std::array<float, 2> {
    return {static_cast<float>((mesh.positions(vertex, 0) / radius + 1) / 2),
            static_cast<float>((mesh.positions(vertex, 1) / radius + 1) / 2)};
  });
  return mesh;
}

Mesh make_strip(double length, double width, int across) {
  const int along = cells_in(length, width / across);
  require_size(2.0 * along * across);
  Mesh mesh = make_grid(along, across);
  mesh.positions.col(0) *= length / 2;
  mesh.positions.col(1) *= width / 2;
  return mesh;
}

/// Makes the side of a frustum, open at both ends, counterclockwise seen from outside.
Mesh make_tube(const ParametricMesh& shape) {
  const double hem = shape.hem.value_or(shape.radius);
  const double slope = std::hypot(shape.length, hem - shape.radius);
  const double cell = std::numbers::pi * (hem + shape.radius) / shape.around;
  const int around = shape.around, rows = cells_in(slope, cell);
  require_size(2.0 * around * rows);
  Mesh mesh;
  mesh.positions.resize(Eigen::Index{around} * (rows + 1), 3);
  for (int row = 0; row <= rows; ++row) {
    const double t = static_cast<double>(row) / rows, r = hem + t * (shape.radius - hem);
    for (int i = 0; i < around; ++i) {
      const double angle = 2 * std::numbers::pi * i / around;
      mesh.positions.row(row * around + i) << r * std::cos(angle), r * std::sin(angle), (t - 0.5) * shape.length;
    }
  }
  const auto add = [&](int row, int i, std::array<std::array<int, 2>, 3> corners) {
    Triangle triangle{};
    for (std::size_t c = 0; c < 3; ++c) {
      const int column = i + corners[c][0], line = row + corners[c][1];
      triangle[c] = line * around + column % around;
      mesh.uvs.push_back({static_cast<float>(column) / static_cast<float>(around),
                          static_cast<float>(line) / static_cast<float>(rows)});
    }
    mesh.triangles.push_back(triangle);
  };
  for (int row = 0; row < rows; ++row) {
    for (int i = 0; i < around; ++i) {
      add(row, i, {{{1, 0}, {0, 1}, {0, 0}}});
      add(row, i, {{{1, 0}, {1, 1}, {0, 1}}});
    }
  }
  return mesh;
}

}  // namespace

const std::vector<std::string>& mesh_shape_names() {
  static const std::vector<std::string> names{"disc", "strip", "tube"};
  return names;
}

Keys mesh_shape_keys(ParametricMesh& shape) {
  using Kind = ParametricMesh::Kind;
  constexpr int most = 2000;
  Keys keys;
  switch (shape.kind) {
    case Kind::disc:
      keys.add("radius", &shape.radius, "m", "Its radius.").above(0);
      keys.add("rings", &shape.rings, "", "Edges from the centre to the border.").at_least(1).at_most(most);
      break;
    case Kind::strip:
      keys.add("length", &shape.length, "m", "Along x.").above(0);
      keys.add("width", &shape.width, "m", "Along y.").above(0);
      keys.add("across", &shape.across, "", "Cells along y; along x as many as make them square.")
          .at_least(1)
          .at_most(most);
      break;
    case Kind::tube:
      keys.add("radius", &shape.radius, "m", "Of its upper end.").above(0);
      keys.add("hem", &shape.hem, "m", "Radius of its lower end. Default: the same.").above(0);
      keys.add("length", &shape.length, "m", "Along z.").above(0);
      keys.add("around", &shape.around, "", "Cells around its axis; along it as many as make them square.")
          .at_least(3)
          .at_most(most);
      break;
  }
  return keys;
}

Mesh make_mesh_shape(const ParametricMesh& shape) {
  switch (shape.kind) {
    case ParametricMesh::Kind::strip:
      return make_strip(shape.length, shape.width, shape.across);
    case ParametricMesh::Kind::tube:
      return make_tube(shape);
    case ParametricMesh::Kind::disc:
      break;
  }
  return make_disc(shape.radius, shape.rings);
}

std::optional<ParametricMesh::Kind> mesh_shape_kind(const TomlValue& value) {
  const TomlTable* table = value.as<TomlTable>();
  for (std::size_t i = 0; table != nullptr && i < mesh_shape_names().size(); ++i) {
    if (table->find(mesh_shape_names()[i]) != nullptr) return static_cast<ParametricMesh::Kind>(i);
  }
  return std::nullopt;
}

std::optional<Mesh> read_mesh_shape(const TomlValue& value, const std::string& name, Problems& problems) {
  const std::size_t before = problems.count();
  ParametricMesh shape{.kind = *mesh_shape_kind(value)};
  const std::string& kind = mesh_shape_names()[static_cast<std::size_t>(shape.kind)];
  for (const TomlEntry& entry : value.as<TomlTable>()->entries) {
    if (entry.name == kind) continue;
    problems.add(entry.place, fmt::format("{}: '{}' is given, so '{}' cannot be", name, kind, entry.name));
  }
  TableReader(std::filesystem::path(), problems)
      .read(*value.as<TomlTable>()->find(kind),
            {.name = name + "." + kind, .help = {}, .keys = mesh_shape_keys(shape)});
  if (problems.count() != before) return std::nullopt;
  try {
    return make_mesh_shape(shape);
  } catch (const std::invalid_argument& error) {
    problems.add(value.place, fmt::format("{}.{}: {}", name, kind, error.what()));
    return std::nullopt;
  }
}

}  // namespace drape
