#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

#include "sim/collision/sheet_blocks.hpp"
#include "sim/mesh.hpp"
#include "sim/parallel/threads.hpp"

namespace drape {

/// Where the vertices of a sheet are, and the straight ways that they are about to go in a step: boxes around both for
/// each block, and how much F = ∂x/∂p changes (3×2, x(p) the place of the point p of the flat sheet).
///
/// All of it is in single precision, less what the first vertex does, with bounds of what that loses: it is for bounds
/// that have a margin. Four vectors at once fill the registers of any processor.
class SheetMotion {
 public:
  /// A vector x, y, z and 0 [m].
  using Row = Eigen::Array4f;
  /// Around the vertices of a block, and around their ways; of an empty block `low` is above `high`.
  struct Boxes {
    Row low = Row::Zero(), high = low, slow = low, fast = low;
    std::size_t seen = 0;  // in which call they were found

    [[nodiscard]] Row middle() const { return (low + high) / 2; }
    [[nodiscard]] Row way() const { return (slow + fast) / 2; }
    /// How far a vertex's way may be from that [m].
    [[nodiscard]] float spread() const { return (fast - slow).matrix().norm() / 2; }
  };
  /// Upper bounds of how much F has changed since the last call, and of how much it will in the step (spectral norm).
  struct Change {
    double since = 0, next = 0;
  };

  /// @param threads that share a measurement, of a large cloth
  explicit SheetMotion(SheetBlocks sheet, const Threads& threads = one_thread());

  [[nodiscard]] const SheetBlocks& sheet() const { return sheet_; }
  /// Takes where vertices are (n×3), and that they are about to go h·v. Whether numbers are of a size for this.
  [[nodiscard]] bool measure(const Vertices& x, double h, const Vertices& v);
  [[nodiscard]] Change change_in(std::size_t l, const SheetBlocks::Part& part) const;
  [[nodiscard]] const Boxes& boxes(std::size_t l, std::size_t block);
  /// The smaller eigenvalue of the symmetric part of AᵀF in four pieces, A's columns side by side.
  [[nodiscard]] Row least_along(const Eigen::Matrix<float, 3, 2>& axes, const std::array<std::size_t, 4>& pieces) const;
  /// F of a piece.
  [[nodiscard]] Eigen::Matrix<float, 3, 2> gradient(std::size_t piece) const;

  [[nodiscard]] const Row& place(int i) const { return places_[static_cast<std::size_t>(i)]; }
  [[nodiscard]] const Row& way(int i) const { return ways_[static_cast<std::size_t>(i)]; }
  /// More than single precision loses of a distance or a way [m], and of F.
  [[nodiscard]] double rounding() const { return rounding_; }
  [[nodiscard]] double gradient_rounding() const { return rounding_ * steepest_; }

 private:
  using Index = std::size_t;
  struct Piece {
    Triangle vertices;
    Row inverse;  // column by column
  };
  struct FourEdges {
    std::array<int, 4> from, to;
    Row weights;
  };

  void gather_edges();
  /// How much F changes in each block if vertices move by these rows, of which the largest number is given.
  void find_changes(const std::vector<Row>& moves, double largest, double Change::*which);

  SheetBlocks sheet_;
  const Threads& threads_;
  std::vector<Piece> pieces_;
  std::vector<FourEdges> edges_;  // of the blocks that are measured
  std::vector<Index> first_edges_;
  double steepest_ = 0;             // at most of F, for vertices a metre apart [1/m]
  Vertices ends_;                   // of the ways of the last call, n×3
  std::vector<Row> places_, ways_;  // less those of the first vertex
  double largest_place_ = 0;
  std::vector<Change> changes_;  // of the blocks that are measured
  std::vector<std::vector<Boxes>> boxes_;
  double rounding_ = 0;
  Index calls_ = 0;
};

}  // namespace drape
