#include "sim/linear/solve_tree.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <tuple>
#include <utility>

namespace drape {
namespace {

constexpr double worth_a_tree = 2.5e5;     // numbers of a triangle worth dividing: about 8000 rows of a cloth's
constexpr double least_of_a_leaf = 2.5e4;  // takes some microseconds
constexpr double most_leaves = 128;        // approximate; two for each of 64 threads
constexpr double tiny = 1.0 / 16;          // fraction of a leaf: smaller subtrees join their parent's part

constexpr int none = -1;

std::size_t at(int index) { return static_cast<std::size_t>(index); }

void wait_for(const Threads& threads, const std::atomic<unsigned>& done, unsigned solve) {
  if (done.load(std::memory_order_acquire) == solve) return;
  Wait wait(threads);
  while (done.load(std::memory_order_acquire) != solve) wait.keep_waiting();
}

}  // namespace

struct SolveTree::Plan {
  std::vector<std::size_t> row;     // start of each panel's rows, then the end of the last
  std::vector<int> panel_of_row;    // panel that contains the row's column
  std::vector<int> parent;          // of each panel in the elimination tree: the panel of its first row below
  std::vector<double> work;         // numbers in the subtree of each panel
  std::vector<int> large_children;  // number of each panel's children above the size of a leaf
  double largest_leaf = 0;

  Plan(const std::vector<Panel>& panels, const std::vector<int>& rows, int row_count)
      : row(panels.size() + 1),
        panel_of_row(at(row_count)),
        parent(panels.size(), none),
        work(panels.size()),
        large_children(panels.size()) {
    for (std::size_t p = 0; p < panels.size(); ++p) {
      row[p + 1] = row[p] + at(panels[p].row_count);
      work[p] = static_cast<double>(panel_size(panels[p]));
      std::fill_n(panel_of_row.begin() + panels[p].first, panels[p].width, static_cast<int>(p));
    }
    for (std::size_t p = 0; p < panels.size(); ++p) {
      if (panels[p].row_count == 0) continue;
      parent[p] = panel_of_row[at(rows[row[p]])];
      work[at(parent[p])] += work[p];
    }
    double total = 0;
    for (std::size_t p = 0; p < panels.size(); ++p) total += parent[p] == none ? work[p] : 0;
    largest_leaf = total < worth_a_tree ? total : std::max(least_of_a_leaf, total / most_leaves);
    for (std::size_t p = 0; p < panels.size(); ++p) {
      if (parent[p] != none && large(static_cast<int>(p))) ++large_children[at(parent[p])];
    }
  }

  [[nodiscard]] bool large(int panel) const { return work[at(panel)] > largest_leaf; }
};

SolveTree::SolveTree(std::vector<Panel>& panels, std::vector<int>& rows, int row_count) : places_(at(row_count)) {
  std::iota(places_.begin(), places_.end(), 0);
  place_count_ = row_count;
  if (panels.empty()) return;
  const Plan plan(panels, rows, row_count);
  std::vector<int> part_of(panels.size());
  make_parts(plan, part_of);
  if (parts_.size() == 1) return;
  sort_parts(part_of);
  fill_parts(plan, panels, part_of);
  renumber(plan, panels, rows);
  forward_done_ = std::make_unique<std::atomic<unsigned>[]>(parts_.size());
  backward_done_ = std::make_unique<std::atomic<unsigned>[]>(parts_.size());
}

void SolveTree::make_parts(const Plan& plan, std::vector<int>& part_of) {
  int loose = none;  // part of all small trees without a parent
  for (int p = static_cast<int>(part_of.size()) - 1; p >= 0; --p) {
    const int q = plan.parent[at(p)];
    const bool small = plan.work[at(p)] < tiny * plan.largest_leaf;
    const bool with_parent = q != none && (!plan.large(q) || (plan.large(p) ? plan.large_children[at(q)] == 1 : small));
    if (with_parent) {
      part_of[at(p)] = part_of[at(q)];
    } else if (q == none && !plan.large(p) && loose != none) {
      part_of[at(p)] = loose;
    } else {
      part_of[at(p)] = size();
      parts_.push_back({.parent = q == none ? none : part_of[at(q)], .top = p});
      if (q == none && !plan.large(p)) loose = part_of[at(p)];
    }
  }
}

void SolveTree::sort_parts(std::vector<int>& part_of) {
  for (std::size_t part = parts_.size(); part-- > 0;) {  // children come after their parents here
    const int parent = parts_[part].parent;
    if (parent != none) parts_[at(parent)].height = std::max(parts_[at(parent)].height, parts_[part].height + 1);
  }
  std::vector<int> order(parts_.size()), number(parts_.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int a, int b) {
    return std::tuple(parts_[at(a)].height, parts_[at(a)].top) < std::tuple(parts_[at(b)].height, parts_[at(b)].top);
  });
  std::vector<Part> sorted;
  for (std::size_t k = 0; k < order.size(); ++k) {
    number[at(order[k])] = static_cast<int>(k);
    sorted.push_back(parts_[at(order[k])]);
  }
  parts_ = std::move(sorted);
  for (Part& part : parts_) part.parent = part.parent == none ? none : number[at(part.parent)];
  for (int& part : part_of) part = number[at(part)];
}

void SolveTree::fill_parts(const Plan& plan, const std::vector<Panel>& panels, const std::vector<int>& part_of) {
  std::size_t value = 0;
  for (std::size_t p = 0; p < panels.size(); ++p) {
    Part& part = parts_[at(part_of[p])];
    const int panel = static_cast<int>(p);
    if (part.runs.empty() || part.runs.back().first + part.runs.back().count != panel) {
      part.runs.push_back({.first = panel, .row = plan.row[p], .value = value});
    }
    Run& run = part.runs.back();
    ++run.count;
    run.row_total += at(panels[p].row_count);
    run.value_total += panel_size(panels[p]);
    value += panel_size(panels[p]);
    part.own += panels[p].width;
  }
  place_count_ = 0;
  for (int number = 0; number < size(); ++number) {
    Part& part = parts_[at(number)];
    part.border = part.parent == none ? 0 : panels[at(part.top)].row_count;
    part.place = place_count_;
    part.target = targets_.size();
    targets_.resize(targets_.size() + at(part.border));
    place_count_ += part.own + part.border;
    if (part.parent != none) parts_[at(part.parent)].children.push_back(number);
    int next = part.place;
    for (const Run& run : part.runs) {
      for (int p = run.first; p < run.first + run.count; ++p) {
        for (int c = 0; c < panels[at(p)].width; ++c) places_[at(panels[at(p)].first + c)] = next++;
      }
    }
  }
}

void SolveTree::renumber(const Plan& plan, std::vector<Panel>& panels, std::vector<int>& rows) {
  std::vector<int> renumbered(rows.size()), border(places_.size()), whose(places_.size(), none);
  for (int number = 0; number < size(); ++number) {
    const Part& part = parts_[at(number)];
    const auto rows_of = [&](int panel) { return rows.begin() + static_cast<std::ptrdiff_t>(plan.row[at(panel)]); };
    for (int k = 0; k < part.border; ++k) {
      const std::size_t row = at(rows_of(part.top)[k]);
      border[row] = part.place + part.own + k;
      whose[row] = number;
    }
    // A row above a part is in its border: no column has rows that its parent lacks (Liu 1990).
    const auto place_in_part = [&](int row) {
      const int place = places_[at(row)];
      if (place >= part.place && place < part.place + part.own) return place;
      if (whose[at(row)] != number) throw std::logic_error("the rows of a factor are not nested");
      return border[at(row)];
    };
    for (const Run& run : part.runs) {
      for (std::size_t r = run.row; r < run.row + run.row_total; ++r) renumbered[r] = place_in_part(rows[r]);
    }
    for (const int child : part.children) {
      for (int k = 0; k < parts_[at(child)].border; ++k) {
        targets_[parts_[at(child)].target + at(k)] = place_in_part(rows_of(parts_[at(child)].top)[k]);
      }
    }
  }
  rows = std::move(renumbered);
  for (Panel& panel : panels) panel.first = place(panel.first);
}

template <class T>
void SolveTree::forward(const Part& part, const PackedTriangle<T>& triangle, T* x) const {
  std::fill_n(x + 4 * at(part.place + part.own), 4 * at(part.border), T{0});
  for (const int number : part.children) {
    const Part& child = parts_[at(number)];
    const T* from = x + 4 * at(child.place + child.own);
    for (int k = 0; k < child.border; ++k, from += 4) {
      T* to = x + 4 * at(targets_[child.target + at(k)]);
      for (int axis = 0; axis < 4; ++axis) to[axis] += from[axis];
    }
  }
  for (const Run& run : part.runs) {
    (kernels().*Substitution<T>::forward)({.panels = triangle.panels + run.first,
                                           .panel_count = run.count,
                                           .rows = triangle.rows + run.row,
                                           .values = triangle.values + run.value},
                                          x);
  }
}

template <class T>
void SolveTree::backward(const Part& part, const PackedTriangle<T>& triangle, T* x) const {
  T* to = x + 4 * at(part.place + part.own);
  for (int k = 0; k < part.border; ++k, to += 4) std::copy_n(x + 4 * at(targets_[part.target + at(k)]), 4, to);
  for (auto run = part.runs.rbegin(); run != part.runs.rend(); ++run) {
    (kernels().*Substitution<T>::backward)({.panels = triangle.panels + run->first,
                                            .panel_count = run->count,
                                            .rows = triangle.rows + run->row,
                                            .values = triangle.values + run->value,
                                            .row_total = run->row_total,
                                            .value_total = run->value_total},
                                           x);
  }
}

template <class T>
void SolveTree::solve(const Threads& threads, const PackedTriangle<T>& triangle, T* x) const {
  if (parts_.size() <= 1) {
    (kernels().*Substitution<T>::solve)(triangle, x);
    return;
  }
  const unsigned solve = ++solves_;
  const int count = size();
  threads.for_each(2 * count, [&](int turn) {
    const bool ahead = turn < count;
    const int number = ahead ? turn : 2 * count - 1 - turn;
    const Part& part = parts_[at(number)];
    if (ahead) {
      for (const int child : part.children) wait_for(threads, forward_done_[at(child)], solve);
      forward(part, triangle, x);
      forward_done_[at(number)].store(solve, std::memory_order_release);
    } else {
      if (part.parent == none) {
        wait_for(threads, forward_done_[at(number)], solve);
      } else {
        wait_for(threads, backward_done_[at(part.parent)], solve);
      }
      backward(part, triangle, x);
      backward_done_[at(number)].store(solve, std::memory_order_release);
    }
  });
}

template void SolveTree::solve<float>(const Threads&, const PackedTriangle<float>&, float*) const;
template void SolveTree::solve<double>(const Threads&, const PackedTriangle<double>&, double*) const;

namespace {

using Index = std::size_t;

constexpr int block_size = strip_rows * strip_rows;
// Columns eliminated before the rest of a front is updated, and strips updated together. These rows of these columns
// fit into the second-level cache.
constexpr int columns_at_once = 128;
constexpr int strips_at_once = 32;

int strips_of(int rows) { return (rows + strip_rows - 1) / strip_rows; }

/// Returns the offset of a column in a strip, or of a row in a triangle of eight.
Index eights(int number) { return Index{strip_rows} * static_cast<Index>(number); }

/// Returns the offset of a column of blocks in the update matrix, as if the blocks above the diagonal were stored.
Index left_start(int strips, int column_of_blocks) {
  const auto n = static_cast<Index>(strips), c = static_cast<Index>(column_of_blocks);
  return block_size * (c * (n - 1) - c * (c - 1) / 2);
}

/// Factors the diagonal block into rows of eight numbers, with reciprocals on the diagonal.
/// @returns true if it is positive definite
bool factor_block(const double* block, int width, double* triangle) {
  for (int c = 0; c < width; ++c) {
    const double* row = triangle + eights(c);
    double pivot = block[c * strip_rows + c];
    for (int k = 0; k < c; ++k) pivot -= row[k] * row[k];
    if (!(pivot > 0) || !std::isfinite(pivot)) return false;
    triangle[c * strip_rows + c] = 1 / std::sqrt(pivot);
    for (int r = c + 1; r < width; ++r) {
      double value = block[c * strip_rows + r];
      for (int k = 0; k < c; ++k) value -= triangle[r * strip_rows + k] * row[k];
      triangle[r * strip_rows + c] = value * triangle[c * strip_rows + c];
    }
  }
  return true;
}

/// Writes the inverse of such a triangle, by rows.
double* write_inverse(const double* triangle, int width, double* output) {
  double inverse[block_size];
  for (int r = 0; r < width; ++r) {
    const double* row = triangle + eights(r);
    for (int c = 0; c <= r; ++c) {
      double sum = 0;
      for (int k = c; k < r; ++k) sum += row[k] * inverse[k * strip_rows + c];
      *output++ = inverse[r * strip_rows + c] = c == r ? row[r] : -sum * row[r];
    }
  }
  return output;
}

}  // namespace

std::size_t DenseFront::own_size(int width, int below) {
  return static_cast<Index>(strips_of(width) + strips_of(below)) * block_size * static_cast<Index>(strips_of(width));
}

std::size_t DenseFront::left_size(int below) {
  const auto strips = static_cast<Index>(strips_of(below));
  return block_size * (strips * (strips + 1) / 2);
}

DenseFront::DenseFront(std::size_t largest, int most_below)
    : own_(largest), own_offsets_(static_cast<Index>(most_below)), left_offsets_(static_cast<Index>(most_below)) {}

void DenseFront::begin(int width, int below, double* left) {
  width_ = width;
  below_ = below;
  own_strips_ = strips_of(width);
  strips_ = own_strips_ + strips_of(below);
  stride_ = block_size * static_cast<Index>(own_strips_);
  left_ = left;
  std::fill_n(own_.data(), own_size(width, below), 0.0);
  std::fill_n(left_, left_size(below), 0.0);
}

void DenseFront::add(const std::vector<int>& rows, const double* left) {
  const int count = static_cast<int>(rows.size()), from_strips = strips_of(count);
  const int first_below = strip_rows * own_strips_;
  for (Index t = 0; t < rows.size(); ++t) {
    own_offsets_[t] = offset(rows[t], stride_);
    left_offsets_[t] = rows[t] < first_below ? 0 : offset(rows[t] - first_below, block_size);
  }
  for (int c = 0; c < count; ++c) {
    const int column = rows[static_cast<Index>(c)], column_below = column - first_below;
    const double* from = left + left_start(from_strips, c / strip_rows) + eights(c % strip_rows);
    const bool own = column_below < 0;
    double* to =
        own ? own_.data() + eights(column)
            : left_ + left_start(strips_ - own_strips_, column_below / strip_rows) + eights(column_below % strip_rows);
    const Index* offsets = own ? own_offsets_.data() : left_offsets_.data();
    for (int r = c; r < count; ++r) to[offsets[r]] += from[offset(r, block_size)];
  }
}

bool DenseFront::eliminate(double*& output, Pacer& pacer) {
  double triangle[block_size];
  for (int begin = 0; begin < width_; begin += columns_at_once) {
    const int end = std::min(width_, begin + columns_at_once);
    for (int column = begin; column < end; column += strip_rows) {
      const int first = column / strip_rows, width = std::min(strip_rows, width_ - column);
      subtract(begin, column, first, first, strips_ - first, pacer);
      double* block = strip(first) + eights(column);
      if (!factor_block(block, width, triangle)) return false;
      kernels().divide_strips(triangle, width, block, stride_, strips_ - first);
      output = write_panel(column, width, triangle, output);
    }
    const int later = strips_of(end);
    for (int row = later; row < strips_; row += strips_at_once) {
      const int row_end = std::min(strips_, row + strips_at_once);
      for (int column = later; column < row_end; ++column) {
        const int first = std::max(row, column);
        subtract(begin, end, column, first, row_end - first, pacer);
      }
    }
  }
  return true;
}

/// Subtracts the products of columns begin … end−1 from a strip of columns, for a range of row strips.
void DenseFront::subtract(int begin, int end, int column_strip, int first_strip, int count, Pacer& pacer) {
  if (begin == end) return;
  const Index from = eights(begin);
  const int left_column = column_strip - own_strips_;
  double* left = left_column < 0 ? nullptr
                                 : left_ + left_start(strips_ - own_strips_, left_column) +
                                       block_size * static_cast<Index>(first_strip - own_strips_);
  kernels().subtract_product({.rows = strip(first_strip) + from,
                              .row_stride = stride_,
                              .columns = strip(column_strip) + from,
                              .depth = end - begin,
                              .target = left != nullptr ? left : strip(first_strip) + eights(strip_rows * column_strip),
                              .target_stride = left != nullptr ? Index{block_size} : stride_,
                              .strips = count});
  pacer.did(2.0 * block_size * count * (end - begin));
}

/// Writes a group of neighbouring finished columns.
double* DenseFront::write_panel(int column, int width, const double* triangle, double* output) {
  output = write_inverse(triangle, width, output);
  const auto write_rows = [&](int row, int end) {
    for (; row < end; ++row) {
      const double* from = &own(row, column);
      for (int c = 0; c < width; ++c) *output++ = from[eights(c)];
    }
  };
  write_rows(column + width, width_);
  write_rows(row_below(0), row_below(below_));
  return output;
}

}  // namespace drape
