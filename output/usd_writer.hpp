#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/files.hpp"
#include "drape/render/settings.hpp"
#include "output/mesh_writers.hpp"
#include "output/registry.hpp"

namespace drape {

/// Returns "(r, g, b)" in linear light, USD's colour format.
std::string usd_color(const Rgb& color);

/// Returns the cloth's Material, a purely diffuse UsdPreviewSurface in the look's colour or texture.
/// @param path  path of the prim: "/Scene/ClothMaterial"; indented for one level
/// @param file  output file: the texture's path is relative to it
std::string usd_material(const std::string& path, const Look& look, const std::filesystem::path& file);

/// Time samples of an attribute. They wait on disk, because a USD file stores one attribute after the other.
class UsdSamples {
 public:
  UsdSamples(const PartialFile& output, const std::string& what) : text_(output, what) {}

  void add(int time_code, std::string value);

  /// Writes "point3f[] points = FIRST", and if values differ, "point3f[] points.timeSamples = { … }".
  /// @param declaration "point3f[] points"
  void write(PartialFile& file, const std::string& indent, const std::string& declaration);

 private:
  Spool text_;
  std::string first_;
  bool moves_ = false;
};

/// Writes the motion as an ASCII USD file, in metres with z up. The cloth is a Mesh with points for every frame,
/// texture coordinates and a material; spheres follow, bodies as Meshes, and grounds as Planes. Time codes are frame
/// numbers; timeCodesPerSecond of them pass in a second of the scene. Points have single precision. Memory does not
/// grow with the motion.
class UsdWriter final : public MotionWriter {
 public:
  /// @throws UsageError if the copy of a temporary texture, "film.texture.png", would replace another file
  UsdWriter(const std::filesystem::path& file, const FilmInfo& film);

  void add(const Frame& frame) override;
  std::vector<OutputFile> finish(Ending ending) override;

 private:
  struct Ball {
    UsdSamples place, radius;
  };
  /// A mesh with time samples of its points.
  struct Body {
    std::shared_ptr<const std::vector<Triangle>> triangles;
    UsdSamples points;
  };
  void add_first(const Frame& frame);
  void write_header();
  void write_cloth();
  /// Returns true if each of several cloths has a look of its own.
  [[nodiscard]] bool several_looks() const;
  void write_materials();
  /// Returns the file of a texture for the stage: its copy, if there is one.
  [[nodiscard]] std::filesystem::path lasting(const std::filesystem::path& texture) const;
  void write_faces(const std::vector<Triangle>& triangles);
  void write_colliders();
  void write_bodies(const std::string& color);

  FilmInfo film_;
  std::map<std::filesystem::path, std::filesystem::path> copies_;  // of temporary textures, beside the file
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
