#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

#include "sim/cloth.hpp"
#include "sim/collision/distance.hpp"

namespace drape {

/// Says of a cloth that was cut as a rectangle when it is so smooth that nothing of it can touch in a step: in some
/// operations for each triangle, where a search for what is near looks at dozens of pairs for each.
///
/// x(p) is where the point p of the flat rectangle is, and F = ∂x/∂p (3×2), which is constant in a triangle. Let A be
/// any 3×2 matrix with orthonormal columns, and p and q two points between which all triangles have a symmetric part of
/// AᵀF of at least σ. Then ‖x(p) − x(q)‖ ≥ σ‖p − q‖, since (p − q)ᵀAᵀ(x(p) − x(q)) is the integral of (p − q)ᵀAᵀF(p −
/// q) along the straight line between them. In a step the two move by at most D‖p − q‖ relative to each other, where D
/// is the largest norm by which F changes. And features that share no vertex are at least the smallest height δ of a
/// triangle apart in the rectangle: whoever leaves the triangles around a vertex crosses one of them. So they stay at
/// least (σ − D)δ apart, whatever the way they take.
///
/// One A for the whole cloth does while it is nearly flat. Where it is folded, it is divided into blocks, and each
/// window of 2×2 blocks has an A of its own. Two points that are in no window together are in blocks with another
/// between them, and the balls around those have to be further apart than they move.
class SmoothSheet {
 public:
  explicit SmoothSheet(const Cloth& cloth);

  /// Whether it is certain that any two features that share no vertex stay `distance` apart, and never come nearer than
  /// a fifth of the distance that they begin with, while vertices go from `from` on straight lines by h·velocities. Of
  /// a cloth that is no rectangle it never is. Where it was not for a few times, it is not looked for each time.
  [[nodiscard]] bool stays_apart(const std::vector<Point>& from, double h, const std::vector<Point>& velocities,
                                 double distance);

 private:
  using Gradient = Eigen::Matrix<double, 3, 2>;
  struct Piece {
    Triangle vertices;
    Eigen::Matrix2d inverse;               // of its two edges from the first vertex, in the rectangle
    Gradient gradient = Gradient::Zero();  // F at the start of the step
    double changed = 0;                    // the squared norm by which F changes in the step
  };
  /// What lies within a block: entries of lists, from and to.
  struct Block {
    std::size_t first_piece = 0, last_piece = 0, first_vertex = 0, last_vertex = 0;
    Gradient sum = Gradient::Zero();  // of its pieces' F
    double changed = 0;               // the largest of theirs
  };
  /// What a block is in for the whole step, seen from something that moves at `velocity`.
  struct Ball {
    Point middle = Point::Zero();    // [m]
    Point velocity = Point::Zero();  // [m/s]
    double radius = 0;               // [m]
  };
  struct Balls {
    std::vector<Ball> all;
    std::vector<double> x, y, z, reach;  // side by side; reach: seen from what moves as the whole cloth does
    double time = 0;                     // of the step, and a margin [s]

    void set(std::size_t k, const Ball& ball, double way, const Point& together);
    /// Whether ball k touches none of these.
    [[nodiscard]] bool apart(std::size_t k, std::size_t first, std::size_t last) const;
  };
  /// The rectangle in blocks, row by row.
  struct Division {
    std::size_t columns = 1, rows = 1;
    std::vector<Block> blocks;
    std::vector<std::size_t> pieces;
    std::vector<int> vertices;
    Balls balls;  // around the blocks
  };

  /// Whether the triangles tile the rectangle around them: all lie the same way up, and what has but one triangle lies
  /// on the border.
  [[nodiscard]] bool lay_flat(const Cloth& cloth);
  [[nodiscard]] Division divided(std::size_t most) const;

  void load(const std::vector<Point>& from, double h, const std::vector<Point>& velocities);
  /// Whether one A does for a window, for σ − D to be `ratio` at least.
  [[nodiscard]] bool smooth(const Division& division, const std::array<std::size_t, 4>& window, double ratio) const;
  [[nodiscard]] bool windows_are_smooth(Division& division, double ratio) const;
  [[nodiscard]] static Ball ball_around(const Division& division, std::size_t k, const std::vector<Point>& from,
                                        double h, const std::vector<Point>& velocities, double distance);
  [[nodiscard]] bool blocks_are_apart(Division& division, const std::vector<Point>& from, double h,
                                      const std::vector<Point>& velocities, double distance) const;

  Eigen::Matrix<double, Eigen::Dynamic, 2> flat_;  // where vertices are in the rectangle [m]
  double least_height_ = 0;                        // δ [m]
  std::vector<Piece> pieces_;
  std::vector<Division> divisions_;  // from one block to many; none: it is no rectangle
  std::size_t last_ = 0;             // that which did last
  int failures_ = 0, pause_ = 0;     // how often none did, and how often it is not tried again
};

}  // namespace drape
