#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "html/motion_player.hpp"
#include "output/collider_mesh.hpp"
#include "output/format.hpp"
#include "output/integer_track.hpp"
#include "output/poster_frame.hpp"
#include "overlay/color_scale.hpp"
#include "sim/vertex_stretch.hpp"

namespace drape {

/// Packs a motion for the player of a page, frame by frame: cloth, its stretch, bodies, spheres and grounds.
///
/// Positions become integer multiples of a precision, the smaller of 1/6000 of the cloth's size and 1/100 of its mean
/// edge. Stretch e is stored as 48 log₂(1 + e/0.0005), rounded to an integer, which keeps 1 % of its value. Data is
/// compressed at once, so only compressed bytes are in memory.
class MotionPacker {
 public:
  /// Largest motion that a browser can hold [vertex positions].
  static constexpr std::size_t most_positions = 16'000'000;

  /// @param film its references must stay valid. Without a cloth the first frame is the rest state.
  explicit MotionPacker(const FilmInfo& film);
  ~MotionPacker();

  /// Adds a frame. @throws OutputError if the texture cannot be read, if the motion exceeds `most_positions`, detected
  /// at the first frame, or if a position is beyond 10⁸ times the precision
  void add(const Frame& frame);

  /// Returns the number of frames added.
  [[nodiscard]] int frames() const { return frames_; }

  /// Completes the motion, which must have a frame. Call it once.
  [[nodiscard]] html::PlayedMotion finish();

 private:
  class Compressor;
  struct Mesh {
    IntegerTrack track;
    std::size_t vertices, triangles;
  };

  void add_first(const Frame& frame);
  void add_texture(std::string& bytes);
  void add_mesh(const std::vector<Triangle>& triangles, Eigen::Index vertices, std::string& bytes);
  void pack_colliders(const Frame& frame, std::string& bytes);
  [[nodiscard]] VertexIntegers whole(const Vertices& x) const;
  [[nodiscard]] std::string description() const;

  FilmInfo film_;
  ColorScale scale_;
  std::optional<PosterFrame> poster_;
  std::optional<VertexStretch> stretch_;
  std::optional<IntegerTrack> strain_;
  std::vector<Mesh> meshes_;  // cloth and bodies
  GroundPatch patch_;
  std::string texture_;  // a PNG file; empty: none
  std::unique_ptr<Compressor> compressor_;
  Eigen::RowVector3d origin_ = Eigen::RowVector3d::Zero();
  Eigen::RowVector3d lowest_, highest_;  // bounds of cloth and colliders in all frames
  double precision_ = 1, time_ = 0;
  std::size_t positions_ = 0;  // vertices per frame
  int spheres_ = 0, grounds_ = 0, frames_ = 0;
};

}  // namespace drape
