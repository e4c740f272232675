#include "sim/linear/dissection.hpp"

#include <algorithm>
#include <functional>
#include <span>

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

}  // namespace drape
