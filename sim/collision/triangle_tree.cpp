#include "sim/collision/triangle_tree.hpp"

#include <limits>
#include <numeric>
#include <utility>

namespace drape {
namespace {

Box empty_box() {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  return {Eigen::Vector3d::Constant(infinity), Eigen::Vector3d::Constant(-infinity)};
}

void enclose(Box& box, const Box& other) {
  box.low = box.low.cwiseMin(other.low);
  box.high = box.high.cwiseMax(other.high);
}

}  // namespace

void TriangleTree::build(std::span<const Box> boxes, int leaf_size) {
  order_.resize(boxes.size());
  std::iota(order_.begin(), order_.end(), 0);
  nodes_.clear();
  split(boxes, 0, static_cast<int>(boxes.size()), leaf_size);
  refit(boxes);
}

void TriangleTree::split(std::span<const Box> boxes, int first, int count, int leaf_size) {
  const std::size_t node = nodes_.size();
  const bool leaf = count <= leaf_size;
  nodes_.push_back({empty_box(), 0, first, leaf ? count : 0});
  if (!leaf) {
    const auto middle_of = [&](int k) {
      const Box& box = boxes[static_cast<std::size_t>(k)];
      return Eigen::Vector3d(0.5 * (box.low + box.high));
    };
    const auto begin = order_.begin() + first, end = begin + count;
    Box middles = empty_box();
    for (auto k = begin; k != end; ++k) enclose(middles, {middle_of(*k), middle_of(*k)});
    Eigen::Index axis = 0;
    (middles.high - middles.low).maxCoeff(&axis);
    const int half = count / 2;
    std::nth_element(begin, begin + half, end,
                     [&](int k, int l) { return std::pair(middle_of(k)[axis], k) < std::pair(middle_of(l)[axis], l); });
    split(boxes, first, half, leaf_size);
    split(boxes, first + half, count - half, leaf_size);
  }
  nodes_[node].skip = nodes_.size();
}

void TriangleTree::refit(std::span<const Box> boxes) {
  for (std::size_t n = nodes_.size(); n-- > 0;) {
    Node& node = nodes_[n];
    node.box = empty_box();
    for (int k = node.first; k < node.first + node.count; ++k) {
      enclose(node.box, boxes[static_cast<std::size_t>(order_[static_cast<std::size_t>(k)])]);
    }
    if (node.count > 0 || node.skip == n + 1) continue;
    const std::size_t left = n + 1, right = nodes_[left].skip;
    enclose(node.box, nodes_[left].box);
    enclose(node.box, nodes_[right].box);
  }
}

}  // namespace drape
