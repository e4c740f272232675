#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "sim/linear/sparse_cholesky.hpp"
#include "tests/support/matrices.hpp"
#include "tests/support/meshes.hpp"
#include "tests/support/setups.hpp"
#include "tests/support/usage_error.hpp"

namespace drape::test {
namespace {

/// The lower triangle of a symmetric matrix in SparseCholesky's format.
struct Lower {
  LowerPattern pattern;
  std::vector<double> values;

  explicit Lower(const SparseMatrix& matrix) {
    pattern.starts.push_back(0);
    for (int column = 0; column < matrix.outerSize(); ++column) {
      for (SparseMatrix::InnerIterator entry(matrix, column); entry; ++entry) {
        if (entry.row() < column) continue;
        pattern.rows.push_back(static_cast<int>(entry.row()));
        values.push_back(entry.value());
      }
      pattern.starts.push_back(static_cast<int>(pattern.rows.size()));
    }
  }
};

class SparseCholeskyOf : public testing::Test {
 protected:
  const Cloth cloth = cloth_of(irregular_mesh(14), 1, 180, {0, 5});
  const System system{cloth, 0.02};
  const SparseMatrix matrix = constant_matrix(system);
  const Lower lower{matrix};
};

TEST_F(SparseCholeskyOf, RefusesAnIndefiniteMatrixAndRecovers) {
  SparseCholesky factor(lower.pattern);
  std::vector<double> indefinite = lower.values;
  indefinite[static_cast<std::size_t>(lower.pattern.starts[100])] = -1;  // a diagonal entry
  EXPECT_FALSE(factor.factorize(indefinite.data()));
  ASSERT_TRUE(factor.factorize(lower.values.data()));
  EXPECT_FALSE(factor.factorize(indefinite.data()));
  EXPECT_TRUE(factor.factorize(lower.values.data()));
}

TEST_F(SparseCholeskyOf, PermutesEveryRowOnce) {
  const SparseCholesky factor(lower.pattern);
  std::vector<int> order(factor.permutation(), factor.permutation() + matrix.rows());
  std::sort(order.begin(), order.end());
  EXPECT_EQ(order, every(static_cast<int>(matrix.rows())));
}

TEST_F(SparseCholeskyOf, ShowsTheFactorItself) {
  SparseCholesky factor(lower.pattern);
  ASSERT_TRUE(factor.factorize(lower.values.data()));
  const auto n = matrix.rows();
  Eigen::MatrixXd triangle = Eigen::MatrixXd::Zero(n, n);
  const auto columns = factor.columns();
  for (Eigen::Index c = 0; c < n; ++c) {
    EXPECT_EQ(columns.rows[columns.starts[c]], c) << "the diagonal comes first";
    for (int p = columns.starts[c]; p < columns.starts[c] + columns.counts[c]; ++p) {
      triangle(columns.rows[p], c) = columns.values[p];
    }
  }
  const Eigen::MatrixXd product = triangle * triangle.transpose();
  double difference = 0;
  for (Eigen::Index r = 0; r < n; ++r) {
    for (Eigen::Index c = 0; c < n; ++c) {
      const double expected = matrix.coeff(factor.permutation()[r], factor.permutation()[c]);
      difference = std::max(difference, std::abs(product(r, c) - expected));
    }
  }
  EXPECT_LT(difference, 1e-12 * product.cwiseAbs().maxCoeff());
}

// Eliminating the rim first leaves each of its columns with two entries below the diagonal.
TEST(SparseCholesky, OfAStarIsAsSparseAsTheStar) {
  constexpr int rim = 100'000;
  LowerPattern star;
  star.starts.push_back(0);
  for (int column = 0; column <= rim; ++column) {
    star.rows.push_back(column);
    for (int row = column + 1; row <= (column == 0 ? rim : std::min(column + 1, rim)); ++row) star.rows.push_back(row);
    star.starts.push_back(static_cast<int>(star.rows.size()));
  }
  std::vector<double> values(star.rows.size(), -1.0);
  for (int column = 0; column <= rim; ++column) {
    values[static_cast<std::size_t>(star.starts[static_cast<std::size_t>(column)])] = column == 0 ? 2.0 * rim : 4;
  }
  SparseCholesky factor(star);
  ASSERT_TRUE(factor.factorize(values.data()));
  int entries = 0;
  for (int column = 0; column <= rim; ++column) entries += factor.columns().counts[column];
  EXPECT_LE(entries, 3 * (rim + 1));
}

TEST(SparseCholesky, RefusesAGraphWhereEverythingIsJoined) {
  constexpr int n = 6000;
  LowerPattern all;
  all.starts.push_back(0);
  for (int column = 0; column < n; ++column) {
    for (int row = column; row < n; ++row) all.rows.push_back(row);
    all.starts.push_back(static_cast<int>(all.rows.size()));
  }
  const std::string problem = usage_error([&] { SparseCholesky{all}; });
  EXPECT_NE(problem.find("a sparse factor of 6000 rows takes 7.2e+10 operations"), std::string::npos) << problem;
}

}  // namespace
}  // namespace drape::test
