#include "sim/spring_network.hpp"

#include <algorithm>
#include <tuple>

namespace drape {
namespace {

// A run pays from about two vector registers on; below, gathering by index is as fast.
constexpr std::size_t shortest_run = 16;
// A gap of this many springs is cheaper to compute through than to begin a new run.
constexpr int longest_gap = 3;

int offset(const Spring& s) { return s.j - s.i; }

}  // namespace

SpringNetwork::SpringNetwork(const std::vector<Spring>& springs) : springs_(springs) {
  std::vector<Spring> sorted = springs;
  std::stable_sort(sorted.begin(), sorted.end(), [](const Spring& a, const Spring& b) {
    return std::tuple(offset(a), a.i) < std::tuple(offset(b), b.i);
  });

  std::vector<Spring> unstructured, current;
  const auto close = [&] {
    if (current.size() >= shortest_run) {
      add_run(current);
    } else {
      unstructured.insert(unstructured.end(), current.begin(), current.end());
    }
    current.clear();
  };
  for (const Spring& spring : sorted) {
    const int gap = current.empty() ? 0 : spring.i - current.back().i - 1;
    // A duplicate (gap −1) would write its vertices twice within one run.
    if (!current.empty() && (offset(spring) != offset(current.back()) || gap < 0 || gap > longest_gap)) close();
    current.push_back(spring);
  }
  close();
  add_lists(std::move(unstructured));

  // In the order of their vertices, the blocks of different runs that touch the same vertices are computed close
  // together.
  std::stable_sort(blocks_.begin(), blocks_.end(),
                   [](const Block& a, const Block& b) { return a.first_i < b.first_i; });
}

void SpringNetwork::append(const Spring& spring) {
  i_.push_back(spring.i);
  j_.push_back(spring.j);
  stiffness_.push_back(spring.stiffness);
  rest_length_.push_back(spring.rest_length);
}

void SpringNetwork::add_run(const std::vector<Spring>& run) {
  const int first = static_cast<int>(stiffness_.size());
  for (const Spring& spring : run) {
    while (static_cast<int>(stiffness_.size()) - first < spring.i - run.front().i) {
      const int i = run.front().i + static_cast<int>(stiffness_.size()) - first;
      append({.i = i, .j = i + offset(spring), .rest_length = 0, .stiffness = 0});
    }
    append(spring);
  }
  const int count = static_cast<int>(stiffness_.size()) - first;
  for (int done = 0; done < count; done += kernel_springs) {
    blocks_.push_back({.is_run = true,
                       .first_i = run.front().i + done,
                       .first_j = run.front().j + done,
                       .begin = first + done,
                       .count = std::min(kernel_springs, count - done)});
  }
}

void SpringNetwork::add_lists(std::vector<Spring> rest) {
  std::stable_sort(rest.begin(), rest.end(),
                   [](const Spring& a, const Spring& b) { return std::tuple(a.i, a.j) < std::tuple(b.i, b.j); });
  const int first = static_cast<int>(stiffness_.size());
  for (const Spring& spring : rest) append(spring);
  const int count = static_cast<int>(rest.size());
  for (int done = 0; done < count; done += kernel_springs) {
    const auto& head = rest[static_cast<std::size_t>(done)];
    blocks_.push_back({.is_run = false,
                       .first_i = head.i,
                       .first_j = head.j,
                       .begin = first + done,
                       .count = std::min(kernel_springs, count - done)});
  }
}

SpringRun SpringNetwork::run(const Block& b) const {
  return {b.first_i, b.first_j, b.count, stiffness_.data() + b.begin, rest_length_.data() + b.begin};
}

SpringList SpringNetwork::list(const Block& b) const {
  return {i_.data() + b.begin, j_.data() + b.begin, b.count, stiffness_.data() + b.begin,
          rest_length_.data() + b.begin};
}

double SpringNetwork::energy(const Vertices& x) const {
  Vertices ignored = Vertices::Zero(x.rows(), 3);
  return add_value_gradient(x, ignored);
}

void SpringNetwork::add_gradient(const Vertices& x, Vertices& gradient) const {
  const Kernels& k = kernels();
  for (const Block& b : blocks_) {
    if (b.is_run) {
      k.add_run_gradient(run(b), columns(x), columns(gradient));
    } else {
      k.add_list_gradient(list(b), columns(x), columns(gradient));
    }
  }
}

double SpringNetwork::add_value_gradient(const Vertices& x, Vertices& gradient) const {
  const Kernels& k = kernels();
  double total = 0;
  for (const Block& b : blocks_) {
    total += b.is_run ? k.add_run_value_gradient(run(b), columns(x), columns(gradient))
                      : k.add_list_value_gradient(list(b), columns(x), columns(gradient));
  }
  return total;
}

void SpringNetwork::compute_blocks(const Vertices& x, Blocks& blocks) const {
  const Kernels& k = kernels();
  blocks.across.resize(stored());
  blocks.along.resize(stored(), 3);
  for (const Block& b : blocks_) {
    const SpringBlocks kept{blocks.across.data() + b.begin, columns(blocks.along, b.begin)};
    if (b.is_run) {
      k.run_blocks(run(b), columns(x), kept);
    } else {
      k.list_blocks(list(b), columns(x), kept);
    }
  }
}

void SpringNetwork::add_product(const Blocks& blocks, const Vertices& vector, Vertices& product) const {
  const Kernels& k = kernels();
  for (const Block& b : blocks_) {
    const ConstSpringBlocks kept{blocks.across.data() + b.begin, columns(blocks.along, b.begin)};
    if (b.is_run) {
      k.add_run_product(run(b), kept, columns(vector), columns(product));
    } else {
      k.add_list_product(list(b), kept, columns(vector), columns(product));
    }
  }
}

}  // namespace drape
