#include "sim/linear/solve_tree.hpp"

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "sim/linear/substitution.hpp"

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
  while (done.load(std::memory_order_acquire) != solve) wait.go_on();
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

}  // namespace drape
