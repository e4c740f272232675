#include "sim/parallel/vectors.hpp"

#include <algorithm>
#include <functional>

namespace drape {
namespace {

using Row = Eigen::Map<Eigen::ArrayXd>;
using ConstRow = Eigen::Map<const Eigen::ArrayXd>;

constexpr std::size_t most_dots = 8;
using Dots = std::array<double, most_dots>;

/// Calls use(first, count) for blocks of numbers that fit into the first-level cache.
template <class Use>
void for_blocks(const Threads& threads, Eigen::Index count, Use&& use) {
  constexpr Eigen::Index block = 2048;
  for_ranges(
      threads, count,
      [&](Eigen::Index first, Eigen::Index all) {
        for (Eigen::Index done = 0; done < all; done += block) use(first + done, std::min(block, all - done));
      },
      numbers_worth_dividing);
}

}  // namespace

void dots(const Threads& threads, std::span<const double* const> vectors, const Vertices& with, double* results) {
  const int many = static_cast<int>(vectors.size());
  const Dots products = reduce(
      threads, with.size(),
      [&](Eigen::Index first, Eigen::Index count) {
        std::array<const double*, most_dots> from{};
        for (std::size_t k = 0; k < vectors.size(); ++k) from[k] = vectors[k] + first;
        Dots part{};
        kernels().dots(static_cast<std::size_t>(count), many, from.data(), with.data() + first, part.data());
        return part;
      },
      [](Dots total, const Dots& next) {
        for (std::size_t k = 0; k < total.size(); ++k) total[k] += next[k];
        return total;
      },
      numbers_worth_dividing);
  std::copy_n(products.begin(), many, results);
}

double dot(const Threads& threads, const Vertices& a, const Vertices& b) {
  const double* vector = a.data();
  double result = 0;
  dots(threads, std::span(&vector, 1), b, &result);
  return result;
}

double norm(const Threads& threads, const Vertices& v) { return std::sqrt(dot(threads, v, v)); }

void copy(const Threads& threads, const Vertices& from, Vertices& to) {
  to.resize(from.rows(), 3);
  for_ranges(
      threads, from.size(),
      [&](Eigen::Index first, Eigen::Index count) { std::copy_n(from.data() + first, count, to.data() + first); },
      numbers_worth_dividing);
}

bool equal(const Threads& threads, const Vertices& a, const Vertices& b) {
  if (a.rows() != b.rows()) return false;
  return reduce(
      threads, a.size(),
      [&](Eigen::Index first, Eigen::Index count) {
        return std::equal(a.data() + first, a.data() + first + count, b.data() + first);
      },
      std::logical_and<>(), numbers_worth_dividing);
}

void subtract(const Threads& threads, const Vertices& a, const Vertices& b, Vertices& to) {
  for_ranges(
      threads, a.size(),
      [&](Eigen::Index first, Eigen::Index count) {
        Row(to.data() + first, count) = ConstRow(a.data() + first, count) - ConstRow(b.data() + first, count);
      },
      numbers_worth_dividing);
}

void scale(const Threads& threads, double factor, const Vertices& from, Vertices& to) {
  for_ranges(
      threads, from.size(),
      [&](Eigen::Index first, Eigen::Index count) {
        Row(to.data() + first, count) = factor * ConstRow(from.data() + first, count);
      },
      numbers_worth_dividing);
}

void set_zero(const Threads& threads, Vertices& to) {
  for_ranges(
      threads, to.size(), [&](Eigen::Index first, Eigen::Index count) { std::fill_n(to.data() + first, count, 0.0); },
      numbers_worth_dividing);
}

void weigh(const Threads& threads, const Eigen::VectorXd& weights, const Vertices& from, Vertices& to) {
  for_ranges(threads, from.rows(), [&](Eigen::Index first, Eigen::Index count) {
    to.middleRows(first, count) =
        from.middleRows(first, count).array().colwise() * weights.segment(first, count).array();
  });
}

void add_multiple(const Threads& threads, double factor, const Vertices& from, Vertices& to) {
  for_ranges(
      threads, from.size(),
      [&](Eigen::Index first, Eigen::Index count) {
        kernels().add_multiple(static_cast<std::size_t>(count), factor, from.data() + first, to.data() + first);
      },
      numbers_worth_dividing);
}

void drift(const Threads& threads, const Drift& drift, Vertices& v, Vertices& x) {
  for_ranges(
      threads, x.size(),
      [&](Eigen::Index first, Eigen::Index count) {
        kernels().drift(static_cast<std::size_t>(count), drift, v.data() + first, x.data() + first);
      },
      numbers_worth_dividing);
}

void multiply_and_add(const Threads& threads, double factor, const Vertices& from, Vertices& to) {
  for_ranges(
      threads, from.size(),
      [&](Eigen::Index first, Eigen::Index count) {
        Row numbers(to.data() + first, count);
        numbers = ConstRow(from.data() + first, count) + factor * numbers;
      },
      numbers_worth_dividing);
}

void sum(const Threads& threads, const Vertices& from, double factor, const Vertices& other, Vertices& to) {
  for_blocks(threads, from.size(), [&](Eigen::Index first, Eigen::Index count) {
    std::copy_n(from.data() + first, count, to.data() + first);
    kernels().add_multiple(static_cast<std::size_t>(count), factor, other.data() + first, to.data() + first);
  });
}

void combine(const Threads& threads, double factor, const Vertices& from, std::span<const double* const> vectors,
             const double* factors, Vertices& to) {
  for_blocks(threads, from.size(), [&](Eigen::Index first, Eigen::Index count) {
    std::array<const double*, most_dots> parts{};
    for (std::size_t k = 0; k < vectors.size(); ++k) parts[k] = vectors[k] + first;
    std::copy_n(from.data() + first, count, to.data() + first);
    kernels().add_multiples(static_cast<std::size_t>(count), static_cast<int>(vectors.size()), parts.data(), factors,
                            to.data() + first);
    Row(to.data() + first, count) *= factor;
  });
}

void divided_difference(const Threads& threads, const Vertices& a, const Vertices& b, double divisor, Vertices& to) {
  for_ranges(
      threads, a.size(),
      [&](Eigen::Index first, Eigen::Index count) {
        Row(to.data() + first, count) =
            (ConstRow(a.data() + first, count) - ConstRow(b.data() + first, count)) / divisor;
      },
      numbers_worth_dividing);
}

}  // namespace drape
