#include "audit/box_tree.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "audit/predicates.hpp"

namespace drape::audit {

Vertices exact_positions(const Vertices& x) {
  Vertices exact(x.rows(), 3);
  for (Eigen::Index v = 0; v < x.rows(); ++v) {
    try {
      for (int axis = 0; axis < 3; ++axis) exact(v, axis) = on_exact_grid(x(v, axis));
    } catch (const std::invalid_argument& error) {
      throw std::invalid_argument(fmt::format("vertex {}: {}", v, error.what()));
    }
  }
  return exact;
}

void check_vertices(const std::vector<Triangle>& triangles, const Vertices& x) {
  for (const Triangle& triangle : triangles) {
    const int largest = *std::ranges::max_element(triangle);
    if (largest >= x.rows()) {
      throw std::invalid_argument(fmt::format("a triangle has vertex {}, but there are {}", largest, x.rows()));
    }
  }
}

namespace {

constexpr int leaf_size = 4;

}  // namespace

BoxTree::BoxTree(std::vector<Box> boxes) : boxes_(std::move(boxes)), order_(boxes_.size()) {
  std::iota(order_.begin(), order_.end(), 0);
  nodes_.reserve(boxes_.size());
  if (!boxes_.empty()) build(0, static_cast<int>(boxes_.size()));
}

void BoxTree::build(int begin, int end) {
  const auto at = [&](int i) { return order_.begin() + i; };
  Box bounds = box(*at(begin));
  for (int i = begin + 1; i < end; ++i) bounds.include(box(*at(i)));
  const std::size_t node = nodes_.size();
  nodes_.push_back({bounds, begin, end, -1});
  if (end - begin <= leaf_size) return;
  int axis = 0;
  (bounds.high - bounds.low).maxCoeff(&axis);
  const auto twice_middle = [&](int i) { return box(i).low[axis] + box(i).high[axis]; };
  const int middle = begin + (end - begin) / 2;
  std::nth_element(at(begin), at(middle), at(end), [&](int a, int b) { return twice_middle(a) < twice_middle(b); });
  build(begin, middle);
  nodes_[node].second = static_cast<int>(nodes_.size());
  build(middle, end);
}

}  // namespace drape::audit
