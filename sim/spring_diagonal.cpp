// Part of SpringNetwork that sums its blocks per vertex.

#include <algorithm>
#include <array>

#include "sim/parallel/loops.hpp"
#include "sim/spring_network.hpp"

namespace drape {

void SpringNetwork::add_diagonal(const Blocks& blocks, Eigen::Matrix<double, Eigen::Dynamic, 6>& diagonal) const {
  // Omit the negative part across a spring, and the same amount along it.
  const auto across = blocks.across.array();
  const auto along = blocks.along.array();
  Eigen::ArrayXd share(across.size());
  for_ranges(threads_, across.size(), [&](Eigen::Index at, Eigen::Index count) {
    share.segment(at, count) =
        (across.segment(at, count) < 0)
            .select(1 + across.segment(at, count) / along.middleRows(at, count).square().rowwise().sum(), 1.0);
  });
  threads_.for_each(6, [&](int entry) {
    constexpr std::array<int, 6> rows{0, 0, 0, 1, 1, 2}, columns{0, 1, 2, 1, 2, 2};
    const int row = rows[static_cast<std::size_t>(entry)], column = columns[static_cast<std::size_t>(entry)];
    const auto values = [&](std::size_t begin, Eigen::Index count, const auto& use) {
      const auto at = static_cast<Eigen::Index>(begin);
      const auto both =
          share.segment(at, count) * along.col(row).segment(at, count) * along.col(column).segment(at, count);
      if (row == column) {
        use(both + across.segment(at, count).max(0.0));
      } else {
        use(both);
      }
    };
    for (const Band& b : bands_) {
      const Eigen::Index count = std::max(0, vertex_count_ - b.offset);
      values(b.begin, count, [&](const auto& each) {
        diagonal.col(entry).head(count).array() += each;
        diagonal.col(entry).segment(b.offset, count).array() += each;
      });
    }
    values(stiffness_.size(), static_cast<Eigen::Index>(gathered_.size()), [&](const auto& each) {
      gathered_.for_each([&](Eigen::Index spring, int i, int j) {
        diagonal(i, entry) += each[spring];
        diagonal(j, entry) += each[spring];
      });
    });
  });
}

}  // namespace drape
