#include "output/integer_track.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>

namespace drape {
namespace {

/// Maps 0, −1, 1, −2, … to 0, 1, 2, 3, …
std::uint64_t zigzag(std::int64_t number) {
  return (static_cast<std::uint64_t>(number) << 1) ^ static_cast<std::uint64_t>(number >> 63);
}

/// Returns the length of all residuals [bits], without their prefixes.
std::int64_t length(const VertexIntegers& residuals) {
  std::int64_t bits = 0;
  for (const std::int64_t residual : residuals.reshaped()) bits += std::bit_width(zigzag(residual));
  return bits;
}

}  // namespace

LowerNeighbours::LowerNeighbours(const std::vector<Triangle>& triangles, Eigen::Index vertices) {
  std::vector<std::array<int, 2>> edges;  // the higher vertex first
  for (const Triangle& t : triangles) {
    for (std::size_t c = 0; c < 3; ++c) {
      const auto [low, high] = std::minmax(t[c], t[(c + 1) % 3]);
      if (low != high) edges.push_back({high, low});
    }
  }
  std::ranges::sort(edges);
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  begin_.assign(static_cast<std::size_t>(vertices) + 1, 0);
  for (const auto& [high, low] : edges) {
    ++begin_[static_cast<std::size_t>(high) + 1];
    neighbours_.push_back(low);
  }
  for (std::size_t i = 1; i < begin_.size(); ++i) begin_[i] += begin_[i - 1];
}

std::int64_t LowerNeighbours::mean(const VertexIntegers& values, Eigen::Index column, Eigen::Index vertex) const {
  const std::size_t from = begin_[static_cast<std::size_t>(vertex)], to = begin_[static_cast<std::size_t>(vertex) + 1];
  if (from == to) return 0;
  std::int64_t sum = 0;
  for (std::size_t k = from; k < to; ++k) sum += values(neighbours_[k], column);
  const auto count = static_cast<std::int64_t>(to - from);
  return sum >= 0 ? sum / count : -((count - 1 - sum) / count);
}

IntegerTrack::IntegerTrack(const std::vector<Triangle>& triangles, Eigen::Index vertices, Eigen::Index columns)
    : neighbours_(triangles, vertices),
      before_(VertexIntegers::Zero(vertices, columns)),
      two_before_(VertexIntegers::Zero(vertices, columns)) {}

void IntegerTrack::append(const VertexIntegers& now, std::string& bytes) {
  if (!first_ && now == before_) {
    bytes += '\0';
    two_before_ = before_;
    return;
  }
  first_ = false;
  VertexIntegers best;
  char mode = 0;
  std::int64_t least = std::numeric_limits<std::int64_t>::max();
  const auto consider = [&](char as, VertexIntegers&& residuals) {
    const std::int64_t bits = length(residuals);
    if (bits >= least) return;
    least = bits;
    mode = as;
    best = std::move(residuals);
  };
  for (const char line : {char{0}, char{1}}) {
    VertexIntegers residuals = now - before_;
    if (line == 1) residuals -= before_ - two_before_;
    VertexIntegers from_neighbours = residuals;
    for (Eigen::Index c = 0; c < now.cols(); ++c) {
      for (Eigen::Index i = 0; i < now.rows(); ++i) from_neighbours(i, c) -= neighbours_.mean(residuals, c, i);
    }
    consider(static_cast<char>(1 + line), std::move(residuals));
    consider(static_cast<char>(3 + line), std::move(from_neighbours));
  }
  bytes += mode;
  for (const std::int64_t residual : best.reshaped()) append_varint(residual, bytes);
  two_before_ = before_;
  before_ = now;
}

void append_varint(std::int64_t number, std::string& bytes) {
  std::uint64_t rest = zigzag(number);
  for (; rest >= 128; rest >>= 7) bytes += static_cast<char>((rest & 127) | 128);
  bytes += static_cast<char>(rest);
}

}  // namespace drape
