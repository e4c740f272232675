#include <algorithm>
#include <cmath>

#include "core/nearest.hpp"
#include "overlay/vertex_coloring.hpp"
#include "python/lock.hpp"
#include "python/simulation.hpp"
#include "render/renderer.hpp"

namespace py = pybind11;

namespace drape::python {
namespace {

Eigen::Vector3d vector_of(const std::array<double, 3>& numbers) { return {numbers[0], numbers[1], numbers[2]}; }

/// Returns the view of the scene's camera with the wishes. Without a position it frames only this moment.
View view_of(Camera camera, const PictureWishes& wishes, const Frame& frame, double aspect) {
  if (wishes.position) camera.position = vector_of(*wishes.position);
  if (wishes.target) camera.target = vector_of(*wishes.target);
  if (wishes.field_of_view) camera.field_of_view = *wishes.field_of_view;
  if (wishes.azimuth || wishes.elevation) camera.position.reset();
  camera.azimuth = wishes.azimuth.value_or(camera.azimuth.value_or(Camera::usual_azimuth));
  camera.elevation = wishes.elevation.value_or(camera.elevation.value_or(Camera::usual_elevation));
  if (!needs_motion(camera)) return fixed_view(camera);
  Framing framing(camera, aspect);
  framing.add(frame.positions);
  for (const Collider& collider : frame.colliders) framing.add(collider);
  return framing.view();
}

/// Returns the colouring of the vertices, if one is requested.
std::optional<VertexColoring> coloring_of(const PictureWishes& wishes, const Cloth& cloth) {
  if (!wishes.color_by) {
    if (wishes.color_limit) throw UsageError("color_limit: it has no effect without color_by");
    return std::nullopt;
  }
  const std::vector<std::string> names{"stretch", "speed", "curvature"};  // in the order of ColorBy
  const auto found = std::ranges::find(names, *wishes.color_by);
  if (found == names.end()) {
    throw UsageError("color_by: unknown '" + *wishes.color_by + "'" +
                     did_you_mean(*wishes.color_by, names, "the choices are"));
  }
  if (wishes.color_limit && !(*wishes.color_limit > 0 && std::isfinite(*wishes.color_limit))) {
    throw UsageError("color_limit: expected a number above 0");
  }
  return VertexColoring(static_cast<ColorBy>(found - names.begin()), wishes.color_limit, cloth);
}

Image draw(const Scene& scene, const PictureWishes& wishes, const Frame& frame) {
  Eigen::Vector2i size = scene.video.size;
  if (wishes.size) size = {(*wishes.size)[0], (*wishes.size)[1]};
  constexpr int most = 16384;
  if (size.minCoeff() < 1 || size.maxCoeff() > most) throw UsageError("size: expected from 1 to 16384 pixels");
  const View view = view_of(scene.camera, wishes, frame, static_cast<double>(size[0]) / size[1]);
  const Cloth& cloth = scene.simulation.cloth;
  std::optional<VertexColoring> coloring = coloring_of(wishes, cloth);
  Look look = scene.look;
  if (coloring) look.texture.clear();
  Renderer renderer(data_folder(), size, view, look, cloth.vertex_count(), cloth.triangles, scene.uvs);
  renderer.set_weave(cloth.rest, scene.uvs);
  if (!coloring) return renderer.draw(frame);
  coloring->survey(frame);
  return renderer.draw(frame, coloring->colors(frame));
}

}  // namespace

py::array render(SceneSimulation& simulation, const PictureWishes& wishes) {
  simulation.require_made();
  const Frame frame = simulation.with([](const Simulation& s) {
    return Frame{
        .time = s.time(), .positions = s.state().x, .colliders = s.colliders(s.time()), .velocities = s.state().v};
  });
  constexpr double furthest = 1e90;  // limit of a scene's meshes [m]
  if (!frame.positions.allFinite() || frame.positions.cwiseAbs().maxCoeff() > furthest) {
    throw DivergedError(
        "the cloth cannot be drawn: vertices are farther away than 1e90 m; restore() a state before that");
  }
  const Image image = [&] {
    const WithoutLock free;
    return draw(simulation.scene(), wishes, frame);
  }();
  py::array_t<std::uint8_t> pixels({image.height, image.width, 3});
  std::copy(image.pixels.begin(), image.pixels.end(), pixels.mutable_data());
  return pixels;
}

}  // namespace drape::python
