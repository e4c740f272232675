// The part of SpringNetwork that sums its blocks up for each vertex.

#include <algorithm>

#include "sim/spring_network.hpp"

namespace drape {

void SpringNetwork::add_diagonal(const Blocks& blocks, Eigen::Matrix<double, Eigen::Dynamic, 6>& diagonal) const {
  // K of the springs from `begin` on, as many as there are numbers in a column. What is negative across a spring is
  // left out, and of what is along it as much.
  const auto block = [&](std::size_t begin, Eigen::Index count, const auto& use) {
    const auto at = static_cast<Eigen::Index>(begin);
    const auto across = blocks.across.segment(at, count).array();
    const auto along = blocks.along.middleRows(at, count).array();
    const Eigen::ArrayXd share = (across < 0).select(1 + across / along.square().rowwise().sum(), 1.0);
    for (int row = 0, entry = 0; row < 3; ++row) {
      for (int column = row; column < 3; ++column, ++entry) {
        const auto both = share * along.col(row) * along.col(column);
        if (row == column) {
          use(entry, both + across.max(0.0));
        } else {
          use(entry, both);
        }
      }
    }
  };
  for (const Band& b : bands_) {
    const Eigen::Index count = std::max(0, vertex_count_ - b.offset);
    block(b.begin, count, [&](int entry, const auto& values) {
      diagonal.col(entry).head(count).array() += values;
      diagonal.col(entry).segment(b.offset, count).array() += values;
    });
  }
  for (const List& l : lists_) {
    block(l.begin, l.count, [&](int entry, const auto& values) {
      for (int spring = 0; spring < l.count; ++spring) {
        const std::size_t at = l.index + static_cast<std::size_t>(spring);
        diagonal(i_[at], entry) += values[spring];
        diagonal(j_[at], entry) += values[spring];
      }
    });
  }
}

}  // namespace drape
