#include "bench/factoring.hpp"

#include <fmt/format.h>

#include <memory>

#include "bench/moving_cloth.hpp"
#include "bench/subject.hpp"
#include "sim/linear/dissection.hpp"
#include "sim/linear/free_vertices.hpp"
#include "sim/linear/multifrontal_cholesky.hpp"

namespace drape {
namespace {

/// M/h² + L of a cloth without pins, h = 0.02 s.
struct ClothMatrix {
  Cloth cloth;
  LowerPattern pattern;
  std::vector<double> values;

  explicit ClothMatrix(int cells) : cloth(make_resting_cloth(cells)) {
    cloth.pins.clear();
    pattern = spring_pattern({.springs = cloth.springs}, FreeVertices(cloth));
    values.assign(pattern.rows.size(), -cloth.springs.front().stiffness);
    std::vector<double> diagonal(static_cast<std::size_t>(cloth.vertex_count()), cloth.masses[0] / 4e-4);
    for (const Spring& s : cloth.springs) {
      for (const int end : {s.i, s.j}) diagonal[static_cast<std::size_t>(end)] += s.stiffness;
    }
    for (std::size_t v = 0; v < diagonal.size(); ++v) values[static_cast<std::size_t>(pattern.starts[v])] = diagonal[v];
  }
};

Subject make_fronts(int cells) {
  const auto matrix = std::make_shared<ClothMatrix>(cells);
  return {.restore = [] {},
          .run =
              [matrix] {
                MultifrontalCholesky factor(matrix->pattern, dissect(matrix->pattern, matrix->cloth.rest));
                return factor.factorize(matrix->values.data()) ? 1 : 0;
              }};
}

Subject make_cholmod(int cells) {
  const auto matrix = std::make_shared<ClothMatrix>(cells);
  return {.restore = [] {},
          .run =
              [matrix] {
                SparseCholesky factor(matrix->pattern);
                return factor.factorize(matrix->values.data()) ? 1 : 0;
              }};
}

}  // namespace

std::vector<std::string> register_factoring() {
  std::vector<std::string> names;
  for (const int cells : {100, 300}) {
    names.push_back(fmt::format("factor/{}", cells));
    register_subject(names.back(), "fronts", 1, [cells] { return make_fronts(cells); });
    register_subject(names.back(), "cholmod", 1, [cells] { return make_cholmod(cells); });
  }
  return names;
}

}  // namespace drape
