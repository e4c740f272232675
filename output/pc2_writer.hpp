#pragma once

#include <functional>
#include <string>

#include "core/atomic_file.hpp"
#include "output/format.hpp"

namespace drape {

/// Writes the motion as a Point Cache 2, which Blender's Mesh Cache modifier and others play on a mesh with the same
/// vertices: NAME.obj beside it, the cloth of the first frame. Points are in single precision [m, z up], with one
/// sample per frame; the first is at frame 0 of the cache.
class Pc2Writer final : public MotionWriter {
 public:
  Pc2Writer(const std::filesystem::path& file, const FilmInfo& film);

  void add(const Frame& frame) override;
  std::vector<OutputFile> finish(Ending ending) override;

 private:
  [[nodiscard]] std::string header(Eigen::Index points, int samples) const;

  int expected_;
  PartialFile file_, mesh_;
  std::function<std::string(const Frame&)> mesh_text_;
  Eigen::Index points_ = 0;
  int samples_ = 0;
};

OutputFormat pc2_format();

}  // namespace drape
