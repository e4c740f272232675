#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>
#include <algorithm>
#include <cmath>

#include "core/installation.hpp"
#include "core/text.hpp"
#include "drape/render/renderer.hpp"
#include "drape/sim/settings.hpp"
#include "python/simulation.hpp"
#include "render/overlay/color_scale.hpp"

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
  if (!needs_motion(camera)) return fixed_view(camera, frame.positions);
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

namespace py = pybind11;

namespace drape::python {
namespace {

void add_errors(py::module_& module) {
  const auto& error = py::register_exception<Error>(module, "Error");
  py::register_exception<UsageError>(module, "UsageError", error);
  py::register_exception<DivergedError>(module, "DivergedError", error);
  py::register_exception<OutputError>(module, "OutputError", error);
  module.attr("Error").attr("__doc__") = "Whatever drape raises; the message is the command line's.";
  module.attr("UsageError").attr("__doc__") = "The scene, a file that it names or an argument is wrong.";
  module.attr("DivergedError").attr("__doc__") = "The motion blew up, or left the range of finite numbers.";
  module.attr("OutputError").attr("__doc__") = "Drawing failed.";
}

void add_functions(py::module_& module) {
  using Point = std::optional<std::array<double, 3>>;
  using Number = std::optional<double>;
  module.def(
      "render",
      [](SceneSimulation& simulation, const std::optional<std::array<int, 2>>& size, const Point& position,
         const Point& target, const Number& azimuth, const Number& elevation, const Number& field_of_view,
         const std::optional<std::string>& color_by, const Number& color_limit) {
        return render(simulation, {size, position, target, azimuth, elevation, field_of_view, color_by, color_limit});
      },
      py::arg("simulation"), py::kw_only(), py::arg("size") = py::none(), py::arg("position") = py::none(),
      py::arg("target") = py::none(), py::arg("azimuth") = py::none(), py::arg("elevation") = py::none(),
      py::arg("field_of_view") = py::none(), py::arg("color_by") = py::none(), py::arg("color_limit") = py::none(),
      "Draws the cloth as it is now: height×width×3 bytes, sRGB.\n\n"
      "Omitted values are those of the scene: size [pixels], position and target [m], azimuth, elevation and\n"
      "field_of_view [degrees]. A camera without a position stands where all of this moment is in view. color_by "
      "colours\n"
      "the cloth by \"stretch\" (0.1: 10 %), \"speed\" [m/s] or \"curvature\" [1/m], from 0 to color_limit, by default "
      "what\n"
      "95 % of the vertices stay below. Captions belong to films, and are not drawn.");
  module.def("instruction_set", &instruction_set, "The instruction set that the hot loops use: \"avx2\".");
  module.def("instruction_sets", &instruction_sets, "Those they are compiled for, slowest first.");
  module.def("limit_instruction_set", &limit_instruction_set, py::arg("name"),
             "Has every simulation use at most this one: the bits are the same with all.");
  module.def("data_folder", &data_folder, "The folder with textures, shaders and scenes.");
  module.def("use_data_folder", &use_data_folder, py::arg("folder"),
             "Has textures, shaders and scenes come from this folder; \"\": from where they were installed.");
}

}  // namespace
}  // namespace drape::python

PYBIND11_MODULE(_drape, module) {
  module.doc() = "Mass-spring cloth: simulated, and drawn offscreen.";
  module.attr("__version__") = drape::build_info().version;
  drape::python::watch_end();
  drape::python::add_errors(module);
  drape::python::add_simulation(module);
  drape::python::add_functions(module);
}
