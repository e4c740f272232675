// Every version of the kernels gives the same bits, so that results do not depend on the processor.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "tests/unit/kernels_version.hpp"

namespace drape::test {
namespace {

/// Springs between 600 vertices, some of which coincide.
struct Springs {
  static constexpr std::size_t vertices = 600;
  std::vector<double> positions = numbers(3 * vertices, 1);
  std::vector<double> stiffness = numbers(kernel_size, 2);
  std::vector<double> rest_length = numbers(kernel_size, 3);
  std::vector<int> i, j;

  Springs() {
    Random random(4);
    for (double& k : stiffness) k = 200 * std::abs(k);
    for (double& length : rest_length) length = std::abs(length);
    for (int t = 0; t < kernel_size; ++t) {
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
  [[nodiscard]] SpringList list(int count) const {
    return {i.data(), j.data(), count, stiffness.data(), rest_length.data()};
  }
};

/// Bands of springs on a stretch of vertices, with leftovers of the previous stretches.
struct Bands {
  static constexpr std::size_t lead = 64, size = lead + kernel_size;
  Springs springs;
  std::vector<double> stiffness = numbers(std::size_t{max_bands} * kernel_size, 13),
                      rest_length = numbers(std::size_t{max_bands} * kernel_size, 14);
  std::vector<double> forces = numbers(size * max_bands * 3, 15);
  std::vector<SpringBand> bands;

  explicit Bands(std::initializer_list<int> offsets) {
    for (const int offset : offsets) {
      const std::size_t b = bands.size();
      double* force = forces.data() + 3 * b * size + lead;
      bands.push_back({.offset = offset,
                       .stiffness = stiffness.data() + b * kernel_size,
                       .rest_length = rest_length.data() + b * kernel_size,
                       .force = {force, force + size, force + 2 * size}});
    }
  }
  Bands(const Bands&) = delete;
  Bands& operator=(const Bands&) = delete;
  [[nodiscard]] SpringStretch stretch(int count, int after) const {
    return {
        .count = count, .vertices_after = after, .bands = bands.data(), .band_count = static_cast<int>(bands.size())};
  }
};

INSTANTIATE_TEST_SUITE_P(For, KernelsVersion, testing::ValuesIn(all_kernels().begin(), all_kernels().end()),
                         [](const auto& info_) { return std::string(info_.param->name); });

TEST_P(KernelsVersion, AddsTheSameListGradient) {
  const Springs springs;
  for (const int count : counts) {
    std::vector<double> a = numbers(springs.positions.size(), 7), b = a;
    reference.add_list_gradient(springs.list(count), springs.columns(), Springs::columns(a));
    tested.add_list_gradient(springs.list(count), springs.columns(), Springs::columns(b));
    ASSERT_TRUE(same(a, b)) << count << " springs";
  }
}

TEST_P(KernelsVersion, FindsTheSameEnergiesWithTheGradient) {
  const Springs springs;
  for (const int count : counts) {
    std::vector<double> a = numbers(springs.positions.size(), 7), b = a;
    ASSERT_TRUE(same(reference.add_list_value_gradient(springs.list(count), springs.columns(), Springs::columns(a)),
                     tested.add_list_value_gradient(springs.list(count), springs.columns(), Springs::columns(b))))
        << count << " springs";
    ASSERT_TRUE(same(a, b)) << count << " springs";
  }
}

TEST_P(KernelsVersion, FindsTheSameBlocksAndProducts) {
  const Springs springs;
  constexpr std::size_t n = kernel_size;
  const auto blocks_in = [](std::vector<double>& v) -> SpringBlocks {
    return {v.data(), {v.data() + n, v.data() + 2 * n, v.data() + 3 * n}};
  };
  const auto blocks_of = [](const std::vector<double>& v) -> ConstSpringBlocks {
    return {v.data(), {v.data() + n, v.data() + 2 * n, v.data() + 3 * n}};
  };
  const std::vector<double> vector = numbers(springs.positions.size(), 11);
  const Columns<const double> factors{vector.data(), vector.data() + Springs::vertices,
                                      vector.data() + 2 * Springs::vertices};
  for (const int count : counts) {
    std::vector<double> a(4 * n, 0), b = a;
    std::vector<double> c = numbers(springs.positions.size(), 7), d = c;
    for (const double concavity : {1.0, 0.3, 0.0}) {
      reference.list_blocks(springs.list(count), concavity, springs.columns(), blocks_in(a));
      tested.list_blocks(springs.list(count), concavity, springs.columns(), blocks_in(b));
      ASSERT_TRUE(same(a, b)) << count << " springs in a list";
    }
    reference.add_list_product(springs.list(count), blocks_of(a), factors, Springs::columns(c));
    tested.add_list_product(springs.list(count), blocks_of(a), factors, Springs::columns(d));
    ASSERT_TRUE(same(c, d)) << count << " springs in a list";
  }
}

TEST_P(KernelsVersion, SweepsBandsAlike) {
  using Offsets = std::initializer_list<int>;
  for (const Offsets offsets : {Offsets{}, Offsets{1}, Offsets{2, 3, 21}, Offsets{1, 20, 21, 40, 64}}) {
    for (const int count : counts) {
      for (const int after : {0, 1, 20, 64}) {
        Bands a(offsets), b(offsets);
        const auto what = testing::Message() << count << " vertices, " << offsets.size() << " bands, " << after;
        std::vector<double> to_a = numbers(a.springs.positions.size(), 7), to_b = to_a;
        ASSERT_TRUE(same(
            reference.add_band_value_gradient(a.stretch(count, after), a.springs.columns(), Springs::columns(to_a)),
            tested.add_band_value_gradient(b.stretch(count, after), b.springs.columns(), Springs::columns(to_b))))
            << what;
        ASSERT_TRUE(same(to_a, to_b) && same(a.forces, b.forces)) << what;

        const std::vector<double> factor = numbers(kernel_size, 8), y = numbers(a.springs.positions.size(), 9);
        const Columns<const double> y_columns{y.data(), y.data() + Springs::vertices, y.data() + 2 * Springs::vertices};
        ASSERT_TRUE(same(reference.evaluate_bands(a.stretch(count, after), a.springs.columns(),
                                                  {factor.data(), y_columns, Springs::columns(to_a)}),
                         tested.evaluate_bands(b.stretch(count, after), b.springs.columns(),
                                               {factor.data(), y_columns, Springs::columns(to_b)})))
            << what;
        ASSERT_TRUE(same(to_a, to_b)) << what;

        const Drift drift{.h = 0.013, .before = 0.9, .after = 0.8};
        ASSERT_TRUE(same(
            reference.kick_bands(a.stretch(count, after), {factor.data(), y_columns, drift, Springs::columns(to_a),
                                                           a.springs.columns(), Springs::columns(a.springs.positions)}),
            tested.kick_bands(b.stretch(count, after), {factor.data(), y_columns, drift, Springs::columns(to_b),
                                                        b.springs.columns(), Springs::columns(b.springs.positions)})))
            << what;
        ASSERT_TRUE(same(to_a, to_b) && same(a.springs.positions, b.springs.positions)) << what;
      }
    }
  }
}

TEST_P(KernelsVersion, MultipliesBandsAlike) {
  constexpr std::size_t n = kernel_size;
  for (const int count : counts) {
    Bands a({1, 21}), b({1, 21});
    std::vector<double> blocks_a(8 * n, 0), blocks_b = blocks_a;
    std::vector<ConstSpringBlocks> of_a, of_b;
    for (std::size_t band = 0; band < 2; ++band) {
      double* first = blocks_a.data() + 4 * n * band;
      double* second = blocks_b.data() + 4 * n * band;
      reference.band_blocks(a.bands[band], count, 0.3, a.springs.columns(),
                            {first, {first + n, first + 2 * n, first + 3 * n}});
      tested.band_blocks(b.bands[band], count, 0.3, b.springs.columns(),
                         {second, {second + n, second + 2 * n, second + 3 * n}});
      of_a.push_back({first, {first + n, first + 2 * n, first + 3 * n}});
      of_b.push_back({second, {second + n, second + 2 * n, second + 3 * n}});
    }
    ASSERT_TRUE(same(blocks_a, blocks_b)) << count;
    std::vector<double> c = numbers(a.springs.positions.size(), 7), d = c;
    reference.add_band_product(a.stretch(count, 21), of_a.data(), a.springs.columns(), Springs::columns(c));
    tested.add_band_product(b.stretch(count, 21), of_b.data(), b.springs.columns(), Springs::columns(d));
    ASSERT_TRUE(same(c, d)) << count;
  }
}

TEST_P(KernelsVersion, MultipliesAndAddsAlike) {
  const std::vector<double> a = numbers(300, 8), b = numbers(300, 9), c = numbers(300, 10);
  for (const int count : counts) {
    for (const std::size_t from : {0U, 1U, 3U}) {
      const auto n = static_cast<std::size_t>(count);
      std::vector<double> ours = c, plain = c;
      tested.add_scaled(n, a.data() + from, b.data() + from, ours.data() + from);
      for (std::size_t t = from; t < from + n; ++t) plain[t] += a[t] * b[t];
      ASSERT_TRUE(same(ours, plain)) << "add_scaled " << count << " from " << from;

      tested.add_multiple(n, 0.013, a.data() + from, ours.data() + from);
      for (std::size_t t = from; t < from + n; ++t) plain[t] += 0.013 * a[t];
      ASSERT_TRUE(same(ours, plain)) << "add_multiple " << count << " from " << from;

      std::vector<double> velocity = b, plain_velocity = b;
      tested.drift(n, {.h = 0.013, .before = 0.9, .after = 0.8}, velocity.data() + from, ours.data() + from);
      for (std::size_t t = from; t < from + n; ++t) {
        plain_velocity[t] *= 0.9;
        plain[t] += 0.013 * plain_velocity[t];
        plain_velocity[t] *= 0.8;
      }
      ASSERT_TRUE(same(ours, plain) && same(velocity, plain_velocity)) << "drift " << count << " from " << from;
    }
  }
}

TEST_P(KernelsVersion, SumsAlike) {
  const std::vector<double> a = numbers(300, 8), b = numbers(300, 9), c = numbers(300, 10);
  for (const int count : counts) {
    const auto n = static_cast<std::size_t>(count);
    for (int many = 0; many <= 9; ++many) {
      std::vector<std::vector<double>> vectors;
      std::vector<const double*> pointers;
      for (int k = 0; k < many; ++k) vectors.push_back(numbers(300, 20 + k));
      for (const auto& vector : vectors) pointers.push_back(vector.data());
      std::vector<double> dots(10, 0), same_dots = dots;
      tested.dots(n, many, pointers.data(), a.data(), dots.data());
      reference.dots(n, many, pointers.data(), a.data(), same_dots.data());
      ASSERT_TRUE(same(dots, same_dots)) << count << " numbers, " << many << " vectors";
      std::vector<double> multiples = c, same_multiples = c, plain = c;
      tested.add_multiples(n, many, pointers.data(), b.data(), multiples.data());
      reference.add_multiples(n, many, pointers.data(), b.data(), same_multiples.data());
      ASSERT_TRUE(same(multiples, same_multiples)) << count << " numbers, " << many << " vectors";
      for (std::size_t k = 0; k < vectors.size(); ++k) {
        double dot = 0;
        for (std::size_t t = 0; t < n; ++t) {
          dot += vectors[k][t] * a[t];
          plain[t] += b[k] * vectors[k][t];
        }
        EXPECT_NEAR(dots[k], dot, 1e-13);
      }
      for (std::size_t t = 0; t < plain.size(); ++t) EXPECT_NEAR(multiples[t], plain[t], 1e-14);
    }
  }
}

TEST(Kernels, BeginWithTheBaselineThatRunsEverywhere) {
  ASSERT_FALSE(all_kernels().empty());
  EXPECT_NE(all_kernels().front()->supported(), 0);
  EXPECT_NE(kernels().supported(), 0);
}

}  // namespace
}  // namespace drape::test
