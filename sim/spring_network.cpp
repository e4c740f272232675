#include "sim/spring_network.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <tuple>
#include <utility>

namespace drape {
namespace {

// An entry of a band takes about a quarter of the time of a spring that is gathered by index.
constexpr int worth_a_band = 4;
// What each version of the kernels handles at once; stretches are multiples of it, so that all versions divide alike.
constexpr int widest_vector = 8;

int offset(const Spring& s) { return s.j - s.i; }

std::size_t padded(int count) {
  constexpr std::size_t vector = widest_vector;
  return (static_cast<std::size_t>(count) + vector - 1) / vector * vector;
}

}  // namespace

SpringNetwork::SpringNetwork(const std::vector<Spring>& springs, int vertex_count)
    : springs_(springs), vertex_count_(vertex_count) {
  find_bands();
  add_entries();
  cut_stretches();
}

void SpringNetwork::find_bands() {
  std::map<int, int> springs_of_offset;
  for (const Spring& spring : springs_) ++springs_of_offset[offset(spring)];
  std::vector<std::pair<int, int>> common;  // springs, offset
  for (const auto& [distance, count] : springs_of_offset) {
    if (count * worth_a_band >= vertex_count_) common.emplace_back(-count, distance);
  }
  std::sort(common.begin(), common.end());
  common.resize(std::min<std::size_t>(common.size(), max_bands));

  std::size_t scratch = 0;
  std::sort(common.begin(), common.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  for (const auto& [ignored, distance] : common) {
    // The forces slide through the scratch: those that are still needed move to its front when its end is reached.
    const std::size_t lead = padded(distance);
    const std::size_t capacity = 2 * lead + 4 * std::size_t{kernel_size};
    bands_.push_back({.offset = distance,
                      .begin = bands_.size() * padded(vertex_count_),
                      .scratch = scratch,
                      .lead = lead,
                      .capacity = capacity});
    scratch += 3 * capacity;
  }
  force_.assign(scratch, 0.0);
}

void SpringNetwork::add_entries() {
  stiffness_.assign(bands_.size() * padded(vertex_count_), 0.0);
  rest_length_ = stiffness_;
  std::vector<Spring> rest;
  for (const Spring& spring : springs_) {
    const auto band =
        std::find_if(bands_.begin(), bands_.end(), [&](const Band& b) { return b.offset == offset(spring); });
    const std::size_t entry = band == bands_.end() ? 0 : band->begin + static_cast<std::size_t>(spring.i);
    if (band == bands_.end() || stiffness_[entry] != 0) {
      rest.push_back(spring);
      continue;
    }
    stiffness_[entry] = spring.stiffness;
    rest_length_[entry] = spring.rest_length;
  }
  std::stable_sort(rest.begin(), rest.end(),
                   [](const Spring& a, const Spring& b) { return std::tuple(a.i, a.j) < std::tuple(b.i, b.j); });
  for (std::size_t done = 0; done < rest.size(); done += kernel_size) {
    lists_.push_back({.begin = stiffness_.size() + done,
                      .index = done,
                      .count = static_cast<int>(std::min<std::size_t>(kernel_size, rest.size() - done))});
  }
  for (const Spring& spring : rest) {
    i_.push_back(spring.i);
    j_.push_back(spring.j);
    stiffness_.push_back(spring.stiffness);
    rest_length_.push_back(spring.rest_length);
  }
  if (!rest.empty()) other_force_.resize(vertex_count_, 3);
}

void SpringNetwork::cut_stretches() {
  for (int first = 0; first < vertex_count_; first += kernel_size) {
    stretches_.push_back({first, std::min(kernel_size, vertex_count_ - first)});
  }
}

SpringList SpringNetwork::list(const List& l) const {
  return {i_.data() + l.index, j_.data() + l.index, l.count, stiffness_.data() + l.begin,
          rest_length_.data() + l.begin};
}

SpringBand SpringNetwork::band(const Band& b, int first, std::size_t place) const {
  const std::size_t entry = b.begin + static_cast<std::size_t>(first);
  double* force = force_.data() + b.scratch + place;
  return {.offset = b.offset,
          .stiffness = stiffness_.data() + entry,
          .rest_length = rest_length_.data() + entry,
          .force = {force, force + b.capacity, force + 2 * b.capacity}};
}

template <class Use>
void SpringNetwork::for_stretches(Use&& use) const {
  std::array<std::size_t, max_bands> places{};
  const auto column = [&](const Band& b, int axis) {
    return force_.begin() + static_cast<std::ptrdiff_t>(b.scratch + static_cast<std::size_t>(axis) * b.capacity);
  };
  for (std::size_t b = 0; b < bands_.size(); ++b) {
    const auto lead = static_cast<std::ptrdiff_t>(places[b] = bands_[b].lead);
    for (int axis = 0; axis < 3; ++axis) std::fill_n(column(bands_[b], axis), lead, 0.0);
  }
  std::array<SpringBand, max_bands> given{};
  for (const Range& range : stretches_) {
    const auto count = static_cast<std::size_t>(range.count);
    for (std::size_t b = 0; b < bands_.size(); ++b) {
      const Band& own = bands_[b];
      if (places[b] + count > own.capacity) {
        for (int axis = 0; axis < 3; ++axis) {
          const auto end = column(own, axis) + static_cast<std::ptrdiff_t>(places[b]);
          std::copy(end - static_cast<std::ptrdiff_t>(own.lead), end, column(own, axis));
        }
        places[b] = own.lead;
      }
      given[b] = band(own, range.first, places[b]);
      places[b] += count;
    }
    use(range.first, SpringStretch{.count = range.count,
                                   .vertices_after = vertex_count_ - range.first - range.count,
                                   .bands = given.data(),
                                   .band_count = static_cast<int>(bands_.size())});
  }
}

double SpringNetwork::add_lists(const Vertices& x, Vertices& gradient) const {
  double total = 0;
  for (const List& l : lists_) total += kernels().add_list_value_gradient(list(l), columns(x), columns(gradient));
  return total;
}

double SpringNetwork::add_value_gradient(const Vertices& x, Vertices& gradient) const {
  double total = 0;
  for_stretches([&](int first, const SpringStretch& stretch) {
    total += kernels().add_band_value_gradient(stretch, columns(x, first), columns(gradient, first));
  });
  return total + add_lists(x, gradient);
}

double SpringNetwork::evaluate(const Eigen::VectorXd& inertia, const Vertices& y, const Vertices& x,
                               Vertices& gradient) const {
  double total = 0;
  for_stretches([&](int first, const SpringStretch& stretch) {
    total += kernels().evaluate_bands(
        stretch, columns(x, first),
        {.factor = inertia.data() + first, .y = columns(y, first), .gradient = columns(gradient, first)});
  });
  return total + add_lists(x, gradient);
}

void SpringNetwork::kick_and_drift(const Eigen::VectorXd& factor, const Vertices& force, double h, Vertices& v,
                                   Vertices& x) const {
  const Vertices* other = &force;
  if (!lists_.empty()) {
    other_force_.setZero();
    for (const List& l : lists_) {
      kernels().add_list_gradient(list(l), columns(std::as_const(x)), columns(other_force_));
    }
    other_force_ = force - other_force_;
    other = &other_force_;
  }
  for_stretches([&](int first, const SpringStretch& stretch) {
    kernels().kick_bands(stretch, {.factor = factor.data() + first,
                                   .force = columns(*other, first),
                                   .h = h,
                                   .velocity = columns(v, first),
                                   .position = columns(x, first)});
  });
}

void SpringNetwork::compute_blocks(const Vertices& x, Blocks& blocks) const {
  blocks.across.resize(static_cast<Eigen::Index>(stiffness_.size()));
  blocks.along.resize(blocks.across.size(), 3);
  const auto kept = [&](std::size_t begin) {
    const auto at = static_cast<Eigen::Index>(begin);
    return SpringBlocks{blocks.across.data() + at, columns(blocks.along, at)};
  };
  for (const Band& b : bands_) {
    kernels().band_blocks(band(b, 0, 0), std::max(0, vertex_count_ - b.offset), columns(x), kept(b.begin));
  }
  for (const List& l : lists_) kernels().list_blocks(list(l), columns(x), kept(l.begin));
}

void SpringNetwork::add_product(const Blocks& blocks, const Vertices& vector, Vertices& product) const {
  const auto kept = [&](std::size_t begin) {
    const auto at = static_cast<Eigen::Index>(begin);
    return ConstSpringBlocks{blocks.across.data() + at, columns(blocks.along, at)};
  };
  for_stretches([&](int first, const SpringStretch& stretch) {
    std::array<ConstSpringBlocks, max_bands> of_bands{};
    for (std::size_t b = 0; b < bands_.size(); ++b) {
      of_bands[b] = kept(bands_[b].begin + static_cast<std::size_t>(first));
    }
    kernels().add_band_product(stretch, of_bands.data(), columns(vector, first), columns(product, first));
  });
  for (const List& l : lists_) {
    kernels().add_list_product(list(l), kept(l.begin), columns(vector), columns(product));
  }
}

}  // namespace drape
