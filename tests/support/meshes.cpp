#include "tests/support/meshes.hpp"

#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>
#include <vector>

#include "tests/support/random.hpp"

namespace drape::test {

Mesh irregular_mesh(int n) {
  Random random;
  Mesh mesh = make_grid(n, n);
  mesh.uvs.clear();
  const int count = static_cast<int>(mesh.positions.rows());
  const double jitter = 0.6 / n;
  for (int i = 0; i < count; ++i) {
    for (int axis = 0; axis < 3; ++axis) mesh.positions(i, axis) += jitter * (random.number() - 0.5);
  }
  std::erase_if(mesh.triangles, [&](const Triangle&) { return random.number() < 0.33; });

  std::vector<int> number(static_cast<std::size_t>(count));
  std::iota(number.begin(), number.end(), 0);
  for (int i = count - 1; i > 0; --i) {
    std::swap(number[static_cast<std::size_t>(i)], number[static_cast<std::size_t>(random.below(i + 1))]);
  }
  const Vertices ordered = mesh.positions;
  for (int i = 0; i < count; ++i) mesh.positions.row(number[static_cast<std::size_t>(i)]) = ordered.row(i);
  for (Triangle& triangle : mesh.triangles) {
    for (int& vertex : triangle) vertex = number[static_cast<std::size_t>(vertex)];
  }
  return mesh;
}

Mesh three_sheets(int n) {
  Mesh mesh;
  const int side = n + 1;
  mesh.positions.resize(side + 3 * n * side, 3);
  for (int i = 0; i < side; ++i) mesh.positions.row(i) << -1.0 + 2.0 * i / n, 0, 0;
  for (int sheet = 0; sheet < 3; ++sheet) {
    const double angle = (sheet - 1) * std::numbers::pi / 4;  // from straight down
    const auto vertex = [&](int i, int j) { return j == 0 ? i : side + (sheet * n + j - 1) * side + i; };
    for (int j = 1; j <= n; ++j) {
      const double down = 2.0 * j / n;
      for (int i = 0; i < side; ++i) {
        mesh.positions.row(vertex(i, j)) << -1.0 + 2.0 * i / n, down * std::sin(angle), -down * std::cos(angle);
      }
    }
    for (int j = 0; j < n; ++j) {
      for (int i = 0; i < n; ++i) {
        mesh.triangles.push_back({vertex(i + 1, j), vertex(i, j + 1), vertex(i, j)});
        mesh.triangles.push_back({vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)});
      }
    }
  }
  return mesh;
}

}  // namespace drape::test
