#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/spool.hpp"
#include "output/collider_mesh.hpp"
#include "output/format.hpp"

namespace drape {

/// An attribute's time samples, which wait on disk, since a USD file has one attribute after the other.
class UsdSamples {
 public:
  UsdSamples(const PartialFile& output, const std::string& what) : text_(output, what) {}

  void add(int time_code, std::string value);

  /// "point3f[] points = FIRST", and unless all values are one, "point3f[] points.timeSamples = { … }".
  /// @param declaration "point3f[] points"
  void write(PartialFile& file, const std::string& indent, const std::string& declaration);

 private:
  Spool text_;
  std::string first_;
  bool moves_ = false;
};

/// The motion as an ASCII USD file: in metres with z up; the cloth a Mesh whose points have a sample for every frame,
/// with texture coordinates and a material; spheres, bodies as Meshes, and grounds as Planes. The time codes are the
/// frames' numbers, of which timeCodesPerSecond pass in a second of the scene. Points in single precision, as USD has
/// them. Memory does not grow with the motion.
class UsdWriter final : public MotionWriter {
 public:
  UsdWriter(const std::filesystem::path& file, const FilmInfo& film);

  void add(const Frame& frame) override;
  std::vector<OutputFile> finish(Ending ending) override;

 private:
  struct Ball {
    UsdSamples place, radius;
  };
  /// A mesh with the samples of its points.
  struct Body {
    std::shared_ptr<const std::vector<Triangle>> triangles;
    UsdSamples points;
  };
  void add_first(const Frame& frame);
  void write_header();
  void write_cloth();
  void write_faces(const std::vector<Triangle>& triangles);
  void write_colliders();
  void write_bodies(const std::string& color);

  FilmInfo film_;
  PartialFile file_;
  UsdSamples points_, extent_;
  std::vector<std::unique_ptr<Ball>> balls_;
  std::vector<std::unique_ptr<Body>> bodies_;
  std::vector<GroundShape> grounds_;
  GroundPatch patch_;
  int count_ = 0;
};

OutputFormat usda_format();

}  // namespace drape
