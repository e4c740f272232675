#include "sim/gathered_springs.hpp"

#include <algorithm>
#include <tuple>

#include "sim/parallel/loops.hpp"

namespace drape {

GatheredSprings::GatheredSprings(std::vector<Spring> springs, int vertex_count, const Threads& threads)
    : threads_(static_cast<Eigen::Index>(springs.size()) < worth_dividing ? one_thread() : threads) {
  std::stable_sort(springs.begin(), springs.end(),
                   [](const Spring& a, const Spring& b) { return std::tuple(a.i, a.j) < std::tuple(b.i, b.j); });
  for (const Spring& spring : springs) {
    i_.push_back(spring.i);
    j_.push_back(spring.j);
    stiffness_.push_back(spring.stiffness);
    rest_length_.push_back(spring.rest_length);
  }
  values_.resize(static_cast<std::size_t>(lists()));
  if (threads_.count() == 1) return;
  first_.resize(static_cast<std::size_t>(vertex_count) + 1);
  for (int vertex = 0; vertex <= vertex_count; ++vertex) {
    first_[static_cast<std::size_t>(vertex)] =
        static_cast<int>(std::lower_bound(i_.begin(), i_.end(), vertex) - i_.begin());
  }
  last_ = Incidence(j_, 1, vertex_count);
  force_.resize(static_cast<Eigen::Index>(size()), 3);
}

int GatheredSprings::lists() const { return (static_cast<int>(size()) + kernel_size - 1) / kernel_size; }

SpringList GatheredSprings::list(int first) const {
  return {.i = i_.data() + first,
          .j = j_.data() + first,
          .count = std::min(kernel_size, static_cast<int>(size()) - first),
          .stiffness = stiffness_.data() + first,
          .rest_length = rest_length_.data() + first};
}

template <class Use>
void GatheredSprings::for_lists(Use&& use) const {
  for_ranges(
      threads_, lists(),
      [&](Eigen::Index begin, Eigen::Index count) {
        for (auto number = static_cast<int>(begin); number < static_cast<int>(begin + count); ++number) {
          use(list(number * kernel_size), number * kernel_size, static_cast<std::size_t>(number));
        }
      },
      0);
}

template <class Add>
void GatheredSprings::add_forces(Vertices& to, Add&& add) const {
  const bool divided = threads_.count() > 1;
  for_lists([&](SpringList list, int first, std::size_t number) {
    if (divided) list.force = columns(force_, first);
    add(list, first, number);
  });
  if (!divided) return;
  for_ranges(threads_, to.rows(), [&](Eigen::Index begin, Eigen::Index count) {
    for (Eigen::Index vertex = begin; vertex < begin + count; ++vertex) {
      double x = to(vertex, 0), y = to(vertex, 1), z = to(vertex, 2);
      // Springs with the vertex as j come first, as their i is smaller.
      for (const int spring : last_.of(vertex)) {
        x -= force_(spring, 0);
        y -= force_(spring, 1);
        z -= force_(spring, 2);
      }
      const auto v = static_cast<std::size_t>(vertex);
      for (int spring = first_[v]; spring < first_[v + 1]; ++spring) {
        x += force_(spring, 0);
        y += force_(spring, 1);
        z += force_(spring, 2);
      }
      to.row(vertex) << x, y, z;
    }
  });
}

void GatheredSprings::add_gradient(const Vertices& x, Vertices& gradient) const {
  add_forces(gradient, [&](const SpringList& list, int, std::size_t) {
    kernels().add_list_gradient(list, columns(x), columns(gradient));
  });
}

double GatheredSprings::add_value_gradient(const Vertices& x, Vertices& gradient) const {
  add_forces(gradient, [&](const SpringList& list, int, std::size_t number) {
    values_[number] = kernels().add_list_value_gradient(list, columns(x), columns(gradient));
  });
  double total = 0;
  for (const double value : values_) total += value;
  return total;
}

void GatheredSprings::compute_blocks(const Vertices& x, double concavity, SpringBlocks blocks) const {
  for_lists([&](const SpringList& list, int first, std::size_t) {
    kernels().list_blocks(
        list, concavity, columns(x),
        {blocks.across + first, {blocks.along.x + first, blocks.along.y + first, blocks.along.z + first}});
  });
}

void GatheredSprings::add_product(ConstSpringBlocks blocks, const Vertices& vector, Vertices& product) const {
  add_forces(product, [&](const SpringList& list, int first, std::size_t) {
    kernels().add_list_product(
        list, {blocks.across + first, {blocks.along.x + first, blocks.along.y + first, blocks.along.z + first}},
        columns(vector), columns(product));
  });
}

}  // namespace drape
