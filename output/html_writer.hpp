#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "drape/sim/mesh.hpp"
#include "output/mesh_writers.hpp"
#include "output/png_encoder.hpp"
#include "output/registry.hpp"
#include "render/camera_path.hpp"
#include "render/overlay/color_scale.hpp"
#include "reports/players.hpp"

namespace drape {

/// Integers of vertices: vertices × columns.
using VertexIntegers = Eigen::Matrix<std::int64_t, Eigen::Dynamic, Eigen::Dynamic>;

/// Lists of each vertex's neighbours with lower numbers.
class LowerNeighbours {
 public:
  LowerNeighbours(const std::vector<Triangle>& triangles, Eigen::Index vertices);

  /// Returns the mean over a vertex's lower neighbours, rounded down; 0 without such neighbours.
  /// @param values values of all vertices; those below `vertex` are read
  [[nodiscard]] std::int64_t mean(const VertexIntegers& values, Eigen::Index column, Eigen::Index vertex) const;

 private:
  std::vector<std::size_t> begin_;  // per vertex, and one more
  std::vector<int> neighbours_;
};

/// Encodes integers of a mesh's vertices that change from frame to frame, as bytes that compress well.
///
/// A frame is a mode byte, followed by the residuals of all vertices, column after column, as varints (zigzag, 7 bits
/// per byte, the lowest first). Mode 0 has no residuals: nothing has changed. Mode 1 predicts the previous frame, mode
/// 2 the line through the two previous frames. Modes 3 and 4 do the same and predict each residual by the mean of its
/// lower neighbours' residuals. Each frame uses the mode with the shortest residuals. reports/motion_data.js decodes
/// it.
class IntegerTrack {
 public:
  IntegerTrack(const std::vector<Triangle>& triangles, Eigen::Index vertices, Eigen::Index columns);

  /// Appends the bytes of the next frame.
  void append(const VertexIntegers& now, std::string& bytes);

 private:
  LowerNeighbours neighbours_;
  VertexIntegers before_, two_before_;
  bool first_ = true;
};

/// Appends a signed number as a varint.
void append_varint(std::int64_t number, std::string& bytes);

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
  /// @param first the player's first view shows the whole motion from this view's direction
  /// @param up    axis about which the player turns
  [[nodiscard]] html::PlayedMotion finish(const View& first, const Eigen::Vector3d& up);

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
  [[nodiscard]] std::string description(const View& first, const Eigen::Vector3d& up) const;

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
  int spheres_ = 0, grounds_ = 0, frames_ = 0;
};

/// Writes the motion as a self-contained page whose player turns the cloth, plays it and colours it by stretch. It is
/// first seen from the direction of the film's first frame. Only the compressed motion is in memory, and the few frames
/// by which an automatic camera is placed.
class HtmlWriter final : public MotionWriter {
 public:
  HtmlWriter(const std::filesystem::path& file, const FilmInfo& film);

  void add(const Frame& frame) override;
  std::vector<OutputFile> finish(Ending ending) override;

 private:
  [[nodiscard]] View first_view(const Camera& camera) const;

  FilmInfo film_;
  PartialFile file_;
  MotionPacker packer_;
  SampledFrames samples_;
};

OutputFormat html_format();

}  // namespace drape
