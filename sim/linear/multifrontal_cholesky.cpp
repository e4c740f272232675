#include "sim/linear/multifrontal_cholesky.hpp"

#include <cholmod.h>
#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <new>
#include <span>
#include <stdexcept>
#include <string>

#include "core/machine.hpp"
#include "drape/core/error.hpp"

namespace drape {
namespace {

// Largest piece that is not halved further; it becomes one or two dense blocks.
constexpr std::size_t smallest_piece = 12;

using Index = std::size_t;

/// Both triangles of a pattern, without the diagonal.
struct Neighbours {
  std::vector<int> starts, rows;

  explicit Neighbours(const LowerPattern& pattern) : starts(pattern.starts.size(), 0) {
    const auto each = [&](const auto& visit) {
      for (int column = 0; column < pattern.size(); ++column) {
        for (int p = pattern.starts[Index(column)] + 1; p < pattern.starts[Index(column) + 1]; ++p) {
          visit(column, pattern.rows[Index(p)]);
        }
      }
    };
    each([&](int column, int row) { ++starts[Index(column) + 1], ++starts[Index(row) + 1]; });
    for (Index v = 1; v < starts.size(); ++v) starts[v] += starts[v - 1];
    rows.resize(Index(starts.back()));
    std::vector<int> next(starts.begin(), starts.end() - 1);
    each([&](int column, int row) {
      rows[Index(next[Index(column)]++)] = row;
      rows[Index(next[Index(row)]++)] = column;
    });
  }
  [[nodiscard]] std::span<const int> of(int vertex) const {
    return std::span(rows).subspan(Index(starts[Index(vertex)]),
                                   Index(starts[Index(vertex) + 1] - starts[Index(vertex)]));
  }
};

class Dissection {
 public:
  Dissection(const LowerPattern& pattern, const Vertices& places)
      : neighbours_(pattern), places_(places), half_(Index(pattern.size()), 0) {}

  /// Sorts the vertices of a piece.
  void order(std::span<int> piece) {
    if (piece.size() <= smallest_piece) {
      std::sort(piece.begin(), piece.end());
      return;
    }
    const Index low_size = halve(piece);
    const std::span<int> low = piece.first(low_size), high = piece.subspan(low_size);
    // New names, which no other piece has; earlier halves are never checked again.
    const int name = names_ += 2;
    for (const int vertex : low) half_[Index(vertex)] = name;
    for (const int vertex : high) half_[Index(vertex)] = name + 1;
    const auto touches = [&](int half) {
      return [this, half](int vertex) {
        return std::ranges::any_of(neighbours_.of(vertex), [&](int other) { return half_[Index(other)] == half; });
      };
    };
    // The separator consists of the vertices of one half with neighbours in the other; choose the smaller one.
    const auto from_low = std::count_if(low.begin(), low.end(), touches(name + 1));
    const auto from_high = std::count_if(high.begin(), high.end(), touches(name));
    const bool cut_low = from_low <= from_high;
    const std::span<int> whole = cut_low ? high : low;
    // Order: the uncut half, the rest of the other half, the separator.
    if (cut_low) std::rotate(piece.begin(), piece.begin() + static_cast<std::ptrdiff_t>(low_size), piece.end());
    const std::span<int> rest = piece.subspan(whole.size());
    const auto cut = std::partition(rest.begin(), rest.end(), std::not_fn(touches(cut_low ? name + 1 : name)));
    std::sort(cut, rest.end());
    order(piece.first(whole.size()));
    order(rest.first(static_cast<Index>(cut - rest.begin())));
  }

 private:
  /// Moves the vertices on one side of the middle of a piece to its front; returns their number.
  Index halve(std::span<int> piece) const {
    Eigen::Array3d least = places_.row(piece.front()).transpose(), most = least;
    for (const int vertex : piece) {
      for (int axis = 0; axis < 3; ++axis) {
        least[axis] = std::min(least[axis], places_(vertex, axis));
        most[axis] = std::max(most[axis], places_(vertex, axis));
      }
    }
    int axis = 0;
    (most - least).maxCoeff(&axis);
    const auto place = places_.col(axis);
    const auto middle = piece.begin() + static_cast<std::ptrdiff_t>(piece.size() / 2);
    std::nth_element(piece.begin(), middle, piece.end(),
                     [&](int a, int b) { return place[a] < place[b] || (place[a] == place[b] && a < b); });
    // Keep vertices at the same coordinate in one half for a straight cut, unless they are most of the piece.
    const double at = place[*middle];
    const auto line = std::partition(piece.begin(), middle, [&](int vertex) { return place[vertex] < at; });
    const auto before = static_cast<Index>(line - piece.begin());
    return 4 * before >= piece.size() ? before : piece.size() / 2;
  }

  Neighbours neighbours_;
  const Vertices& places_;
  std::vector<int> half_;  // name of the last half of each vertex
  int names_ = 0;
};

}  // namespace

std::vector<int> dissect(const LowerPattern& pattern, const Vertices& places) {
  std::vector<int> rows(Index(pattern.size()));
  for (Index row = 0; row < rows.size(); ++row) rows[row] = static_cast<int>(row);
  Dissection(pattern, places).order(rows);
  return rows;
}

namespace {

/// CHOLMOD's settings and workspace.
struct Analysis {
  cholmod_common common{};
  cholmod_factor* factor = nullptr;

  Analysis() { cholmod_start(&common); }
  ~Analysis() {
    cholmod_free_factor(&factor, &common);
    cholmod_finish(&common);
  }
  Analysis(const Analysis&) = delete;
  Analysis& operator=(const Analysis&) = delete;
};

}  // namespace

Supernodes find_supernodes(const LowerPattern& pattern, const std::vector<int>& order, Solves solves) {
  Analysis analysis;
  cholmod_common& common = analysis.common;
  common.print = 0;
  common.supernodal = CHOLMOD_SUPERNODAL;
  // CHOLMOD limits the zeros in merged supernodes. A tenth of its limit saves 12 % of the entries of a million vertices
  // and a quarter of the time of a solve; the double saves a quarter of the time of a factorisation.
  const double relaxation = solves == Solves::many ? 0.1 : 2;
  for (double& share : common.zrelax) share *= relaxation;
  if (!order.empty()) {
    common.nmethods = 1;
    common.method[0].ordering = CHOLMOD_GIVEN;
  }
  cholmod_sparse matrix{};
  matrix.nrow = matrix.ncol = static_cast<std::size_t>(pattern.size());
  matrix.nzmax = static_cast<std::size_t>(pattern.entries());
  matrix.p = const_cast<int*>(pattern.starts.data());  // CHOLMOD only reads it
  matrix.i = const_cast<int*>(pattern.rows.data());
  matrix.stype = -1;
  matrix.itype = CHOLMOD_INT;
  matrix.xtype = CHOLMOD_PATTERN;
  matrix.dtype = CHOLMOD_DOUBLE;
  matrix.sorted = matrix.packed = 1;
  analysis.factor =
      cholmod_analyze_p(&matrix, order.empty() ? nullptr : const_cast<int*>(order.data()), nullptr, 0, &common);
  if (common.status == CHOLMOD_OUT_OF_MEMORY) throw std::bad_alloc();
  if (common.status == CHOLMOD_TOO_LARGE) throw UsageError("a sparse factor of this cloth has more than 2³¹ entries");
  if (analysis.factor == nullptr)
    throw std::runtime_error("CHOLMOD failed with status " + std::to_string(common.status));

  const cholmod_factor& f = *analysis.factor;
  const auto* perm = static_cast<const int*>(f.Perm);
  const auto *first = static_cast<const int*>(f.super), *starts = static_cast<const int*>(f.pi);
  const auto* rows = static_cast<const int*>(f.s);
  Supernodes result{.order = {perm, perm + f.n},
                    .first = {first, first + f.nsuper + 1},
                    .starts = {0},
                    .rows = {},
                    .operations = common.fl};
  result.starts.reserve(f.nsuper + 1);
  result.rows.reserve(static_cast<std::size_t>(starts[f.nsuper] - static_cast<int>(f.n)));
  for (std::size_t s = 0; s < f.nsuper; ++s) {
    const int width = first[s + 1] - first[s];  // its rows begin with its own columns
    result.rows.insert(result.rows.end(), rows + starts[s] + width, rows + starts[s + 1]);
    result.starts.push_back(result.rows.size());
  }
  return result;
}

namespace {

using Index = std::size_t;

// Operations allowed for any graph, multiplications and additions: a minute or two.
constexpr double always_allowed = 2e12;

/// Returns the supernodes of the given order. Uses CHOLMOD's order if none is given, or if the given one costs more
/// than for a surface: separators grow with the coupling distance, and elimination with its third power.
Supernodes analyse(const LowerPattern& pattern, const std::vector<int>& order, Solves solves) {
  if (order.empty()) return find_supernodes(pattern, {}, solves);
  Supernodes given = find_supernodes(pattern, order, solves);
  const double coupled = 2.0 * pattern.entries() - pattern.size();
  if (given.operations <= 2 * coupled * std::sqrt(coupled)) return given;
  Supernodes other = find_supernodes(pattern, {}, solves);
  return other.operations < given.operations ? other : given;
}

}  // namespace

MultifrontalCholesky::MultifrontalCholesky(const LowerPattern& pattern, const std::vector<int>& order, Solves solves,
                                           double caller_bytes)
    : tree_(analyse(pattern, order, solves)), children_(Index(tree_.count()), 0) {
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
