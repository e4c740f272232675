#include "tests/support/closed_meshes.hpp"

#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

namespace drape::test {
namespace {

/// Returns the number of the first vertex of a ring of a disc.
int first_of(int ring) { return ring == 0 ? 0 : 1 + 3 * ring * (ring - 1); }

/// Appends the triangles between two rings of a disc, of vertices that `number` maps.
template <class Number>
void join(int ring, bool up, const Number& number, std::vector<Triangle>& triangles) {
  const int inner = first_of(ring - 1), outer = first_of(ring), in = ring == 1 ? 1 : 6 * (ring - 1), out = 6 * ring;
  const auto add = [&](int a, int b, int c) {
    triangles.push_back(up ? Triangle{number(a), number(b), number(c)} : Triangle{number(a), number(c), number(b)});
  };
  for (int sector = 0; sector < 6; ++sector) {
    for (int i = 0; i < ring; ++i) {
      const int a = outer + (sector * ring + i) % out, b = outer + (sector * ring + i + 1) % out;
      const int c = inner + (sector * (ring - 1) + i) % in;
      add(a, b, c);
      if (i + 1 < ring) add(c, b, inner + (sector * (ring - 1) + i + 1) % in);
    }
  }
}

}  // namespace

Mesh ball(int n, double radius) {
  Mesh mesh;
  std::map<std::array<int, 3>, int> numbers;
  std::vector<Eigen::Vector3d> places;
  const auto vertex = [&](const std::array<int, 3>& at) {
    const auto [entry, created] = numbers.try_emplace(at, static_cast<int>(places.size()));
    if (created) places.emplace_back(radius * Eigen::Vector3d(at[0], at[1], at[2]).normalized());
    return entry->second;
  };
  for (const auto& [x, y, z] :
       {std::array{1, 1, 1}, {1, 1, -1}, {1, -1, 1}, {1, -1, -1}, {-1, 1, 1}, {-1, 1, -1}, {-1, -1, 1}, {-1, -1, -1}}) {
    const auto at = [&, x = x, y = y, z = z](int i, int j) { return vertex({x * (n - i - j), y * i, z * j}); };
    const bool outwards = x * y * z > 0;
    const auto add = [&](int a, int b, int c) {
      mesh.triangles.push_back(outwards ? Triangle{a, b, c} : Triangle{a, c, b});
    };
    for (int i = 0; i < n; ++i) {
      for (int j = 0; i + j < n; ++j) {
        add(at(i, j), at(i + 1, j), at(i, j + 1));
        if (i + j + 1 < n) add(at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
      }
    }
  }
  mesh.positions.resize(static_cast<Eigen::Index>(places.size()), 3);
  for (std::size_t i = 0; i < places.size(); ++i) mesh.positions.row(static_cast<Eigen::Index>(i)) = places[i];
  return mesh;
}

Mesh two_discs(int rings, double thickness) {
  const int inside = first_of(rings), all = first_of(rings + 1);
  Mesh mesh;
  mesh.positions.resize(all + inside, 3);
  for (int ring = 0; ring <= rings; ++ring) {
    const double r = static_cast<double>(ring) / rings, z = thickness / 2 * (1 - r * r);
    for (int i = first_of(ring); i < first_of(ring + 1); ++i) {
      const double angle = ring == 0 ? 0 : 2 * std::numbers::pi * (i - first_of(ring)) / (6 * ring);
      mesh.positions.row(i) << r * std::cos(angle), r * std::sin(angle), z;
      if (ring < rings) mesh.positions.row(all + i) << r * std::cos(angle), r * std::sin(angle), -z;
    }
  }
  for (int ring = 1; ring <= rings; ++ring) {
    join(
        ring, true, [](int i) { return i; }, mesh.triangles);
    join(
        ring, false, [&](int i) { return i < inside ? all + i : i; }, mesh.triangles);
  }
  return mesh;
}

Mesh gored_discs(int meridians, int rings, double thickness) {
  const int inside = 1 + meridians * (rings - 1);
  const auto number = [&](int side, int ring, int i) {
    const int around = i % meridians;
    if (ring == 0) return side * inside;
    return ring == rings ? 2 * inside + around : side * inside + 1 + (ring - 1) * meridians + around;
  };
  Mesh mesh;
  mesh.positions.resize(2 * inside + meridians, 3);
  const auto add = [&](int side, int a, int b, int c) {
    mesh.triangles.push_back(side == 0 ? Triangle{a, b, c} : Triangle{a, c, b});
  };
  for (int side = 0; side < 2; ++side) {
    for (int ring = 0; ring <= rings; ++ring) {
      const double r = static_cast<double>(ring) / rings, z = thickness / 2 * (1 - r * r);
      for (int i = 0; i < meridians; ++i) {
        const double angle = 2 * std::numbers::pi * i / meridians;
        mesh.positions.row(number(side, ring, i)) << r * std::cos(angle), r * std::sin(angle), side == 0 ? z : -z;
        if (ring == rings) continue;
        if (ring > 0) add(side, number(side, ring, i), number(side, ring + 1, i + 1), number(side, ring, i + 1));
        add(side, number(side, ring, i), number(side, ring + 1, i), number(side, ring + 1, i + 1));
      }
    }
  }
  return mesh;
}

}  // namespace drape::test
