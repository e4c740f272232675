// Part of SpringNetwork that sums its blocks per vertex.

#include "sim/spring_network.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

#include "sim/parallel/loops.hpp"
#include "sim/parallel/vectors.hpp"

namespace drape {
namespace {

// Ratio of the times for a spring by index and for an entry of a band.
constexpr int worth_a_band = 4;
// Common multiple of all kernels' vector sizes. Stretches are multiples of it, so that all kernels divide alike.
constexpr int widest_vector = 8;

// Number of vertices from which several steps per pass pay: a step then moves more memory than a core's cache holds.
constexpr int worth_several_steps = 60000;

int offset(const Spring& s) { return s.j - s.i; }

std::size_t padded(int count) {
  constexpr std::size_t vector = widest_vector;
  return (static_cast<std::size_t>(count) + vector - 1) / vector * vector;
}

/// Waits until another thread has raised a number to at least `least`.
void wait_until(const Threads& threads, const std::atomic<int>& number, int least) {
  int now = number.load(std::memory_order_acquire);
  if (now >= least) return;
  Wait wait(threads);
  for (; now < least; now = number.load(std::memory_order_acquire)) {
    if (wait.keep_waiting()) number.wait(now, std::memory_order_acquire);
  }
}

}  // namespace

SpringNetwork::SpringNetwork(const std::vector<Spring>& springs, int vertex_count, const Threads& threads)
    : springs_(springs),
      vertex_count_(vertex_count),
      threads_(threads),
      gathered_(fill_bands(), vertex_count, threads) {
  if (gathered_.size() > 0) other_force_.resize(vertex_count_, 3);
  cut_parts();
}

void SpringNetwork::find_bands() {
  std::map<int, int> springs_of_offset;
  for (const Spring& spring : springs_) ++springs_of_offset[offset(spring)];
  std::vector<std::pair<int, int>> common;  // number of springs, offset
  for (const auto& [distance, count] : springs_of_offset) {
    if (count * worth_a_band >= vertex_count_) common.emplace_back(-count, distance);
  }
  std::sort(common.begin(), common.end());
  common.resize(std::min<std::size_t>(common.size(), max_bands));

  std::size_t scratch = 0;
  std::sort(common.begin(), common.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  for (const auto& [ignored, distance] : common) {
    // Forces move through the scratch memory; at its end, those still needed are copied to its front.
    const std::size_t lead = padded(distance);
    const std::size_t capacity = 2 * lead + 4 * std::size_t{kernel_size};
    bands_.push_back({.offset = distance,
                      .begin = bands_.size() * padded(vertex_count_),
                      .scratch = scratch,
                      .lead = lead,
                      .capacity = capacity});
    scratch += 3 * capacity;
  }
}

std::vector<Spring> SpringNetwork::fill_bands() {
  find_bands();
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
  return rest;
}

void SpringNetwork::cut_parts() {
  const std::size_t scratch = bands_.empty() ? 0 : bands_.back().scratch + 3 * bands_.back().capacity;
  const int farthest = bands_.empty() ? 0 : bands_.back().offset;
  const int lead = static_cast<int>(padded(farthest));
  const int stretches = (vertex_count_ + kernel_size - 1) / kernel_size;
  const int parts = vertex_count_ < worth_dividing ? 1 : std::min(threads_.count(), stretches);
  for (int p = 0; p < parts; ++p) {
    const auto begin_of = [&](int part) {
      return static_cast<int>(std::int64_t{stretches} * part / parts) * kernel_size;
    };
    Part part{.first = begin_of(p), .end = std::min(begin_of(p + 1), vertex_count_)};
    part.force.assign(scratch, 0.0);
    part.lead = std::max(0, part.first - lead);
    part.tail = part.end;
    if (part.end < vertex_count_) {
      // A stretch needs up to `farthest` vertices after it.
      while (part.tail > part.first && part.tail + farthest > part.end) part.tail -= kernel_size;
    }
    if (part.first > 0) {
      part.nowhere.resize(kernel_size, 3);
      part.at_lead.resize(std::min(vertex_count_, part.first + farthest) - part.lead, 3);
    }
    if (part.end < vertex_count_) part.at_tail.resize(std::min(vertex_count_, part.end + farthest) - part.tail, 3);
    parts_.push_back(std::move(part));
  }
  if (parts > 1) values_.resize(static_cast<std::size_t>(stretches));
}

SpringBand SpringNetwork::band(const Band& b, int first, double* force) const {
  const std::size_t entry = b.begin + static_cast<std::size_t>(first);
  return {.offset = b.offset,
          .stiffness = stiffness_.data() + entry,
          .rest_length = rest_length_.data() + entry,
          .force = force == nullptr ? Columns<double>{}
                                    : Columns<double>{force, force + b.capacity, force + 2 * b.capacity}};
}

SpringNetwork::Pass::Pass(const SpringNetwork& network, Part& part)
    : network_(&network), part_(&part), first_(part.lead) {
  for (std::size_t b = 0; b < network.bands_.size(); ++b) {
    const auto lead = static_cast<std::ptrdiff_t>(places_[b] = network.bands_[b].lead);
    for (int axis = 0; axis < 3; ++axis) std::fill_n(column(network.bands_[b], axis), lead, 0.0);
  }
}

double* SpringNetwork::Pass::column(const Band& b, int axis) const {
  return part_->force.data() + b.scratch + static_cast<std::size_t>(axis) * b.capacity;
}

template <class Use>
void SpringNetwork::Pass::next(Use&& use) {
  const bool leads = first_ < part_->first;
  const int size = std::min(kernel_size, (leads ? part_->first : part_->end) - first_);
  const auto count = static_cast<std::size_t>(size);
  std::array<SpringBand, max_bands> given{};
  for (std::size_t b = 0; b < network_->bands_.size(); ++b) {
    const Band& own = network_->bands_[b];
    if (places_[b] + count > own.capacity) {
      for (int axis = 0; axis < 3; ++axis) {
        const double* end = column(own, axis) + places_[b];
        std::copy(end - own.lead, end, column(own, axis));
      }
      places_[b] = own.lead;
    }
    given[b] = network_->band(own, first_, part_->force.data() + own.scratch + places_[b]);
    places_[b] += count;
  }
  use(Place{first_, leads}, SpringStretch{.count = size,
                                          .vertices_after = network_->vertex_count_ - first_ - size,
                                          .bands = given.data(),
                                          .band_count = static_cast<int>(network_->bands_.size())});
  first_ += size;
}

template <class Use>
void SpringNetwork::for_stretches(Part& part, Use&& use) const {
  for (Pass pass(*this, part); !pass.over();) pass.next(use);
}

template <class Use>
void SpringNetwork::for_all_stretches(Vertices& to, Use&& use) const {
  threads_.for_each(static_cast<int>(parts_.size()), [&](int p) {
    Part& part = parts_[static_cast<std::size_t>(p)];
    part.nowhere.setZero();
    for_stretches(part, [&](const Place& place, const SpringStretch& stretch) {
      use(place, stretch, place.leads ? columns(part.nowhere) : columns(to, place.first));
    });
  });
}

template <class Use>
double SpringNetwork::sum_over_stretches(Vertices& to, Use&& use) const {
  double total = 0;
  if (parts_.size() == 1) {
    for_all_stretches(to, [&](const Place& place, const SpringStretch& stretch, Columns<double> columns_to) {
      total += use(place.first, stretch, columns_to);
    });
    return total;
  }
  for_all_stretches(to, [&](const Place& place, const SpringStretch& stretch, Columns<double> columns_to) {
    const double value = use(place.first, stretch, columns_to);
    if (!place.leads) values_[static_cast<std::size_t>(place.first / kernel_size)] = value;
  });
  for (const double value : values_) total += value;
  return total;
}

double SpringNetwork::add_value_gradient(const Vertices& x, Vertices& gradient) const {
  const double total = sum_over_stretches(gradient, [&](int first, const SpringStretch& stretch, Columns<double> to) {
    return kernels().add_band_value_gradient(stretch, columns(x, first), to);
  });
  return total + gathered_.add_value_gradient(x, gradient);
}

double SpringNetwork::evaluate(const Eigen::VectorXd& inertia, const Vertices& y, const Vertices& x,
                               Vertices& gradient) const {
  const double total = sum_over_stretches(gradient, [&](int first, const SpringStretch& stretch, Columns<double> to) {
    return kernels().evaluate_bands(stretch, columns(x, first),
                                    {.factor = inertia.data() + first, .y = columns(y, first), .gradient = to});
  });
  return total + gathered_.add_value_gradient(x, gradient);
}

void SpringNetwork::keep_surroundings(Part& part, const Vertices& x) const {
  if (part.at_lead.rows() > 0) part.at_lead = x.middleRows(part.lead, part.at_lead.rows());
  if (part.at_tail.rows() > 0) part.at_tail = x.middleRows(part.tail, part.at_tail.rows());
}

double SpringNetwork::kick_and_drift(const Eigen::VectorXd& factor, const Vertices& force, const Drift& drift,
                                     Vertices& v, Vertices& x) const {
  const Vertices* other = &force;
  if (gathered_.size() > 0) {
    set_zero(threads_, other_force_);
    gathered_.add_gradient(x, other_force_);
    subtract(threads_, force, other_force_, other_force_);
    other = &other_force_;
  }
  const int parts = static_cast<int>(parts_.size());
  const auto part_of = [&](int p) -> Part& { return parts_[static_cast<std::size_t>(p)]; };
  if (parts > 1) threads_.for_each(parts, [&](int p) { keep_surroundings(part_of(p), x); });
  threads_.for_each(parts, [&](int p) {
    Part& part = part_of(p);
    part.nowhere.setZero();
    part.squares = 0;
    for_stretches(part, [&](const Place& place, const SpringStretch& stretch) {
      const int first = place.first;
      const Vertices& at = place.leads ? part.at_lead : first >= part.tail ? part.at_tail : std::as_const(x);
      const int begin = place.leads ? part.lead : first >= part.tail ? part.tail : 0;
      const double squares =
          kernels().kick_bands(stretch, {.factor = factor.data() + first,
                                         .force = columns(*other, first),
                                         .drift = drift,
                                         .velocity = place.leads ? columns(part.nowhere) : columns(v, first),
                                         .from = columns(at, first - begin),
                                         .position = place.leads ? columns(part.nowhere) : columns(x, first)});
      if (!place.leads) part.squares += squares;
    });
  });
  double squares = 0;
  for (const Part& part : parts_) squares += part.squares;
  return squares;
}

int SpringNetwork::most_steps() const {
  return gathered_.size() > 0 || bands_.empty() || vertex_count_ < worth_several_steps ? 1 : most_at_once;
}

void SpringNetwork::make_waves() const {
  waves_.resize(most_at_once);
  for (Part& wave : waves_) {
    wave.end = vertex_count_;
    wave.force.assign(bands_.back().scratch + 3 * bands_.back().capacity, 0.0);
  }
}

double SpringNetwork::kick_and_drift_times(int count, const Eigen::VectorXd& factor, const Vertices& force,
                                           const Drift& drift, const Drift& between, Vertices& v, Vertices& x) const {
  if (waves_.empty()) make_waves();
  const Kernels& k = kernels();
  const int stretches = (vertex_count_ + kernel_size - 1) / kernel_size;
  const int reach = (bands_.back().offset + kernel_size - 1) / kernel_size;
  const int groups = std::min(threads_.count(), count);
  std::array<std::atomic<int>, most_at_once> done{};  // stretches that each group's last step has moved
  double squares = 0;
  threads_.for_each(groups, [&](int group) {
    const int begin = count * group / groups, end = count * (group + 1) / groups;
    std::array<std::optional<Pass>, most_at_once> passes;
    for (int step = begin; step < end; ++step) {
      passes[static_cast<std::size_t>(step)].emplace(*this, waves_[static_cast<std::size_t>(step)]);
    }
    const int behind = (end - 1 - begin) * reach;  // stretches between the first and the last step
    for (int front = 0; front < stretches + behind; ++front) {
      const int needed = std::min(front + reach + 1, stretches);
      if (group > 0) wait_until(threads_, done[static_cast<std::size_t>(group) - 1], needed);
      for (int step = begin; step < end; ++step) {
        const int stretch = front - (step - begin) * reach;
        if (stretch < 0 || stretch >= stretches) continue;
        passes[static_cast<std::size_t>(step)]->next([&](const Place& place, const SpringStretch& springs) {
          const int first = place.first;
          const double moved = k.kick_bands(springs, {.factor = factor.data() + first,
                                                      .force = columns(force, first),
                                                      .drift = drift,
                                                      .velocity = columns(v, first),
                                                      .from = columns(std::as_const(x), first),
                                                      .position = columns(x, first)});
          if (step == count - 1) {
            squares += moved;
          } else if (between.h != 0) {
            for (int axis = 0; axis < 3; ++axis) {
              k.drift(static_cast<std::size_t>(springs.count), between, v.col(axis).data() + first,
                      x.col(axis).data() + first);
            }
          }
        });
      }
      if (front < behind) continue;
      done[static_cast<std::size_t>(group)].store(front - behind + 1, std::memory_order_release);
      done[static_cast<std::size_t>(group)].notify_one();
    }
  });
  return squares;
}

void SpringNetwork::compute_blocks(const Vertices& x, double concavity, Blocks& blocks) const {
  const auto size = static_cast<Eigen::Index>(stiffness_.size() + gathered_.size());
  if (blocks.across.size() != size) {
    // No spring has the entries between the bands, but add_diagonal() computes with them.
    blocks.across = Eigen::VectorXd::Zero(size);
    blocks.along = Vertices::Ones(size, 3);
  }
  const auto kept = [&](std::size_t begin) {
    const auto at = static_cast<Eigen::Index>(begin);
    return SpringBlocks{blocks.across.data() + at, columns(blocks.along, at)};
  };
  for (const Band& b : bands_) {
    for_ranges(threads_, std::max(0, vertex_count_ - b.offset), [&](Eigen::Index first, Eigen::Index count) {
      kernels().band_blocks(band(b, static_cast<int>(first), nullptr), static_cast<int>(count), concavity,
                            columns(x, first), kept(b.begin + static_cast<std::size_t>(first)));
    });
  }
  gathered_.compute_blocks(x, concavity, kept(stiffness_.size()));
}

void SpringNetwork::add_product(const Blocks& blocks, const Vertices& vector, Vertices& product) const {
  const auto kept = [&](std::size_t begin) {
    const auto at = static_cast<Eigen::Index>(begin);
    return ConstSpringBlocks{blocks.across.data() + at, columns(blocks.along, at)};
  };
  for_all_stretches(product, [&](const Place& place, const SpringStretch& stretch, Columns<double> to) {
    std::array<ConstSpringBlocks, max_bands> of_bands{};
    for (std::size_t b = 0; b < bands_.size(); ++b) {
      of_bands[b] = kept(bands_[b].begin + static_cast<std::size_t>(place.first));
    }
    kernels().add_band_product(stretch, of_bands.data(), columns(vector, place.first), to);
  });
  gathered_.add_product(kept(stiffness_.size()), vector, product);
}

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

void stiffen_evenly(double modulus, Cloth& cloth) {
  stiffen_by_area(modulus, cloth);
  // Springs along x, along y and diagonal, each with Σ k l² over the cloth.
  std::array<double, 3> sums{};
  double aslant_x = 0, aslant_y = 0;
  const auto kind = [&](const Eigen::RowVector3d& along) {
    const double least = 1e-6 * along.norm();
    if (std::abs(along.y()) < least) return std::size_t{0};
    return std::abs(along.x()) < least ? std::size_t{1} : std::size_t{2};
  };
  for (const Spring& s : cloth.springs) {
    const Eigen::RowVector3d along = cloth.rest.row(s.j) - cloth.rest.row(s.i);
    sums[kind(along)] += s.stiffness * along.squaredNorm();
    if (kind(along) != 2) continue;
    aslant_x += along.x() * along.x();
    aslant_y += along.y() * along.y();
  }
  // With c = cos² and s = sin² of the diagonals' angle, these shares make Σ k l² n⊗n⊗n⊗n per area isotropic. There are
  // three, as every triangle has three sides.
  const double c = aslant_x / (aslant_x + aslant_y), s = 1 - c;
  const std::array shares{9.0 / 8 - 3.0 / 8 * c / s, 9.0 / 8 - 3.0 / 8 * s / c, 3.0 / 8 / (c * s)};
  if (!(std::ranges::min(shares) > 0)) return;
  const double whole = (sums[0] + sums[1] + sums[2]) / 3;
  for (Spring& spring : cloth.springs) {
    const std::size_t k = kind(cloth.rest.row(spring.j) - cloth.rest.row(spring.i));
    spring.stiffness *= shares[k] * whole / sums[k];
  }
}

std::vector<Spring> springs_of_grid(int columns, const Vertices& rest, const GridSprings& stiffnesses) {
  const int stride = columns + 1, rows = static_cast<int>(rest.rows()) / stride;
  std::vector<Spring> springs;
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < stride; ++i) {
      const auto add = [&](int right, int up, double stiffness) {
        if (i + right < 0 || i + right >= stride || j + up >= rows) return;
        const int from = j * stride + i, to = from + up * stride + right;
        const double length = (rest.row(to) - rest.row(from)).norm();
        springs.push_back({.i = from, .j = to, .rest_length = length, .stiffness = stiffness});
      };
      add(1, 0, stiffnesses.structural);
      add(2, 0, stiffnesses.bend);
      add(-1, 1, stiffnesses.shear);
      add(0, 1, stiffnesses.structural);
      add(1, 1, stiffnesses.shear);
      add(0, 2, stiffnesses.bend);
    }
  }
  return springs;
}

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
