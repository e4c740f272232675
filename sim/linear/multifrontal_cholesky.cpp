#include "sim/linear/multifrontal_cholesky.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/error.hpp"
#include "core/memory.hpp"

namespace drape {
namespace {

using Index = std::size_t;

// Operations allowed for any graph, multiplications and additions: a minute or two.
constexpr double always_allowed = 2e12;

/// Returns the supernodes of the given order. Uses CHOLMOD's order if none is given, or if the given one costs more
/// than for a surface: separators grow with the coupling distance, and elimination with its third power.
Supernodes analyse(const LowerPattern& pattern, const std::vector<int>& order) {
  if (order.empty()) return find_supernodes(pattern, {});
  Supernodes given = find_supernodes(pattern, order);
  const double coupled = 2.0 * pattern.entries() - pattern.size();
  if (given.operations <= 2 * coupled * std::sqrt(coupled)) return given;
  Supernodes other = find_supernodes(pattern, {});
  return other.operations < given.operations ? other : given;
}

}  // namespace

MultifrontalCholesky::MultifrontalCholesky(const LowerPattern& pattern, const std::vector<int>& order,
                                           double caller_bytes)
    : tree_(analyse(pattern, order)), children_(Index(tree_.count()), 0) {
  const Sizes sizes = lay_out();
  require_surface(pattern.size(), operations_, always_allowed);
  const double bytes = static_cast<double>(entries_) * (sizeof(double) + caller_bytes) +
                       static_cast<double>(sizes.largest_front + sizes.stack) * sizeof(double) +
                       static_cast<double>(pattern.entries()) * 2 * sizeof(int) +
                       static_cast<double>(pattern.size()) * (3 * sizeof(int) + 4 * sizeof(double));
  require_memory(fmt::format("a sparse factor of {} rows", pattern.size()), bytes,
                 "use a coarser cloth or another method");
  map_entries(pattern);
  front_.emplace(sizes.largest_front, sizes.most_below);
  stack_.resize(sizes.stack);
  place_.resize(Index(pattern.size()));
  factor_.values.resize(entries_);
  solution_.assign(4 * (Index(pattern.size()) + 1), 0.0);
}

void MultifrontalCholesky::map_entries(const LowerPattern& pattern) {
  const int n = pattern.size();
  std::vector<int> rank(static_cast<Index>(n));
  for (int row = 0; row < n; ++row) rank[Index(tree_.order[Index(row)])] = row;
  const auto each = [&](const auto& visit) {
    for (int column = 0; column < n; ++column) {
      for (int p = pattern.starts[Index(column)]; p < pattern.starts[Index(column) + 1]; ++p) {
        const auto [low, high] = std::minmax({rank[Index(column)], rank[Index(pattern.rows[Index(p)])]});
        visit(low, high, p);
      }
    }
  };
  matrix_.starts.assign(Index(n) + 1, 0);
  each([&](int low, int, int) { ++matrix_.starts[Index(low) + 1]; });
  for (Index c = 0; c < Index(n); ++c) matrix_.starts[c + 1] += matrix_.starts[c];
  matrix_.rows.resize(Index(pattern.entries()));
  matrix_.places.resize(Index(pattern.entries()));
  std::vector<int> next(matrix_.starts.begin(), matrix_.starts.end() - 1);
  each([&](int low, int high, int p) {
    const auto at = Index(next[Index(low)]++);
    matrix_.rows[at] = high;
    matrix_.places[at] = p;
  });
}

MultifrontalCholesky::Sizes MultifrontalCholesky::lay_out() {
  std::vector<int> supernode(tree_.order.size());
  for (int s = 0; s < tree_.count(); ++s) std::fill_n(supernode.begin() + tree_.first[Index(s)], tree_.width(s), s);
  Sizes sizes;
  std::vector<int> waiting;  // on the stack
  Index top = 0;
  for (int s = 0; s < tree_.count(); ++s) {
    const int width = tree_.width(s), below = tree_.below(s);
    for (int c = 0; c < width; ++c) operations_ += static_cast<double>(width - c + below) * (width - c + below);
    add_panels(s);
    sizes.largest_front = std::max(sizes.largest_front, DenseFront::own_size(width, below));
    sizes.most_below = std::max(sizes.most_below, below);
    sizes.stack = std::max(sizes.stack, top + DenseFront::left_size(below));
    for (int child = 0; child < children_[Index(s)]; ++child) {
      if (parent_of(waiting.back(), supernode) != s) throw std::logic_error("the supernodes are in no postorder");
      top -= DenseFront::left_size(tree_.below(waiting.back()));
      waiting.pop_back();
    }
    if (below == 0) continue;
    ++children_[Index(parent_of(s, supernode))];
    waiting.push_back(s);
    top += DenseFront::left_size(below);
  }
  return sizes;
}

int MultifrontalCholesky::parent_of(int s, const std::vector<int>& supernode) const {
  return supernode[Index(tree_.rows[tree_.starts[Index(s)]])];
}

void MultifrontalCholesky::add_panels(int s) {
  const int width = tree_.width(s), end = tree_.first[Index(s)] + width;
  const auto rows = tree_.rows.begin() + static_cast<std::ptrdiff_t>(tree_.starts[Index(s)]);
  for (int first = end - width; first < end; first += panel_width) {
    const int own = std::min(panel_width, end - first), rest = end - first - own;
    factor_.panels.push_back({.first = first, .width = own, .row_count = rest + tree_.below(s)});
    for (int row = end - rest; row < end; ++row) factor_.rows.push_back(row);
    factor_.rows.insert(factor_.rows.end(), rows, rows + tree_.below(s));
    entries_ += panel_size(factor_.panels.back());
  }
}

bool MultifrontalCholesky::factorize(const double* values, const Pause& pause) {
  Pacer pacer(pause);
  double *output = factor_.values.data(), *top = stack_.data();
  std::vector<int>& waiting = waiting_;
  waiting.clear();
  for (int s = 0; s < tree_.count(); ++s) {
    const int width = tree_.width(s), below = tree_.below(s);
    double* left = top;
    front_->begin(width, below, left);
    assemble(s, values);
    for (int child = 0; child < children_[Index(s)]; ++child) {
      top -= DenseFront::left_size(tree_.below(waiting.back()));
      add_child(waiting.back(), top);
      waiting.pop_back();
    }
    if (!front_->eliminate(output, pacer)) return false;
    if (below == 0) continue;
    const Index size = DenseFront::left_size(below);
    std::copy(left, left + size, top);  // copied downwards
    waiting.push_back(s);
    top += size;
  }
  return true;
}

/// Adds A's entries in a supernode's columns, and records the positions of its rows.
void MultifrontalCholesky::assemble(int s, const double* values) {
  const int first = tree_.first[Index(s)], width = tree_.width(s);
  const int* rows = tree_.rows.data() + tree_.starts[Index(s)];
  for (int c = 0; c < width; ++c) place_[Index(first) + Index(c)] = c;
  for (int t = 0; t < tree_.below(s); ++t) place_[Index(rows[t])] = front_->row_below(t);
  for (int c = 0; c < width; ++c) {
    const int* begin = &matrix_.starts[Index(first) + Index(c)];
    for (auto e = Index(begin[0]); e < Index(begin[1]); ++e) {
      front_->own(place_[Index(matrix_.rows[e])], c) += values[matrix_.places[e]];
    }
  }
}

void MultifrontalCholesky::add_child(int child, const double* left) {
  const int* rows = tree_.rows.data() + tree_.starts[Index(child)];
  child_rows_.resize(Index(tree_.below(child)));
  for (Index t = 0; t < child_rows_.size(); ++t) child_rows_[t] = place_[Index(rows[t])];
  front_->add(child_rows_, left);
}

void MultifrontalCholesky::solve(const double* b, double* x) {
  const auto n = tree_.order.size();
  for (Index row = 0; row < n; ++row) solution_[4 * row] = b[tree_.order[row]];
  kernels().solve_double(triangle(), solution_.data());
  for (Index row = 0; row < n; ++row) x[tree_.order[row]] = solution_[4 * row];
}

}  // namespace drape
