#pragma once

// Example:
//   const drape::Mesh mesh = drape::make_grid(20, 20);
//   const drape::View view{.position = {0, -4, 2}, .target = {0, 0, 0}, .up = {0, 0, 1}};
//   drape::Renderer renderer(drape::data_folder(), {480, 400}, view, drape::Look{}, 441, mesh.triangles, mesh.uvs);
//   const drape::Image image = renderer.draw({.positions = mesh.positions});

#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "drape/render/image.hpp"
#include "drape/render/settings.hpp"
#include "drape/render/view.hpp"
#include "drape/sim/state.hpp"

namespace drape {

/// Draws frames without a window. Owns a GL context during its lifetime: make, use and destroy a renderer on one
/// thread. A thread may have several. The next renderer, on any thread, reuses a destroyed one's context and compiled
/// shaders. A frame always gives the same bytes, for any number of Mesa's threads.
class Renderer {
 public:
  /// @param data_folder  holds shaders/
  /// @param size         picture size [pixels]
  /// @param vertex_count number of cloth vertices in every frame
  /// @param triangles    triangles of the cloth
  /// @param uvs          per triangle corner as in Mesh::uvs; may be empty if look.texture is
  /// @param backend      source of the OpenGL context
  /// @throws UsageError  if look.texture cannot be read or there are no uvs for it
  /// @throws OutputError if the backend or OpenGL 3.3 is missing or a shader does not compile
  Renderer(const std::filesystem::path& data_folder, Eigen::Vector2i size, const View& view, const Look& look,
           int vertex_count, const std::vector<Triangle>& triangles, const std::vector<std::array<float, 2>>& uvs,
           GlBackend backend = GlBackend::automatic);
  ~Renderer();
  Renderer(Renderer&&) noexcept;
  Renderer& operator=(Renderer&&) noexcept;

  /// Gives the cloth a weave in all following frames, visible from near, see Weave.
  /// @param rest positions of the flat cloth's vertices [m]
  /// @param uvs  as in the constructor; without any there is no weave
  void set_weave(const Vertices& rest, const std::vector<std::array<float, 2>>& uvs);

  /// Draws the following frames from another viewpoint.
  void look_from(const View& view);

  /// Draws a frame.
  /// @throws std::invalid_argument if the frame has another number of vertices
  /// @throws std::logic_error if a frame was started and is not finished
  /// @throws OutputError if OpenGL reports an error
  Image draw(const Frame& frame);

  /// Draws the cloth with data colours per vertex instead of its texture or colour.
  /// @param vertex_colors one per vertex; they are lit like any colour
  /// @throws std::invalid_argument if their number differs from that of the vertices
  Image draw(const Frame& frame, const std::vector<Rgb>& vertex_colors);

  /// Starts drawing a frame, as draw(). Returns the picture of the previous frame, if it was started and not finished.
  /// Mesa's threads draw while the caller works, so the frames of a film take less time.
  std::optional<Image> start(const Frame& frame);
  std::optional<Image> start(const Frame& frame, const std::vector<Rgb>& vertex_colors);

  /// Returns the picture of the frame started last; nothing if it was returned before.
  /// @throws OutputError if OpenGL reports an error
  std::optional<Image> finish();

  /// Returns the name and version of the OpenGL renderer in use.
  [[nodiscard]] std::string description() const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace drape
