#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "sim/cloth.hpp"
#include "sim/collision/flat_hull.hpp"

namespace drape {

/// A cloth that was cut out of one flat piece, laid flat again, its holes and notches filled with triangles up to its
/// convex hull, and the rectangle around it divided into blocks: into 2×2 of them, and each of these again and again,
/// until there are about two triangles in a block. Blocks in which nothing of the cloth lies are empty.
class SheetBlocks {
 public:
  struct Piece {
    Triangle vertices;
    Eigen::Matrix2d inverse;  ///< of its two edges from the first vertex, where it lies flat [1/m]
  };
  /// An edge of triangles in which ‖∂u/∂p‖² ≤ weight·‖uᵢ − uⱼ‖², where of their edges it is this for which it is
  /// largest.
  struct WeightedEdge {
    int i, j;
    double weight;  ///< [1/m²]
  };
  /// From the first to before the last of something.
  struct Range {
    std::size_t first = 0, last = 0;
  };
  /// Of the blocks of a level, those from some columns and rows to before others.
  struct Part {
    Range columns, rows;
  };
  /// One axis of a level: how it is cut.
  struct Axis {
    std::vector<double> borders;        ///< of its blocks, one more than there are [m]
    std::vector<std::size_t> children;  ///< where each of them is in the next level; the same where there is none
    std::vector<Range> measured;        ///< what each block covers, of the blocks of the level that is measured

    [[nodiscard]] std::size_t blocks() const { return borders.size() - 1; }
  };
  /// The rectangle in blocks, row by row.
  struct Level {
    std::array<Axis, 2> axes;                            // columns, rows
    std::vector<std::size_t> pieces;                     // of one block after another, those that reach into it
    std::vector<int> vertices;                           // of the cloth's of these, each once in a block
    std::vector<std::size_t> first_piece, first_vertex;  // of each block

    [[nodiscard]] std::size_t columns() const { return axes[0].blocks(); }
    [[nodiscard]] std::size_t rows() const { return axes[1].blocks(); }
    /// The window of 2×2 blocks from one on, or what there is of it; a block by itself.
    [[nodiscard]] Part window(std::size_t column, std::size_t row) const;
    [[nodiscard]] Part part_of(std::size_t block) const;
    /// The same part, in blocks of the next level.
    [[nodiscard]] Part inside(const Part& part) const;
    [[nodiscard]] std::span<const std::size_t> pieces_of(std::size_t block) const {
      return {pieces.data() + first_piece[block], first_piece[block + 1] - first_piece[block]};
    }
    [[nodiscard]] std::span<const int> vertices_of(std::size_t block) const {
      return {vertices.data() + first_vertex[block], first_vertex[block + 1] - first_vertex[block]};
    }
    /// Whether it has nothing of the cloth.
    [[nodiscard]] bool is_empty(const Part& part) const {
      for (std::size_t row = part.rows.first; row < part.rows.last; ++row) {
        const std::size_t first = row * columns();
        if (first_vertex[first + part.columns.first] != first_vertex[first + part.columns.last]) return false;
      }
      return true;
    }
    /// Whether check(piece) is true of all pieces that reach into a part; some are looked at more than once.
    template <class Check>
    bool all_pieces(const Part& part, Check&& check) const {
      for (std::size_t row = part.rows.first; row < part.rows.last; ++row) {
        for (std::size_t column = part.columns.first; column < part.columns.last; ++column) {
          for (const std::size_t piece : pieces_of(row * columns() + column)) {
            if (!check(piece)) return false;
          }
        }
      }
      return true;
    }
  };

  /// A number for each of a window's blocks' blocks, row by row.
  static constexpr std::size_t most_inside = 16;
  using Numbers = Eigen::Array<float, most_inside, 1>;
  /// Of two of them 0 where the first has another between it and the second, which comes after it; else infinity.
  using Pairs = std::array<Numbers, most_inside>;
  static const Pairs& pairs_apart(std::size_t columns);

  /// Nothing where the triangles and what fills holes and notches do not tile the convex hull: all have to lie the same
  /// way up, and no border may touch itself.
  static std::optional<SheetBlocks> of(const Cloth& cloth);

  [[nodiscard]] const std::vector<Piece>& pieces() const { return pieces_; }
  /// Whether a piece is one of the cloth's, or fills what it leaves out.
  [[nodiscard]] bool is_cloth(std::size_t piece) const { return piece < cloth_pieces_; }
  /// The smallest of two features of the cloth that share no vertex, where it lies flat; where nothing is left out, the
  /// smallest height of its triangles [m].
  [[nodiscard]] double least_distance() const { return least_distance_; }
  [[nodiscard]] const std::vector<Level>& levels() const { return levels_; }
  /// Of the level whose blocks are measured: their edges, block by block.
  [[nodiscard]] const Level& measured() const { return levels_[measured_]; }
  [[nodiscard]] std::span<const WeightedEdge> edges_of(std::size_t block) const {
    return {edges_.data() + first_edge_[block], first_edge_[block + 1] - first_edge_[block]};
  }

 private:
  [[nodiscard]] bool lay_flat(const Cloth& cloth);
  [[nodiscard]] bool add_pieces(const std::vector<Triangle>& triangles, double whole);
  /// Finds what is nearer to each other than triangles are high, across a notch; whether nothing touches.
  [[nodiscard]] bool keep_apart(const Cloth& cloth);
  void divide();
  /// Fills the lists of a level whose borders are known.
  void fill(Level& level) const;
  void weigh_edges();

  FlatPlaces flat_;
  double same_ = 0;  // what is no difference there [m]
  double least_distance_ = 0;
  std::vector<Piece> pieces_;  // the cloth's, then what fills the rest
  std::size_t cloth_pieces_ = 0;
  std::vector<Level> levels_;  // from 2×2 to the finest
  std::size_t measured_ = 0;
  std::vector<WeightedEdge> edges_;
  std::vector<std::size_t> first_edge_;
};

}  // namespace drape
