// Solves with a packed factor: every version of the kernels gives the same, correct bits.

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <string>
#include <type_traits>
#include <vector>

#include "tests/unit/kernels_version.hpp"

namespace drape::test {
namespace {

/// A well-conditioned lower triangle of panels of every width, each with rows below.
template <class T>
struct TriangularSystem {
  std::vector<Panel> panels;
  std::vector<int> rows;
  std::vector<T> values;
  Eigen::MatrixXd dense;

  explicit TriangularSystem(int n) : dense(Eigen::MatrixXd::Zero(n, n)) {
    Random random(5);
    for (int first = 0, width = 1; first < n; first += width, width = 1 + panels.back().width % panel_width) {
      width = std::min(width, n - first);
      Panel panel{.first = first, .width = width, .row_count = 0};
      Eigen::MatrixXd inverse = Eigen::MatrixXd::Zero(width, width);
      for (int r = 0; r < width; ++r) {
        for (int c = 0; c < r; ++c) inverse(r, c) = random.between(-1, 1) / n;
        inverse(r, r) = random.between(0.5, 2);
        for (int c = 0; c <= r; ++c) values.push_back(static_cast<T>(inverse(r, c)));
      }
      dense.block(first, first, width, width) = inverse.inverse();
      for (int row = first + width; row < n; ++row) {
        if (random.number() > 0.33) continue;
        rows.push_back(row);
        ++panel.row_count;
        for (int c = first; c < first + width; ++c) {
          dense(row, c) = random.between(-1, 1) / n;
          values.push_back(static_cast<T>(dense(row, c)));
        }
      }
      panels.push_back(panel);
    }
  }
  [[nodiscard]] PackedTriangle<T> view() const {
    return {panels.data(), static_cast<int>(panels.size()), rows.data(), values.data()};
  }
};

template <class T>
std::vector<T> right_hand_side(int n) {
  const std::vector<double> plain = numbers(4 * static_cast<std::size_t>(n), 6);
  return {plain.begin(), plain.end()};
}

class FactorKernels : public KernelsVersion {};
INSTANTIATE_TEST_SUITE_P(For, FactorKernels, testing::ValuesIn(all_kernels().begin(), all_kernels().end()),
                         [](const auto& info_) { return std::string(info_.param->name); });

TEST_P(FactorKernels, PacksAndUnpacks) {
  for (const int count : counts) {
    const auto n = static_cast<std::size_t>(count);
    const std::vector<double> from = numbers(3 * n, 31), before = numbers(3 * n, 32);
    const auto columns = [n](auto& v) {
      return Columns<std::remove_pointer_t<decltype(v.data())>>{v.data(), v.data() + n, v.data() + 2 * n};
    };
    std::vector<int> row(n);  // a permutation: 7 has no common divisor with a power of two
    for (std::size_t v = 0; v < n; ++v) row[v] = static_cast<int>(7 * v % 256);
    std::vector<double> doubles(std::size_t{4} * 256, -1), there = before, difference = before;
    std::vector<float> singles(std::size_t{4} * 256, -1);
    tested.pack_double(count, columns(from), row.data(), doubles.data());
    tested.pack_single(count, columns(from), row.data(), singles.data());
    double squares = 0;
    for (std::size_t v = 0; v < n; ++v) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto at = 4 * static_cast<std::size_t>(row[v]) + axis;
        ASSERT_EQ(doubles[at], from[axis * n + v]);
        ASSERT_EQ(singles[at], static_cast<float>(from[axis * n + v]));
        squares += from[axis * n + v] * from[axis * n + v];
      }
    }
    tested.unpack_double(count, doubles.data(), row.data(), columns(there));
    ASSERT_TRUE(same(there, from)) << count;
    const double sum = tested.subtract_packed_double(count, doubles.data(), row.data(), columns(difference));
    for (std::size_t t = 0; t < 3 * n; ++t) ASSERT_EQ(difference[t], before[t] - from[t]);
    EXPECT_NEAR(sum, squares, 1e-13 * squares);
    std::vector<double> elsewhere = before;
    ASSERT_TRUE(same(sum, reference.subtract_packed_double(count, doubles.data(), row.data(), columns(elsewhere))));

    std::vector<double> rounded = before, same_rounded = before;
    tested.unpack_single(count, singles.data(), row.data(), columns(there));
    for (std::size_t t = 0; t < 3 * n; ++t) ASSERT_EQ(there[t], static_cast<double>(static_cast<float>(from[t])));
    ASSERT_TRUE(same(tested.subtract_packed_single(count, singles.data(), row.data(), columns(rounded)),
                     reference.subtract_packed_single(count, singles.data(), row.data(), columns(same_rounded))));
    ASSERT_TRUE(same(rounded, same_rounded)) << count;
  }
}

TEST_P(FactorKernels, SolvesAlike) {
  for (const int n : {0, 1, 2, 3, 4, 5, 8, 13, 30, 71}) {
    const TriangularSystem<float> singles(n);
    auto a = right_hand_side<float>(n), b = a;
    reference.solve_single(singles.view(), a.data());
    tested.solve_single(singles.view(), b.data());
    ASSERT_TRUE(same(a, b)) << n << " in single precision";

    const TriangularSystem<double> doubles(n);
    auto c = right_hand_side<double>(n), d = c;
    reference.solve_double(doubles.view(), c.data());
    tested.solve_double(doubles.view(), d.data());
    ASSERT_TRUE(same(c, d)) << n << " in double precision";
  }
}

TEST_P(FactorKernels, SolvesBothTriangles) {
  for (const int n : {1, 2, 7, 8, 9, 71}) {
    const TriangularSystem<double> triangle(n);
    const auto b = right_hand_side<double>(n);
    auto x = b;
    tested.solve_double(triangle.view(), x.data());
    using Rows = Eigen::Matrix<double, Eigen::Dynamic, 4, Eigen::RowMajor>;
    const Rows product = triangle.dense * (triangle.dense.transpose() * Eigen::Map<const Rows>(x.data(), n, 4));
    EXPECT_LT((product - Eigen::Map<const Rows>(b.data(), n, 4)).cwiseAbs().maxCoeff(), 1e-13) << n;
  }
}

}  // namespace
}  // namespace drape::test
