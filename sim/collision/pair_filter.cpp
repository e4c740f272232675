#include "sim/collision/pair_filter.hpp"

#include <limits>

#include "sim/kernels/kernels.hpp"

namespace drape {
namespace {

constexpr double rounding = 64 * 0x1p-24;    // of a slab's width, in sizes
constexpr double square_rounding = 0x1p-20;  // of squares, relative
constexpr double least_reach = 1e-15;        // its square is a normal number in single precision [m]

}  // namespace

void PairFilter::set(const std::vector<Point>& from, const std::vector<Point>& to) {
  rows_.resize(from.size());
  size_ = 0;
  if (from.empty()) return;
  std::size_t first = 0;
  for (const std::vector<Point>* points : {&from, &to}) {
    Point low = points->front(), high = low, sum = Point::Zero();
    for (const Point& p : *points) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
      sum += p;
    }
    const Point middle = (low + high) / 2;
    // Nothing is rejected if a number is not finite.
    size_ = sum.allFinite() ? std::max(size_, (high - low).maxCoeff() / 2) : std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < points->size(); ++i) {
      const Eigen::Vector3f p = ((*points)[i] - middle).cast<float>();
      rows_[i][first] = p.x();
      rows_[i][first + 1] = p.y();
      rows_[i][first + 2] = p.z();
      rows_[i][first + 3] = 0;
    }
    first += 4;
  }
}

int PairFilter::find(Feature feature, std::span<const FeaturePair> pairs, double reach,
                     std::array<int, at_once>& near) const {
  static_assert(sizeof(FeaturePair) % sizeof(int) == 0);
  const double enlarged = std::max((reach + rounding * size_) * (1 + square_rounding), least_reach);
  const PairPaths paths{.rows = rows_.front().data(),
                        .vertices = pairs.front().vertices.data(),
                        .stride = sizeof(FeaturePair) / sizeof(int),
                        .count = static_cast<int>(pairs.size()),
                        .reach = static_cast<float>(enlarged)};
  return feature == Feature::edge_edge ? kernels().near_edges(paths, near.data())
                                       : kernels().near_vertices(paths, near.data());
}

}  // namespace drape
