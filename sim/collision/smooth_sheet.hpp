#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "sim/cloth.hpp"
#include "sim/collision/distance.hpp"
#include "sim/collision/feature_set.hpp"
#include "sim/collision/sheet_blocks.hpp"
#include "sim/collision/sheet_motion.hpp"

namespace drape {

/// Says of a cloth that was cut out of one flat piece when nothing of it can touch in a step, for some operations for
/// each vertex, where a search for what is near looks at dozens of pairs for each.
///
/// x(p) is where the point p of the flat cloth is, and F = ∂x/∂p (3×2), which is constant in a triangle. Let A be
/// any 3×2 matrix with orthonormal columns, and p and q two points between which all triangles have a symmetric part of
/// AᵀF of at least σ. Then ‖x(p) − x(q)‖ ≥ σ‖p − q‖, since (p − q)ᵀAᵀ(x(p) − x(q)) is the integral of (p − q)ᵀAᵀF(p −
/// q) along the straight line between them. In a step the two move by at most D‖p − q‖ relative to each other, where D
/// is the largest norm by which F changes. And features that share no vertex are at least some distance δ apart in the
/// flat cloth: if it is convex, the smallest height of a triangle, as whoever leaves the triangles around a vertex
/// crosses one of them. So they stay at least (σ − D)δ apart, whatever the way they take.
///
/// What is not convex is made so, for lines to be straight: holes and notches are filled with triangles between
/// vertices of the cloth, whose F follows from how these move. No feature of theirs is ever compared with anything.
///
/// One A for the whole cloth does while it is nearly flat. Where it is folded, it is divided: a window of 2×2 blocks
/// into the smaller windows of 2×2 of the blocks' own blocks, each with an A of its own. Two points that are in one
/// window, but in none of the smaller ones, are in blocks with another between them, which have to be further apart
/// than they move; if they are not, their blocks are divided in turn, in the end into triangles.
///
/// What a window is found to have beyond what it needs lasts for as many steps as F takes to change by as much. So most
/// windows are looked at in one step of several, and in all others only how much F has changed.
class SmoothSheet {
 public:
  /// @param threads that share what is done for each vertex, of a large cloth
  explicit SmoothSheet(const Cloth& cloth, const Threads& threads = one_thread());

  /// Whether it is certain that any two features that share no vertex stay `distance` apart, and never come nearer than
  /// a fifth of the distance that they begin with, while vertices go from x (n×3) on straight lines by h·v, all finite.
  /// Of a cloth that is not flat at rest, or of several pieces, it never is. Where it was not for a few times, it is
  /// not looked for each time.
  [[nodiscard]] bool stays_apart(const Vertices& x, double h, const Vertices& v, double distance);

 private:
  using Index = std::size_t;
  using Pair = std::pair<Index, Index>;  // of blocks
  using Part = SheetBlocks::Part;
  using Axes = Eigen::Matrix<float, 3, 2>;
  using Change = SheetMotion::Change;
  using Boxes = SheetMotion::Boxes;
  using Row = SheetMotion::Row;
  /// What a window has: σ, and σ − distance/δ.
  struct Room {
    double whole = 0, beyond = 0;

    [[nodiscard]] bool lasts(const Change& change) const {
      return change.next <= beyond - change.since && change.next <= most_moved * (whole - change.since);
    }
  };
  struct Window {
    Room room;
    double used = 0;             // of the room, since it was looked at
    Index seen = 0;              // in which call it was visited last
    bool split = false;          // into smaller ones
    std::optional<Index> first;  // the piece that was not smooth when it was
  };
  /// The windows of a level, row by row.
  struct LevelState {
    Index columns = 1;
    std::vector<Window> windows;
  };
  /// Of the distance of two points, the part by which they may come nearer in a step.
  static constexpr double most_moved = 0.8;

  [[nodiscard]] bool window_is_apart(Index l, Index column, Index row);
  /// What a window has as a whole, if it lasts for a step; else `first` is a piece that has not.
  [[nodiscard]] std::optional<Room> smooth(Index l, const Part& part, const Change& change,
                                           std::optional<Index>& first) const;
  [[nodiscard]] std::optional<Axes> frame(Index l, const Part& part) const;
  /// Whether any two of these blocks stay apart that have another between them.
  [[nodiscard]] bool blocks_are_apart(Index l, const Part& part);
  [[nodiscard]] bool pair_is_apart(Index l, const Pair& pair);
  /// A lower bound of the distance of two blocks now, as sharp as it has to be to say that it is `enough` [m].
  [[nodiscard]] double gap(Index l, const Pair& pair, double enough);
  void gather(Index l, const Part& part, FeatureSet& features) const;
  /// Compares them one by one.
  [[nodiscard]] bool features_are_apart(const FeatureSet& a, const FeatureSet& b);

  std::optional<SheetMotion> motion_;  // nothing: it is not one that is flat
  std::vector<LevelState> levels_;
  std::array<FeatureSet, 2> features_;  // that are compared
  double distance_ = 0;
  Index calls_ = 1;
  int allowance_ = 0;             // how many features may be compared one by one in this call
  int failures_ = 0, pause_ = 0;  // how often it was not certain, and how often it is not looked for again
};

}  // namespace drape
