// Every version of the kernels gives the same bits, so that a result does not depend on the processor.

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include "sim/kernels/kernels.hpp"
#include "tests/support/random.hpp"

namespace drape {
// So that a failing test prints the version's name.
static void PrintTo(const Kernels* version, std::ostream* out) { *out << version->name; }
}  // namespace drape

namespace drape::test {
namespace {

constexpr int counts[] = {0, 1, 2, 3, 4, 5, 7, 8, 9, 11, 15, 16, 17, 23, 31, 64, 100, 255, 256};

std::vector<double> numbers(std::size_t count, int seed) {
  Random random(static_cast<std::uint64_t>(seed));
  std::vector<double> result(count);
  for (double& number : result) number = random.between(-1, 1);
  return result;
}

template <class T>
bool same(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}
bool same(double a, double b) { return std::memcmp(&a, &b, sizeof a) == 0; }

/// Springs between 600 vertices, some of which are in the same place.
struct Springs {
  static constexpr std::size_t vertices = 600;
  std::vector<double> positions = numbers(3 * vertices, 1);
  std::vector<double> stiffness = numbers(kernel_springs, 2);
  std::vector<double> rest_length = numbers(kernel_springs, 3);
  std::vector<int> i, j;

  Springs() {
    Random random(4);
    for (double& k : stiffness) k = 200 * std::abs(k);
    for (double& length : rest_length) length = std::abs(length);
    for (int t = 0; t < kernel_springs; ++t) {
      i.push_back(random.below(40));  // few, so that many springs share a vertex
      j.push_back(40 + random.below(500));
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (std::size_t v = 0; v < 10; ++v) positions[axis * vertices + 40 + v] = positions[axis * vertices + v];
    }
  }
  [[nodiscard]] Columns<const double> columns() const {
    return {positions.data(), positions.data() + vertices, positions.data() + 2 * vertices};
  }
  static Columns<double> columns(std::vector<double>& gradient) {
    return {gradient.data(), gradient.data() + vertices, gradient.data() + 2 * vertices};
  }
  [[nodiscard]] SpringRun run(int first, int offset, int count) const {
    return {first, first + offset, count, stiffness.data(), rest_length.data()};
  }
  [[nodiscard]] SpringList list(int count) const {
    return {i.data(), j.data(), count, stiffness.data(), rest_length.data()};
  }
};

/// A lower triangle with a third of its entries, well conditioned.
template <class T>
struct Triangle {
  std::vector<int> starts{0}, rows;
  std::vector<T> values, inverse_diagonal;

  explicit Triangle(int n) {
    Random random(5);
    for (int c = 0; c < n; ++c) {
      for (int r = c + 1; r < n; ++r) {
        if (random.number() > 0.33) continue;
        rows.push_back(r);
        values.push_back(static_cast<T>(random.between(-1, 1) / n));
      }
      starts.push_back(static_cast<int>(rows.size()));
      inverse_diagonal.push_back(static_cast<T>(random.between(0.5, 2)));
    }
  }
  [[nodiscard]] PackedTriangle<T> view() const {
    return {static_cast<int>(inverse_diagonal.size()), starts.data(), rows.data(), values.data(),
            inverse_diagonal.data()};
  }
};

template <class T>
std::vector<T> right_hand_side(int n) {
  const std::vector<double> plain = numbers(4 * static_cast<std::size_t>(n), 6);
  return {plain.begin(), plain.end()};
}

class KernelsVersion : public testing::TestWithParam<const Kernels*> {
 protected:
  void SetUp() override {
    if (GetParam()->supported() == 0) GTEST_SKIP() << "this processor has no " << GetParam()->name;
  }
  const Kernels& reference = *all_kernels().front();
  const Kernels& tested = *GetParam();
};
INSTANTIATE_TEST_SUITE_P(For, KernelsVersion, testing::ValuesIn(all_kernels().begin(), all_kernels().end()),
                         [](const auto& info_) { return std::string(info_.param->name); });

TEST_P(KernelsVersion, AddsTheSameRunGradient) {
  const Springs springs;
  for (const int count : counts) {
    for (const int first : {0, 1, 3, 6}) {
      for (const int offset : {1, 2, 3, 21, 40, 64}) {
        std::vector<double> a = numbers(springs.positions.size(), 7), b = a;
        reference.add_run_gradient(springs.run(first, offset, count), springs.columns(), Springs::columns(a));
        tested.add_run_gradient(springs.run(first, offset, count), springs.columns(), Springs::columns(b));
        ASSERT_TRUE(same(a, b)) << count << " springs from " << first << ", " << offset << " apart";
      }
    }
  }
}

TEST_P(KernelsVersion, AddsTheSameListGradient) {
  const Springs springs;
  for (const int count : counts) {
    std::vector<double> a = numbers(springs.positions.size(), 7), b = a;
    reference.add_list_gradient(springs.list(count), springs.columns(), Springs::columns(a));
    tested.add_list_gradient(springs.list(count), springs.columns(), Springs::columns(b));
    ASSERT_TRUE(same(a, b)) << count << " springs";
  }
}

TEST_P(KernelsVersion, SumsTheSameEnergies) {
  const Springs springs;
  for (const int count : counts) {
    for (const int first : {0, 1, 3, 6}) {
      ASSERT_TRUE(same(reference.run_energy(springs.run(first, 21, count), springs.columns()),
                       tested.run_energy(springs.run(first, 21, count), springs.columns())))
          << count << " springs from " << first;
    }
    ASSERT_TRUE(same(reference.list_energy(springs.list(count), springs.columns()),
                     tested.list_energy(springs.list(count), springs.columns())))
        << count << " springs";
  }
}

TEST_P(KernelsVersion, MultipliesAndAddsAlike) {
  const std::vector<double> a = numbers(300, 8), b = numbers(300, 9), c = numbers(300, 10);
  for (const int count : counts) {
    for (const std::size_t from : {0U, 1U, 3U}) {
      const auto n = static_cast<std::size_t>(count);
      std::vector<double> ours = c, theirs = c, plain = c;
      reference.accelerate(n, a.data() + from, b.data() + from, theirs.data() + from);
      tested.accelerate(n, a.data() + from, b.data() + from, ours.data() + from);
      for (std::size_t t = from; t < from + n; ++t) plain[t] += a[t] * b[t];
      ASSERT_TRUE(same(ours, theirs) && same(ours, plain)) << "accelerate " << count << " from " << from;

      reference.drift(n, 0.013, a.data() + from, theirs.data() + from);
      tested.drift(n, 0.013, a.data() + from, ours.data() + from);
      for (std::size_t t = from; t < from + n; ++t) plain[t] += 0.013 * a[t];
      ASSERT_TRUE(same(ours, theirs) && same(ours, plain)) << "drift " << count << " from " << from;

      reference.scaled_difference(n, a.data() + from, b.data() + from, c.data() + from, theirs.data() + from);
      tested.scaled_difference(n, a.data() + from, b.data() + from, c.data() + from, ours.data() + from);
      for (std::size_t t = from; t < from + n; ++t) plain[t] = a[t] * (b[t] - c[t]);
      ASSERT_TRUE(same(ours, theirs) && same(ours, plain)) << "scaled_difference " << count << " from " << from;
    }
  }
}

TEST_P(KernelsVersion, SolvesAlike) {
  for (const int n : {0, 1, 2, 3, 4, 5, 8, 13, 30, 71}) {
    const Triangle<float> singles(n);
    auto a = right_hand_side<float>(n), b = a;
    reference.solve_single(singles.view(), a.data());
    tested.solve_single(singles.view(), b.data());
    ASSERT_TRUE(same(a, b)) << n << " in single precision";

    const Triangle<double> doubles(n);
    auto c = right_hand_side<double>(n), d = c;
    reference.solve_double(doubles.view(), c.data());
    tested.solve_double(doubles.view(), d.data());
    ASSERT_TRUE(same(c, d)) << n << " in double precision";
  }
}

TEST_P(KernelsVersion, SolvesBothTriangles) {
  constexpr int n = 71;
  const Triangle<double> triangle(n);
  const auto b = right_hand_side<double>(n);
  auto x = b;
  tested.solve_double(triangle.view(), x.data());
  // L Lᵀ x must give b again.
  std::vector<double> upper(x.size(), 0), product(x.size(), 0);
  const auto at = [](int row, int axis) { return static_cast<std::size_t>(4 * row + axis); };
  for (int axis = 0; axis < 4; ++axis) {
    for (int c = 0; c < n; ++c) {
      const auto column = static_cast<std::size_t>(c);
      upper[at(c, axis)] = x[at(c, axis)] / triangle.inverse_diagonal[column];
      for (int p = triangle.starts[column]; p < triangle.starts[column + 1]; ++p) {
        const auto place = static_cast<std::size_t>(p);
        upper[at(c, axis)] += triangle.values[place] * x[at(triangle.rows[place], axis)];
      }
    }
    for (int c = 0; c < n; ++c) {
      const auto column = static_cast<std::size_t>(c);
      product[at(c, axis)] += upper[at(c, axis)] / triangle.inverse_diagonal[column];
      for (int p = triangle.starts[column]; p < triangle.starts[column + 1]; ++p) {
        const auto place = static_cast<std::size_t>(p);
        product[at(triangle.rows[place], axis)] += triangle.values[place] * upper[at(c, axis)];
      }
    }
  }
  for (std::size_t t = 0; t < b.size(); ++t) EXPECT_NEAR(product[t], b[t], 1e-13);
}

TEST(Kernels, BeginWithTheBaselineThatRunsEverywhere) {
  ASSERT_FALSE(all_kernels().empty());
  EXPECT_NE(all_kernels().front()->supported(), 0);
  EXPECT_NE(kernels().supported(), 0);
}

}  // namespace
}  // namespace drape::test
