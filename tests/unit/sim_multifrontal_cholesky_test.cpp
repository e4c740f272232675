#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "sim/linear/multifrontal_cholesky.hpp"
#include "tests/support/meshes.hpp"
#include "tests/support/setups.hpp"
#include "tests/unit/kernels_version.hpp"

namespace drape::test {
namespace {

/// A symmetric matrix, dense and as its sparse lower triangle.
struct Symmetric {
  Eigen::MatrixXd dense;
  LowerPattern pattern;
  std::vector<double> values;

  /// Stores the nonzero entries of a matrix's lower triangle.
  explicit Symmetric(Eigen::MatrixXd lower) : dense(std::move(lower)) {
    pattern.starts.push_back(0);
    for (int column = 0; column < dense.cols(); ++column) {
      for (int row = column; row < dense.rows(); ++row) {
        if (dense(row, column) == 0) continue;
        pattern.rows.push_back(row);
        values.push_back(dense(row, column));
      }
      pattern.starts.push_back(static_cast<int>(pattern.rows.size()));
    }
    dense = dense.selfadjointView<Eigen::Lower>();
  }
};

/// Makes a diagonally dominant positive definite matrix, coupled where `coupled(row, column)` is true.
template <class Coupled>
Symmetric graph(int n, const Coupled& coupled) {
  Random random(7);
  Eigen::MatrixXd lower = Eigen::MatrixXd::Zero(n, n);
  Eigen::VectorXd diagonal = Eigen::VectorXd::Ones(n);
  for (int column = 0; column < n; ++column) {
    for (int row = column + 1; row < n; ++row) {
      if (!coupled(row, column)) continue;
      lower(row, column) = random.between(-1, 1);
      diagonal[row] += std::abs(lower(row, column));
      diagonal[column] += std::abs(lower(row, column));
    }
  }
  lower.diagonal() = diagonal;
  return Symmetric(lower);
}

Symmetric random_graph(int n, double neighbours) {
  Random random(3);
  return graph(n, [&](int, int) { return random.number() * n < neighbours; });
}
Symmetric full(int n) {
  return graph(n, [](int, int) { return true; });
}

/// A surface's matrix: the vertices of a grid, each coupled to its neighbours.
struct GridMatrix {
  Mesh mesh;
  LowerPattern pattern;
  std::vector<double> values;

  explicit GridMatrix(int cells) : mesh(make_grid(cells, cells)) {
    const int n = static_cast<int>(mesh.positions.rows());
    std::vector<std::vector<int>> below(static_cast<std::size_t>(n));
    for (const Edge& edge : unique_edges(mesh.triangles)) below[static_cast<std::size_t>(edge[0])].push_back(edge[1]);
    pattern.starts.push_back(0);
    for (int v = 0; v < n; ++v) {
      pattern.rows.push_back(v);
      values.push_back(7);
      for (const int row : below[static_cast<std::size_t>(v)]) {
        pattern.rows.push_back(row);
        values.push_back(-1);
      }
      pattern.starts.push_back(static_cast<int>(pattern.rows.size()));
    }
  }
};

/// Returns L of the factor, with its zeros.
Eigen::MatrixXd lower_of(const MultifrontalCholesky& factor, int n) {
  Eigen::MatrixXd lower = Eigen::MatrixXd::Zero(n, n);
  const PackedTriangle<double> triangle = factor.triangle();
  const int* rows = triangle.rows;
  const double* values = triangle.values;
  for (int p = 0; p < triangle.panel_count; ++p) {
    const Panel& panel = triangle.panels[p];
    Eigen::MatrixXd inverse = Eigen::MatrixXd::Zero(panel.width, panel.width);
    for (int r = 0; r < panel.width; ++r) {
      for (int c = 0; c <= r; ++c) inverse(r, c) = *values++;
    }
    lower.block(panel.first, panel.first, panel.width, panel.width) = inverse.inverse();
    for (int r = 0; r < panel.row_count; ++r) {
      for (int c = 0; c < panel.width; ++c) lower(*rows, panel.first + c) = *values++;
      ++rows;
    }
  }
  return lower;
}

void expect_factor_of(const Symmetric& matrix, const std::vector<int>& order, const std::string& what) {
  const auto n = static_cast<int>(matrix.dense.rows());
  MultifrontalCholesky factor(matrix.pattern, order);
  std::vector<int> rows = factor.permutation();
  const Eigen::PermutationMatrix<Eigen::Dynamic> permute(Eigen::Map<const Eigen::VectorXi>(rows.data(), n));
  std::sort(rows.begin(), rows.end());
  ASSERT_EQ(rows, every(n)) << what;
  ASSERT_TRUE(factor.factorize(matrix.values.data())) << what;
  const Eigen::MatrixXd lower = lower_of(factor, n), ordered = permute.transpose() * matrix.dense * permute;
  EXPECT_LT((lower * lower.transpose() - ordered).cwiseAbs().maxCoeff(), 1e-14 * n * ordered.cwiseAbs().maxCoeff())
      << what;
  const Eigen::VectorXd b = random_vertices(n, 3).col(0);
  Eigen::VectorXd x = b;
  factor.solve(x.data(), x.data());
  EXPECT_LT((matrix.dense * x - b).norm(), 1e-13 * b.norm()) << what;
}

TEST(MultifrontalCholesky, IsAFactorOfWhatItIsGiven) {
  for (const int n : {1, 2, 7, 8, 9, 31, 150}) {
    for (const double neighbours : {0.0, 1.5, 4.0, 20.0}) {
      const Symmetric matrix = random_graph(n, neighbours);
      const std::string what = std::to_string(n) + " rows with " + std::to_string(neighbours) + " neighbours";
      expect_factor_of(matrix, {}, what);
      expect_factor_of(matrix, dissect(matrix.pattern, random_vertices(n, 5)), what + ", dissected");
      expect_factor_of(matrix, dissect(matrix.pattern, Vertices::Zero(n, 3)), what + ", all in one place");
    }
  }
}

TEST(MultifrontalCholesky, TakesAnyGraph) {
  constexpr int n = 120;
  const auto joined = [](int row, int column) { return column == 0 || row == column + 1; };
  const auto expect = [](const Symmetric& matrix, const std::string& what) {
    expect_factor_of(matrix, dissect(matrix.pattern, random_vertices(matrix.dense.rows(), 2)), what);
  };
  expect(graph(n, [](int, int column) { return column == 0; }), "a star");
  expect(graph(n, joined), "a chain and a vertex joined to all of it");
  expect(graph(n, [](int row, int column) { return row / 10 == column / 10; }), "pieces");
  expect(full(300), "where all are joined");  // more columns than are eliminated at once
}

TEST(MultifrontalCholesky, CountsWhatAFullMatrixTakes) {
  for (const int n : {1, 8, 21, 200}) {
    const MultifrontalCholesky factor(full(n).pattern);
    EXPECT_EQ(factor.operations(), n * (n + 1.0) * (2 * n + 1) / 6) << n;
    EXPECT_EQ(factor.entries(), static_cast<std::size_t>(n) * static_cast<std::size_t>(n + 1) / 2) << n;
  }
}

void expect_solution(MultifrontalCholesky& factor, const Symmetric& matrix) {
  const Eigen::VectorXd b = random_vertices(matrix.dense.rows(), 3).col(0);
  Eigen::VectorXd x = b;
  factor.solve(x.data(), x.data());
  EXPECT_LT((matrix.dense * x - b).norm(), 1e-13 * b.norm());
}

TEST(MultifrontalCholesky, RefusesAnIndefiniteMatrixAndRecovers) {
  const Symmetric matrix = random_graph(150, 4);
  MultifrontalCholesky factor(matrix.pattern);
  for (const double wrong :
       {-1.0, 0.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    std::vector<double> indefinite = matrix.values;
    indefinite[static_cast<std::size_t>(matrix.pattern.starts[70])] = wrong;  // on the diagonal
    EXPECT_FALSE(factor.factorize(indefinite.data())) << wrong;
    ASSERT_TRUE(factor.factorize(matrix.values.data()));
    expect_solution(factor, matrix);
  }
}

TEST(MultifrontalCholesky, CanBeStopped) {
  const Symmetric matrix = full(700);
  MultifrontalCholesky factor(matrix.pattern);
  int calls = 0;
  ASSERT_TRUE(factor.factorize(matrix.values.data(), [&] { ++calls; }));
  EXPECT_GE(calls, factor.operations() / 4e7) << "every few milliseconds";
  const auto stop = [] { throw std::runtime_error("stopped"); };
  EXPECT_THROW((void)factor.factorize(matrix.values.data(), stop), std::runtime_error);
  ASSERT_TRUE(factor.factorize(matrix.values.data()));
  expect_solution(factor, matrix);
}

// George 1973: a grid of n vertices takes O(n^1.5) operations, about 20 n^1.5 with seven entries in a row.
TEST(Dissection, OfAGridIsThatOfGeorge) {
  double before = 0;
  for (const int cells : {31, 63, 127}) {
    const GridMatrix grid(cells);
    const MultifrontalCholesky factor(grid.pattern, dissect(grid.pattern, grid.mesh.positions));
    EXPECT_LT(factor.operations(), 25 * std::pow(cells + 1, 3));
    if (before > 0) {
      EXPECT_LT(factor.operations(), 9 * before) << "for four times the vertices";
    }
    before = factor.operations();
  }
}

TEST(Dissection, ThatFitsTheGraphBadlyIsNotTaken) {
  const GridMatrix grid(63);
  const auto n = static_cast<int>(grid.mesh.positions.rows());
  const MultifrontalCholesky good(grid.pattern, dissect(grid.pattern, grid.mesh.positions));
  const MultifrontalCholesky bad(grid.pattern, dissect(grid.pattern, random_vertices(n, 9)));
  EXPECT_LT(bad.operations(), 2 * good.operations());
}

class MultifrontalKernels : public KernelsVersion {};
INSTANTIATE_TEST_SUITE_P(For, MultifrontalKernels, testing::ValuesIn(all_kernels().begin(), all_kernels().end()),
                         [](const auto& info_) { return std::string(info_.param->name); });

TEST_P(MultifrontalKernels, GiveTheSameBits) {
  const auto factor_with = [](const Kernels& version, const auto& matrix, const std::vector<int>& order) {
    const Kernels& others = replace_kernels(version);
    MultifrontalCholesky factor(matrix.pattern, order);
    EXPECT_TRUE(factor.factorize(matrix.values.data()));
    replace_kernels(others);
    return std::move(factor).take().values;
  };
  const GridMatrix grid(70);
  const std::vector<int> order = dissect(grid.pattern, grid.mesh.positions);
  EXPECT_TRUE(same(factor_with(reference, grid, order), factor_with(tested, grid, order)));
  for (const int n : {5, 30, 301}) {
    EXPECT_TRUE(same(factor_with(reference, full(n), {}), factor_with(tested, full(n), {}))) << n;
  }
}

}  // namespace
}  // namespace drape::test
