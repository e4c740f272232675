#include "sim/effects/spring_strings.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <tuple>

namespace drape {
namespace {

using Index = std::size_t;
constexpr Index no_spring = std::numeric_limits<Index>::max();
constexpr double straightest_corner = -0.8;  // cosine of the largest corner between consecutive springs
constexpr int most_rounds = 4;               // maximum number of updates of a string's slack set
// Regularisation of each spring, as a fraction of its weight. A string between two pins that is too short for their
// distance would otherwise need an infinite tension.
constexpr double slackening = 1e-3;

/// Next spring in the string, for both ends of each spring.
class Continuations {
 public:
  Continuations(const Cloth& cloth, const std::vector<Index>& springs)
      : cloth_(cloth), next_(cloth.springs.size(), {no_spring, no_spring}) {
    std::vector<std::vector<Index>> at(static_cast<Index>(cloth.vertex_count()));
    for (const Index k : springs) {
      for (const int end : {cloth.springs[k].i, cloth.springs[k].j}) at[static_cast<Index>(end)].push_back(k);
    }
    for (const int pin : cloth.pins) at[static_cast<Index>(pin)].clear();
    for (int vertex = 0; vertex < cloth.vertex_count(); ++vertex) join(vertex, at[static_cast<Index>(vertex)]);
  }

  [[nodiscard]] Index& next(Index k, int at) { return next_[k][cloth_.springs[k].i == at ? 0 : 1]; }
  [[nodiscard]] int other_end(Index k, int end) const {
    return cloth_.springs[k].i == end ? cloth_.springs[k].j : cloth_.springs[k].i;
  }

 private:
  void join(int vertex, const std::vector<Index>& around) {
    std::vector<std::tuple<double, Index, Index>> pairs;
    for (auto a = around.begin(); a != around.end(); ++a) {
      for (auto b = a + 1; b != around.end(); ++b) {
        const double cosine = away(*a, vertex).dot(away(*b, vertex));
        if (cosine < straightest_corner) pairs.emplace_back(cosine, *a, *b);
      }
    }
    std::sort(pairs.begin(), pairs.end());
    for (const auto& [cosine, a, b] : pairs) {
      if (next(a, vertex) != no_spring || next(b, vertex) != no_spring) continue;
      next(a, vertex) = b;
      next(b, vertex) = a;
    }
  }

  [[nodiscard]] Eigen::RowVector3d away(Index k, int vertex) const {
    return (cloth_.rest.row(other_end(k, vertex)) - cloth_.rest.row(vertex)).normalized();
  }

  const Cloth& cloth_;
  std::vector<std::array<Index, 2>> next_;
};

/// Solves for the changes of all taut springs, given those of slack ones.
void eliminate(std::span<Tension> string) {
  double next = 0, more = 0;
  for (Index k = 0; k < string.size(); ++k) {
    Tension& t = string[k];
    const double pivot = (1 + slackening) * t.weight - t.coupling * next;
    t.more = t.slack ? -t.pull : (t.excess + t.coupling * more) / pivot;
    t.next = t.slack || k + 1 == string.size() ? 0 : string[k + 1].coupling / pivot;
    next = t.next;
    more = t.more;
  }
  for (Index k = string.size() - 1; k-- > 0;) string[k].more += string[k].next * string[k + 1].more;
}

/// Releases springs that would push and adds slack ones that became too long. Returns true if any changed.
bool exchange(std::span<Tension> string) {
  bool any = false;
  for (Index k = 0; k < string.size(); ++k) {
    Tension& t = string[k];
    if (t.pull <= 0) continue;
    double left = t.excess - t.weight * t.more;
    if (k > 0) left += t.coupling * string[k - 1].more;
    if (k + 1 < string.size()) left += string[k + 1].coupling * string[k + 1].more;
    const bool slack = t.slack ? left <= 0 : t.pull + t.more < 0;
    any = any || slack != t.slack;
    t.slack = slack;
  }
  return any;
}

}  // namespace

std::vector<StringLink> lay_out_strings(const Cloth& cloth, const std::vector<std::size_t>& springs) {
  Continuations continuations(cloth, springs);
  std::vector<char> laid(cloth.springs.size(), 0);
  std::vector<StringLink> links;
  links.reserve(springs.size());
  for (const Index seed : springs) {
    if (laid[seed] != 0) continue;
    // Go back to the start of the string, or once around a ring.
    Index first = seed;
    int from = cloth.springs[seed].i;
    for (Index before = continuations.next(first, from); before != no_spring && before != seed;) {
      first = before;
      from = continuations.other_end(first, from);
      before = continuations.next(first, from);
    }
    bool joined = false;
    for (Index k = first; k != no_spring && laid[k] == 0; joined = true) {
      const int to = continuations.other_end(k, from);
      links.push_back({.spring = k, .from = from, .to = to, .joined = joined});
      laid[k] = 1;
      k = continuations.next(k, to);
      from = to;
    }
  }
  return links;
}

void balance(std::span<Tension> string) {
  for (Tension& t : string) t.slack = t.pull <= 0;
  for (int round = 0; round < most_rounds; ++round) {
    eliminate(string);
    if (!exchange(string)) break;
  }
  for (Tension& t : string) t.more = std::max(t.more, -t.pull);
}

}  // namespace drape
