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

/// The lower triangle of a symmetric matrix in the form that SparseCholesky takes.
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

struct FactorCase {
  const char* name;
  FactorKind kind;
  bool order_given;
};

class SparseCholeskyOf : public testing::TestWithParam<FactorCase> {
 protected:
  const Cloth cloth = cloth_of(irregular_mesh(14), 1, 180, {0, 5});
  const System system{cloth, 0.02};
  const SparseMatrix matrix = constant_matrix(system);
  const Lower lower{matrix};
};
INSTANTIATE_TEST_SUITE_P(Kind, SparseCholeskyOf,
                         testing::Values(FactorCase{"Simplicial", FactorKind::simplicial, false},
                                         FactorCase{"Supernodal", FactorKind::supernodal, false},
                                         FactorCase{"SimplicialInTheGivenOrder", FactorKind::simplicial, true},
                                         FactorCase{"SupernodalInTheGivenOrder", FactorKind::supernodal, true}),
                         [](const auto& tested) { return tested.param.name; });

TEST_P(SparseCholeskyOf, SolvesWhatItFactored) {
  SparseCholesky factor(lower.pattern, GetParam().kind, GetParam().order_given);
  for (const double scale : {1.0, 1e-3, 1e6}) {  // the values may change
    std::vector<double> values = lower.values;
    for (double& value : values) value *= scale;
    ASSERT_TRUE(factor.factorize(values.data()));
    const Eigen::VectorXd b = random_vertices(matrix.rows(), 3).col(0);
    Eigen::VectorXd x(b.size());
    factor.solve(b.data(), x.data());
    EXPECT_LT((scale * (matrix * x) - b).norm(), 1e-12 * b.norm());
    Eigen::VectorXd in_place = b;
    factor.solve(in_place.data(), in_place.data());
    EXPECT_EQ((in_place - x).norm(), 0);
  }
}

TEST_P(SparseCholeskyOf, RefusesAnIndefiniteMatrixAndRecovers) {
  SparseCholesky factor(lower.pattern, GetParam().kind, GetParam().order_given);
  std::vector<double> indefinite = lower.values;
  indefinite[static_cast<std::size_t>(lower.pattern.starts[100])] = -1;  // a diagonal entry
  EXPECT_FALSE(factor.factorize(indefinite.data()));
  ASSERT_TRUE(factor.factorize(lower.values.data()));
  EXPECT_FALSE(factor.factorize(indefinite.data()));
  ASSERT_TRUE(factor.factorize(lower.values.data()));
  const Eigen::VectorXd b = random_vertices(matrix.rows(), 3).col(0);
  Eigen::VectorXd x(b.size());
  factor.solve(b.data(), x.data());
  EXPECT_LT((matrix * x - b).norm(), 1e-12 * b.norm());
}

TEST_P(SparseCholeskyOf, PermutesEveryRowOnce) {
  const SparseCholesky factor(lower.pattern, GetParam().kind, GetParam().order_given);
  std::vector<int> order(factor.permutation(), factor.permutation() + matrix.rows());
  if (GetParam().order_given) {
    EXPECT_EQ(order, every(static_cast<int>(matrix.rows())));
  }
  std::sort(order.begin(), order.end());
  EXPECT_EQ(order, every(static_cast<int>(matrix.rows())));
}

TEST_P(SparseCholeskyOf, ShowsTheFactorItself) {
  SparseCholesky factor(lower.pattern, GetParam().kind, GetParam().order_given);
  ASSERT_TRUE(factor.factorize(lower.values.data()));
  if (GetParam().kind == FactorKind::supernodal) {
    EXPECT_THROW((void)factor.columns(), std::logic_error);
    return;
  }
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

// Eliminating the rim first leaves every row of it with two entries below the diagonal.
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
  SparseCholesky factor(star, FactorKind::simplicial, false);
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
  const std::string problem = usage_error([&] { SparseCholesky(all, FactorKind::simplicial, false); });
  EXPECT_NE(problem.find("a sparse factor of 6000 rows takes 7.2e+10 operations"), std::string::npos) << problem;
}

}  // namespace
}  // namespace drape::test
