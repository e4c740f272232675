#include "sim/linear/constant_factor.hpp"

#include <algorithm>
#include <stdexcept>

#include "sim/kernels/kernels.hpp"
#include "sim/linear/free_vertices.hpp"

namespace drape {
namespace {

/// The lower triangle of A over the free vertices.
struct Matrix {
  LowerPattern pattern;
  std::vector<double> values;
};

Matrix assemble(const System& system, const FreeVertices& free) {
  Matrix matrix{.pattern = spring_pattern(system.springs, free), .values = {}};
  matrix.values.assign(static_cast<std::size_t>(matrix.pattern.entries()), 0.0);
  auto& [starts, rows] = matrix.pattern;
  const auto at = [&](int row, int column) -> double& {
    const auto begin = rows.begin() + starts[static_cast<std::size_t>(column)];
    const auto end = rows.begin() + starts[static_cast<std::size_t>(column) + 1];
    return matrix.values[static_cast<std::size_t>(std::lower_bound(begin, end, row) - rows.begin())];
  };
  const double h = system.step;
  for (int f = 0; f < free.count(); ++f) at(f, f) = system.cloth.masses[free.vertex(f)] / (h * h);
  for (const Spring& spring : system.springs) {
    const int i = free.number(spring.i), j = free.number(spring.j);
    if (i >= 0) at(i, i) += spring.stiffness;
    if (j >= 0) at(j, j) += spring.stiffness;
    if (i >= 0 && j >= 0) at(std::max(i, j), std::min(i, j)) -= spring.stiffness;
  }
  return matrix;
}

void solve_packed(const PackedTriangle<float>& triangle, float* x) { kernels().solve_single(triangle, x); }
void solve_packed(const PackedTriangle<double>& triangle, double* x) { kernels().solve_double(triangle, x); }

}  // namespace

ConstantFactor::ConstantFactor(const System& system, Precision precision) : vertex_count_(system.cloth.vertex_count()) {
  const FreeVertices free(system.cloth);
  if (free.count() == 0) return;
  const Matrix matrix = assemble(system, free);
  SparseCholesky factor(matrix.pattern, FactorKind::simplicial, false);
  if (!factor.factorize(matrix.values.data())) {
    throw std::domain_error("the cloth's constant matrix is not positive definite to working precision");
  }

  const auto columns = factor.columns();
  const int n = free.count();
  starts_.assign(1, 0);
  for (int c = 0; c < n; ++c) {
    vertices_.push_back(free.vertex(factor.permutation()[c]));
    rows_.insert(rows_.end(), columns.rows + columns.starts[c] + 1,
                 columns.rows + columns.starts[c] + columns.counts[c]);
    starts_.push_back(static_cast<int>(rows_.size()));
  }
  if (precision != Precision::single_precision) copy(factor, double_);
  if (precision != Precision::double_precision) copy(factor, single_);
  if (precision == Precision::automatic) {
    if (single_suffices()) {
      double_ = {};
    } else {
      single_ = {};
    }
  }
}

template <class T>
void ConstantFactor::copy(const SparseCholesky& factor, Triangle<T>& triangle) const {
  const auto columns = factor.columns();
  const auto n = vertices_.size();
  triangle.values.reserve(rows_.size());
  triangle.inverse_diagonal.reserve(n);
  triangle.scratch.assign(4 * n, T{0});
  for (std::size_t c = 0; c < n; ++c) {
    const double* column = columns.values + columns.starts[c];
    triangle.inverse_diagonal.push_back(static_cast<T>(1 / column[0]));
    for (int p = 1; p < columns.counts[c]; ++p) triangle.values.push_back(static_cast<T>(column[p]));
  }
}

template <class T>
void ConstantFactor::solve_with(Triangle<T>& triangle, const Vertices& b, Vertices& x) const {
  T* packed = triangle.scratch.data();
  for (const int vertex : vertices_) {
    for (int axis = 0; axis < 3; ++axis) *packed++ = static_cast<T>(b(vertex, axis));
    *packed++ = T{0};
  }
  const PackedTriangle<T> view{.size = static_cast<int>(vertices_.size()),
                               .starts = starts_.data(),
                               .rows = rows_.data(),
                               .values = triangle.values.data(),
                               .inverse_diagonal = triangle.inverse_diagonal.data()};
  solve_packed(view, triangle.scratch.data());
  packed = triangle.scratch.data();
  for (const int vertex : vertices_) {
    for (int axis = 0; axis < 3; ++axis) x(vertex, axis) = static_cast<double>(*packed++);
    ++packed;
  }
}

void ConstantFactor::solve(const Vertices& b, Vertices& x) {
  if (static_cast<std::size_t>(vertex_count_) != vertices_.size()) x.setZero();
  if (!single_precision()) {
    solve_with(double_, b, x);
    return;
  }
  // Scaled to its largest entry, no right-hand side leaves the range of single precision.
  const double largest = b.cwiseAbs().maxCoeff();
  if (!(largest > 0)) {
    x.setZero();
    return;
  }
  scaled_ = b / largest;
  solve_with(single_, scaled_, x);
  x *= largest;
}

bool ConstantFactor::single_suffices() {
  constexpr double tolerated = 1e-3;
  Vertices b(vertex_count_, 3), exact = Vertices::Zero(vertex_count_, 3), rounded = exact;
  // A smooth vector excites the smallest eigenvalues, where errors grow; an alternating one the largest.
  for (int i = 0; i < vertex_count_; ++i) b.row(i) << 1, (i % 2 == 0 ? 1 : -1), (i * 7 % 11) - 5;
  solve_with(double_, b, exact);
  solve_with(single_, b, rounded);
  for (int axis = 0; axis < 3; ++axis) {
    if (!((rounded - exact).col(axis).norm() <= tolerated * exact.col(axis).norm())) return false;
  }
  return true;
}

}  // namespace drape
