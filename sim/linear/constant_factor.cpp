#include "sim/linear/constant_factor.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "drape/core/error.hpp"
#include "sim/linear/multifrontal_cholesky.hpp"
#include "sim/linear/solve_tree.hpp"
#include "sim/linear/sparse_cholesky.hpp"
#include "sim/parallel/loops.hpp"
#include "sim/parallel/vectors.hpp"

namespace drape {
namespace {

// Largest ratio of numbers stored in a panel to entries of L: zeros cost less than another panel.
constexpr double tolerated_zeros = 1.6;

/// Lower triangle of A over the free vertices.
struct Matrix {
  LowerPattern pattern;
  std::vector<double> values;
};

Matrix assemble(const System& system, double duration, const FreeVertices& free) {
  const StiffnessBound bound = system.stiffness_bound();
  Matrix matrix{.pattern = spring_pattern(bound, free), .values = {}};
  matrix.values.assign(static_cast<std::size_t>(matrix.pattern.entries()), 0.0);
  const std::vector<int>&starts = matrix.pattern.starts, &rows = matrix.pattern.rows;
  const auto at = [&](int row, int column) -> double& {
    const auto begin = rows.begin() + starts[static_cast<std::size_t>(column)];
    const auto end = rows.begin() + starts[static_cast<std::size_t>(column) + 1];
    return matrix.values[static_cast<std::size_t>(std::lower_bound(begin, end, row) - rows.begin())];
  };
  const Eigen::VectorXd diagonal = system.inertia(duration) + bound.vertices;
  for (int f = 0; f < free.count(); ++f) at(f, f) = diagonal[free.vertex(f)];
  bound.for_each_pair([&](const Spring& spring) {
    const int i = free.number(spring.i), j = free.number(spring.j);
    if (i >= 0) at(i, i) += spring.stiffness;
    if (j >= 0) at(j, j) += spring.stiffness;
    if (i >= 0 && j >= 0) at(std::max(i, j), std::min(i, j)) -= spring.stiffness;
  });
  return matrix;
}

}  // namespace

ConstantFactor::ConstantFactor(const System& system, double duration, Precision precision)
    : threads_(system.threads), vertex_count_(system.cloth.vertex_count()) {
  const FreeVertices free(system.cloth);
  row_count_ = free.count();
  row_.assign(static_cast<std::size_t>(vertex_count_), row_count_);
  if (row_count_ == 0) return;
  const Matrix matrix = assemble(system, duration, free);
  const bool factored = row_count_ < large_cloth  // above it our own is faster (bench/README.md)
                            ? factor_columns(matrix.pattern, matrix.values, system.stop, free)
                            : factor_fronts(matrix.pattern, matrix.values, system, free);
  if (!factored) {
    throw UsageError(
        "the cloth's matrix is not positive definite to working precision: use a shorter step, softer springs or more "
        "mass");
  }
  if (precision != Precision::double_precision) single_.values.assign(double_.values.begin(), double_.values.end());
  if (precision == Precision::single_precision) double_ = {};
  find_places();
  if (precision != Precision::automatic) return;
  if (single_suffices()) {
    double_ = {};
  } else {
    single_ = {};
  }
}

bool ConstantFactor::factor_columns(const LowerPattern& pattern, const std::vector<double>& values, const Stop& stop,
                                    const FreeVertices& free) {
  SparseCholesky factor(pattern, tolerated_zeros * (sizeof(double) + sizeof(float)));
  stop.check();
  if (!factor.factorize(values.data())) return false;
  stop.check();
  number_rows(factor.permutation(), free);
  find_panels(factor.columns());
  copy(factor.columns());
  return true;
}

bool ConstantFactor::factor_fronts(const LowerPattern& pattern, const std::vector<double>& values, const System& system,
                                   const FreeVertices& free) {
  system.stop.check();
  MultifrontalCholesky factor(pattern, dissect(pattern, free.rest_places(system.cloth)), Solves::many, sizeof(float));
  if (!factor.factorize(values.data(), [&] { system.stop.check(); })) return false;
  number_rows(factor.permutation().data(), free);
  entries_ = factor.entries();
  auto parts = std::move(factor).take();
  panels_ = std::move(parts.panels);
  rows_ = std::move(parts.rows);
  double_.values = std::move(parts.values);
  return true;
}

double ConstantFactor::operations() const {
  double sum = 0;
  for (const Panel& panel : panels_) {
    for (int below = panel.row_count + 1; below <= panel.row_count + panel.width; ++below) {
      sum += static_cast<double>(below) * below;
    }
  }
  return sum;
}

void ConstantFactor::number_rows(const int* permutation, const FreeVertices& free) {
  for (int row = 0; row < row_count_; ++row) row_[static_cast<std::size_t>(free.vertex(permutation[row]))] = row;
}

void ConstantFactor::find_panels(const SparseCholesky::Columns& columns) {
  const int n = row_count_;
  for (int first = 0; first < n;) {
    // The next column shares the rows of this one if it is its parent in the elimination tree: the first row below.
    Panel panel{.first = first, .width = 1, .row_count = columns.counts[first] - 1};
    int last = first, entries = columns.counts[first];
    while (panel.width < panel_width && columns.counts[last] > 1 &&
           columns.rows[columns.starts[last] + 1] == last + 1) {
      ++last;
      entries += columns.counts[last];
      const Panel wider{.first = first, .width = panel.width + 1, .row_count = columns.counts[last] - 1};
      if (static_cast<double>(panel_size(wider)) > tolerated_zeros * entries) break;
      panel = wider;
    }
    last = first + panel.width - 1;
    rows_.insert(rows_.end(), columns.rows + columns.starts[last] + 1,
                 columns.rows + columns.starts[last] + columns.counts[last]);
    entries_ += panel_size(panel);
    panels_.push_back(panel);
    first += panel.width;
  }
}

void ConstantFactor::copy(const SparseCholesky::Columns& columns) {
  double_.values.assign(entries_, 0.0);
  std::vector<int> place(static_cast<std::size_t>(row_count_));  // index of a row among those below the panel
  const int* rows = rows_.data();
  double* values = double_.values.data();
  for (const Panel& panel : panels_) {
    Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(panel.width, panel.width);
    double* below = values + panel.width * (panel.width + 1) / 2;
    for (int p = 0; p < panel.row_count; ++p) place[static_cast<std::size_t>(rows[p])] = p;
    for (int c = 0; c < panel.width; ++c) {
      const int start = columns.starts[panel.first + c];
      for (int p = start; p < start + columns.counts[panel.first + c]; ++p) {
        const int r = columns.rows[p] - panel.first;
        if (r < panel.width) {
          dense(r, c) = columns.values[p];
        } else {
          below[place[static_cast<std::size_t>(columns.rows[p])] * panel.width + c] = columns.values[p];
        }
      }
    }
    // With an inverted triangle no row waits for the previous one.
    const Eigen::MatrixXd inverse =
        dense.triangularView<Eigen::Lower>().solve(Eigen::MatrixXd::Identity(panel.width, panel.width));
    for (int r = 0; r < panel.width; ++r) {
      for (int c = 0; c <= r; ++c) *values++ = inverse(r, c);
    }
    values += std::ptrdiff_t{panel.width} * panel.row_count;
    rows += panel.row_count;
  }
}

void ConstantFactor::find_places() {
  tree_ = SolveTree(panels_, rows_, row_count_);
  place_count_ = tree_.place_count();
  for (int& row : row_) row = row == row_count_ ? place_count_++ : tree_.place(row);
  const auto numbers = 4 * static_cast<std::size_t>(place_count_);
  if (!single_.values.empty()) single_.scratch.assign(numbers, 0.0F);
  if (!double_.values.empty()) double_.scratch.assign(numbers, 0.0);
}

template <class T>
void ConstantFactor::solve_packed(Triangle<T>& triangle, const Vertices& b) const {
  T* packed = triangle.scratch.data();
  for_ranges(threads_, vertex_count_, [&](Eigen::Index first, Eigen::Index count) {
    (kernels().*Substitution<T>::pack)(static_cast<int>(count), columns(b, first), row_.data() + first, packed);
  });
  tree_.solve(threads_,
              {.panels = panels_.data(),
               .panel_count = static_cast<int>(panels_.size()),
               .rows = rows_.data(),
               .values = triangle.values.data()},
              packed);
  std::fill(packed + 4 * static_cast<std::size_t>(tree_.place_count()),
            packed + 4 * static_cast<std::size_t>(place_count_), T{0});
}

template <class T>
void ConstantFactor::solve_with(Triangle<T>& triangle, const Vertices& b, Vertices& x) const {
  solve_packed(triangle, b);
  for_ranges(threads_, vertex_count_, [&](Eigen::Index first, Eigen::Index count) {
    (kernels().*Substitution<T>::unpack)(static_cast<int>(count), triangle.scratch.data(), row_.data() + first,
                                         columns(x, first));
  });
}

void ConstantFactor::solve(const Vertices& b, Vertices& x) {
  if (row_count_ == 0) {
    x.setZero();
  } else if (single_precision()) {
    solve_with(single_, b, x);
  } else {
    solve_with(double_, b, x);
  }
}

double ConstantFactor::subtract_solution(const Vertices& b, Vertices& x) {
  const auto subtract = [&]<class T>(Triangle<T>& triangle) {
    solve_packed(triangle, b);
    return sum_of(threads_, vertex_count_, [&](Eigen::Index first, Eigen::Index count) {
      return (kernels().*Substitution<T>::subtract)(static_cast<int>(count), triangle.scratch.data(),
                                                    row_.data() + first, columns(x, first));
    });
  };
  if (row_count_ == 0) return 0;
  return std::sqrt(single_precision() ? subtract(single_) : subtract(double_));
}

bool ConstantFactor::single_suffices() {
  constexpr double tolerated = 1e-3;
  Vertices b(vertex_count_, 3), exact = Vertices::Zero(vertex_count_, 3), rounded = exact;
  // A smooth vector excites the smallest eigenvalues, which amplify errors; an alternating one excites the largest.
  for (int i = 0; i < vertex_count_; ++i) b.row(i) << 1, (i % 2 == 0 ? 1 : -1), (i * 7 % 11) - 5;
  solve_with(double_, b, exact);
  solve_with(single_, b, rounded);
  for (int axis = 0; axis < 3; ++axis) {
    if (!((rounded - exact).col(axis).norm() <= tolerated * exact.col(axis).norm())) return false;
  }
  return true;
}

}  // namespace drape
