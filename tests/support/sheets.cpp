#include "tests/support/sheets.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "sim/collision/distance.hpp"

namespace drape::test {

Cloth square(int count) {
  const Mesh mesh = make_grid(count, count);
  return make_cloth(mesh, mesh, 1, 10, {});
}

Cloth hexagon(int count) {
  std::map<std::pair<int, int>, int> numbers;
  Mesh mesh;
  mesh.positions.resize(1 + 3 * count * (count + 1), 3);
  for (int r = -count; r <= count; ++r) {
    for (int q = std::max(-count, -r - count); q <= std::min(count, count - r); ++q) {
      const int number = static_cast<int>(numbers.size());
      mesh.positions.row(number) << (q + r / 2.0) / count, r * std::sqrt(0.75) / count, 0;
      numbers[{q, r}] = number;
    }
  }
  const auto add = [&](const std::array<std::pair<int, int>, 3>& corners) {
    Triangle triangle{};
    for (std::size_t k = 0; k < 3; ++k) {
      const auto found = numbers.find(corners[k]);
      if (found == numbers.end()) return;
      triangle[k] = found->second;
    }
    mesh.triangles.push_back(triangle);
  };
  for (const auto& [place, number] : numbers) {
    const auto [q, r] = place;
    add({{{q, r}, {q + 1, r}, {q, r + 1}}});
    add({{{q, r}, {q + 1, r - 1}, {q + 1, r}}});
  }
  return make_cloth(mesh, mesh, 1, 10, {});
}

Cloth cut_square(int count, double from_x, double to_x, double from_y, double to_y) {
  Cloth cloth = square(count);
  std::erase_if(cloth.triangles, [&](const Triangle& t) {
    const Eigen::RowVector3d middle = (cloth.rest.row(t[0]) + cloth.rest.row(t[1]) + cloth.rest.row(t[2])) / 3;
    return middle[0] > from_x && middle[0] < to_x && middle[1] > from_y && middle[1] < to_y;
  });
  return cloth;
}
Cloth holed(int count) { return cut_square(count, -0.5, 0.25, -0.25, 0.5); }
Cloth notched(int count) { return cut_square(count, -2, 0.5, -0.25, 0.25); }

Vertices at_rest(const Cloth& cloth) { return Vertices::Zero(cloth.vertex_count(), 3); }

Nearness nearness(const Cloth& cloth, const Vertices& from, const Vertices& moves) {
  std::vector<std::pair<Feature, std::array<int, 4>>> pairs;
  const std::vector<Edge> edges = unique_edges(cloth.triangles);
  std::set<int> corners;
  for (const auto& [a, b] : edges) corners.insert({a, b});
  for (const int i : corners) {
    for (const auto& [a, b, c] : cloth.triangles) {
      if (i != a && i != b && i != c) pairs.push_back({Feature::vertex_triangle, {i, a, b, c}});
    }
  }
  for (std::size_t k = 0; k < edges.size(); ++k) {
    for (std::size_t l = k + 1; l < edges.size(); ++l) {
      const auto& [a, b] = edges[k];
      const auto& [c, d] = edges[l];
      if (a != c && a != d && b != c && b != d) pairs.push_back({Feature::edge_edge, {a, b, c, d}});
    }
  }
  Nearness found{.distance = INFINITY, .part = INFINITY};
  for (const auto& [feature, vertices] : pairs) {
    double before = 0;
    for (const double time : {0.0, 0.25, 0.5, 0.75, 1.0}) {
      FourPoints p;
      for (std::size_t k = 0; k < 4; ++k) {
        p[k] = (from.row(vertices[k]) + time * moves.row(vertices[k])).transpose();
      }
      const double distance = std::sqrt(nearest(feature, p).squared);
      if (time == 0) before = distance;
      found.distance = std::min(found.distance, distance);
      found.part = std::min(found.part, distance / before);
    }
  }
  return found;
}

}  // namespace drape::test
