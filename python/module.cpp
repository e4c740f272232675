#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "core/build_info.hpp"
#include "python/lock.hpp"
#include "python/simulation.hpp"
#include "sim/instruction_set.hpp"

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
      "What is not given is as the scene has it: size [pixels], position and target [m], azimuth, elevation and\n"
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
