#include "python/simulation.hpp"

#include <fmt/format.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>
#include <atomic>
#include <chrono>
#include <thread>
#include <utility>

#include "drape/scene/scene.hpp"
#include "scene/values.hpp"

namespace py = pybind11;

namespace drape::python {
namespace {

constexpr Place nowhere{.line = 0, .column = 0};

std::string key_text(const py::handle& key) {
  if (!py::isinstance<py::str>(key)) {
    throw py::type_error(fmt::format("expected names of keys, found {}", std::string(py::repr(key))));
  }
  return key.cast<std::string>();
}

TomlValue value_of(decltype(TomlValue::data) data) { return {.place = nowhere, .data = std::move(data)}; }

TomlValue to_whole(const py::handle& number, const std::string& name) {
  try {
    return value_of(number.cast<std::int64_t>());
  } catch (const py::cast_error&) {
    throw UsageError(name + ": the number is too large");
  }
}

TomlValue to_table(const py::dict& dictionary, const std::string& name, int depth) {
  TomlTable table;
  for (const auto& [key, item] : dictionary) {
    const std::string text = key_text(key);
    table.entries.push_back({text, nowhere, to_toml(item, name.empty() ? text : name + "." + text, depth + 1)});
  }
  return value_of(std::move(table));
}

TomlValue to_array(const py::iterable& items, const std::string& name, int depth) {
  TomlArray array;
  for (const py::handle item : items)
    array.push_back(to_toml(item, fmt::format("{}.{}", name, array.size()), depth + 1));
  return value_of(std::move(array));
}

}  // namespace

TomlValue to_toml(const py::handle& value, const std::string& name, int depth) {
  if (depth > static_cast<int>(most_nested_names)) throw py::type_error(name + " is nested deeper than any scene");
  if (py::isinstance<py::bool_>(value)) return value_of(value.cast<bool>());
  if (py::isinstance<py::int_>(value)) return to_whole(value, name);
  if (py::isinstance<py::float_>(value)) return value_of(value.cast<double>());
  if (py::isinstance<py::str>(value)) return value_of(value.cast<std::string>());
  if (py::isinstance<py::dict>(value)) return to_table(value.cast<py::dict>(), name, depth);
  if (py::isinstance<py::list>(value) || py::isinstance<py::tuple>(value)) {
    return to_array(value.cast<py::iterable>(), name, depth);
  }
  if (py::hasattr(value, "tolist")) return to_toml(value.attr("tolist")(), name, depth + 1);  // numpy values
  if (py::hasattr(value, "__fspath__")) return to_toml(value.attr("__fspath__")(), name, depth + 1);
  throw py::type_error(fmt::format("{}: expected a number, a string, a list or a dictionary, found {}",
                                   name.empty() ? "scene" : name, std::string(py::repr(value))));
}

std::vector<std::string> to_overrides(const py::dict& set) {
  std::vector<std::string> overrides;
  for (const auto& [key, value] : set) {
    const std::string name = key_text(key);
    overrides.push_back(name + "=" + toml_literal(to_toml(value, name)));
  }
  return overrides;
}

}  // namespace drape::python

namespace py = pybind11;

namespace drape::python {
namespace {

using std::chrono_literals::operator""ms;

std::atomic<bool> ending = false;   // true while Python ends
std::atomic<int> without_lock = 0;  // threads that compute without the lock
std::atomic<int> taking_lock = 0;   // threads that wait for the lock and have not seen the end

/// Marks this thread as waiting for the lock, during its lifetime.
class TakingLock {
 public:
  TakingLock() { ++taking_lock; }
  ~TakingLock() { --taking_lock; }
  TakingLock(const TakingLock&) = delete;
  TakingLock& operator=(const TakingLock&) = delete;
};

void wait_for_exit() {
  while (true) std::this_thread::sleep_for(1000ms);
}

/// Runs with the lock, before Python ends.
void end() {
  constexpr auto patience = 2000ms;
  ending = true;
  const py::gil_scoped_release free;
  while (taking_lock > 0) std::this_thread::sleep_for(1ms);  // they get the lock now
  const auto begin = std::chrono::steady_clock::now();
  while (without_lock > 0 && std::chrono::steady_clock::now() - begin < patience) std::this_thread::sleep_for(1ms);
}

}  // namespace

WithoutLock::WithoutLock() : thread_(PyEval_SaveThread()) { ++without_lock; }

WithoutLock::~WithoutLock() {
  {
    const TakingLock taking;
    if (!ending) {
      PyEval_RestoreThread(thread_);
      --without_lock;
      return;
    }
  }
  --without_lock;
  wait_for_exit();
}

bool with_lock(bool (*work)()) {
  const TakingLock taking;
  if (ending) return true;
  const py::gil_scoped_acquire held;
  return work();
}

void watch_end() { py::module_::import("atexit").attr("register")(py::cpp_function(&end)); }

}  // namespace drape::python

namespace py = pybind11;

namespace drape::python {
namespace {

using Numbers = py::array_t<double, py::array::forcecast>;

/// Returns a copy of vertices that Python owns.
py::array copied(const Vertices& vertices) { return Mirror(vertices).array(); }

template <class T, std::size_t Columns>
py::array_t<T> copied(const std::vector<std::array<T, Columns>>& rows) {
  py::array_t<T> array({rows.size(), Columns});
  std::copy_n(reinterpret_cast<const T*>(rows.data()), rows.size() * Columns, array.mutable_data());
  return array;
}

Vertices vertices_of(const Numbers& numbers, const char* name) {
  if (numbers.ndim() != 2 || numbers.shape(1) != 3) {
    throw UsageError(fmt::format("{}: expected an array n×3, found {} dimensions", name, numbers.ndim()));
  }
  Vertices vertices(numbers.shape(0), 3);
  const auto at = numbers.unchecked<2>();
  for (py::ssize_t i = 0; i < numbers.shape(0); ++i) {
    for (py::ssize_t axis = 0; axis < 3; ++axis) vertices(i, axis) = at(i, axis);
  }
  if (!vertices.allFinite()) throw UsageError(fmt::format("{}: expected finite numbers", name));
  return vertices;
}

State make_state(const Numbers& positions, const Numbers& velocities, std::int64_t step) {
  State made;
  made.state = {vertices_of(positions, "positions"), vertices_of(velocities, "velocities"), step};
  if (made.state.x.rows() != made.state.v.rows()) {
    throw UsageError(fmt::format("velocities: expected {}, as there are positions, found {}", made.state.x.rows(),
                                 made.state.v.rows()));
  }
  if (step < 0) throw UsageError(fmt::format("step: expected at least 0, found {}", step));
  return made;
}

std::unique_ptr<SceneSimulation> make_simulation(const py::object& scene, const py::dict& set,
                                                 const std::filesystem::path& folder, int threads) {
  constexpr int most_threads = 256;  // same limit as on the command line
  if (threads < 1 || threads > most_threads) {
    throw UsageError(fmt::format("threads: expected a whole number from 1 to {}, found {}", most_threads, threads));
  }
  const std::vector<std::string> overrides = to_overrides(set);
  const auto make = [&](const auto& read) {
    try {
      const WithoutLock free;
      Scene made = read();
      made.simulation.threads = threads;
      return std::make_unique<SceneSimulation>(std::move(made));
    } catch (const Interrupted&) {
      throw py::error_already_set();
    }
  };
  if (py::isinstance<py::dict>(scene)) {
    TomlValue document = to_toml(scene);
    const std::filesystem::path name = folder.empty() ? "dictionary" : folder / "dictionary";
    return make([&] { return make_scene(std::move(document), name, overrides); });
  }
  if (!py::isinstance<py::str>(scene) && !py::hasattr(scene, "__fspath__")) {
    throw py::type_error(
        fmt::format("expected a scene's file or a dictionary, found {}", std::string(py::repr(scene))));
  }
  const auto file = scene.cast<std::filesystem::path>();
  return make([&] { return load_scene(file, overrides); });
}

}  // namespace

py::array Mirror::array() const {
  auto* shared = new std::shared_ptr<Vertices>(numbers_);
  const py::capsule owner(shared, [](void* held) { delete static_cast<std::shared_ptr<Vertices>*>(held); });
  const auto rows = static_cast<py::ssize_t>(numbers_->rows());
  constexpr py::ssize_t size = sizeof(double);
  py::array array(py::dtype::of<double>(), {rows, py::ssize_t{3}}, {size, rows * size}, numbers_->data(), owner);
  array.attr("flags").attr("writeable") = false;
  return array;
}

SceneSimulation::SceneSimulation(Scene scene)
    : scene_(std::move(scene)),
      simulation_(scene_.simulation, Timing::none, Stop([this] { return signalled(); })),
      positions_(simulation_.state().x),
      velocities_(simulation_.state().v) {}

std::unique_lock<std::mutex> SceneSimulation::wait() {
  const WithoutLock free;
  return std::unique_lock(mutex_);
}

void SceneSimulation::show() {
  positions_.show(simulation_.state().x);
  velocities_.show(simulation_.state().v);
}

bool SceneSimulation::signalled() {
  constexpr auto patience = std::chrono::milliseconds(50);  // delay before Ctrl-C takes effect
  const auto now = std::chrono::steady_clock::now();
  if (now - looked_ < patience) return false;
  looked_ = now;
  return with_lock([] { return PyErr_CheckSignals() != 0; });
}

StepReport SceneSimulation::step(std::int64_t count) {
  require_made();
  if (count < 0) throw UsageError(fmt::format("count: expected at least 0, found {}", count));
  const auto lock = wait();
  StepReport report;
  try {
    const WithoutLock free;
    for (std::int64_t done = 0; done < count; ++done) report = simulation_.step();
  } catch (const Interrupted&) {
    show();
    throw py::error_already_set();
  } catch (...) {
    show();
    throw;
  }
  show();
  return report;
}

void SceneSimulation::restore(const State& checkpoint) {
  require_made();
  checkpoint.require_made();
  const auto lock = wait();
  const Eigen::Index vertices = simulation_.state().x.rows();
  if (checkpoint.state.x.rows() != vertices) {
    throw UsageError(fmt::format("the state is of {} vertices, the cloth has {}", checkpoint.state.x.rows(), vertices));
  }
  if (checkpoint.energy_memory) {
    simulation_.restore(checkpoint);
  } else {
    simulation_.restore(checkpoint.state);
  }
  show();
}

namespace {

void add_results_of_steps(py::module_& module) {
  py::class_<StepReport>(module, "StepReport", "How a step was computed.")
      .def_readonly("iterations", &StepReport::iterations, "Linear solves; 0 for a method that has none.")
      .def_readonly("converged", &StepReport::converged, "True if the stopping rule was met within max_iterations.")
      .def_readonly("redone", &StepReport::redone,
                    "True if sdirk2 gained energy, so that backward Euler took the step instead.")
      .def_readonly("kept", &StepReport::kept, "Fraction of the path to the last iterate that the step kept, 0 to 1.")
      .def_readonly("substeps", &StepReport::substeps, "Number of substeps of the step.")
      .def_readonly("estimate", &StepReport::estimate,
                    "Estimated error that the step has added [m]; None unless the scene asks for an accuracy.")
      .def("__repr__", [](const StepReport& r) {
        return fmt::format("StepReport(iterations={}, converged={})", r.iterations, r.converged ? "True" : "False");
      });
  py::class_<Energies>(module, "Energies", "The energies of a cloth at one moment [J].")
      .def_readonly("kinetic", &Energies::kinetic, "Σ m v²/2 [J]")
      .def_readonly("gravity", &Energies::gravity, "−Σ m g·x [J]")
      .def_readonly("elastic", &Energies::elastic, "Energy of all springs and of bending [J].")
      .def_property_readonly("total", &Energies::total, "The sum of the three [J].")
      .def("__repr__", [](const Energies& e) {
        return fmt::format("Energies(kinetic={}, gravity={}, elastic={})", e.kinetic, e.gravity, e.elastic);
      });
}

void add_state(py::module_& module) {
  const auto made = [](const State& state) -> const State& { return state.require_made(), state; };
  py::class_<State>(module, "State", "All that the rest of a motion depends on, to the bit. A copy.")
      .def(py::init(&make_state), py::arg("positions"), py::arg("velocities"), py::arg("step") = 0,
           "Makes a state of positions n×3 [m] and velocities n×3 [m/s] after a number of steps.")
      .def_property_readonly(
          "positions", [=](const State& s) { return copied(made(s).state.x); }, "n×3 [m]")
      .def_property_readonly(
          "velocities", [=](const State& s) { return copied(made(s).state.v); }, "n×3 [m/s]")
      .def_property_readonly(
          "step", [=](const State& s) { return made(s).state.step; }, "Number of steps before it.")
      .def_property_readonly(
          "hash", [=](const State& s) { return hash_of(made(s).state); }, "As Simulation.hash.");
}

using Self = SceneSimulation;

const SimulationSettings& settings(const Self& self) { return self.scene().simulation; }

void add_motion(py::class_<Self>& simulation) {
  simulation
      .def(py::init(&make_simulation), py::arg("scene"), py::arg("set") = py::dict(), py::arg("folder") = "",
           py::arg("threads") = 1,
           "Reads a scene: a TOML file, or a dictionary of the same tables, whose files are looked for in `folder`.\n\n"
           "`set` replaces values, {\"cloth.stiffness\": 300}, as --set does on the command line.\n"
           "`threads` share a step where the cloth has 8192 vertices or more, with the same bits for any number.\n"
           "Raises UsageError, whose message lists every problem.")
      .def("step", &Self::step, py::arg("count") = 1,
           "Takes steps and returns the last one's report. Other Python threads run meanwhile, and Ctrl-C ends it "
           "after a "
           "whole step.\n\nRaises DivergedError if the motion blows up.")
      .def_property_readonly("positions", &Self::positions,
                             "n×3 [m], read-only: an array that shows where the cloth is after each step().")
      .def_property_readonly("velocities", &Self::velocities, "n×3 [m/s], read-only, likewise.")
      .def_property_readonly(
          "time", [](Self& self) { return self.with([](auto& s) { return s.time(); }); }, "[s]")
      .def_property_readonly(
          "steps_taken", [](Self& self) { return self.with([](auto& s) { return s.state().step; }); },
          "Number of steps taken.")
      .def_property_readonly(
          "energies", [](Self& self) { return self.with([](auto& s) { return s.energies(); }); },
          "Kinetic, of gravity and elastic [J].")
      .def_property_readonly(
          "residual", [](Self& self) { return self.with([](auto& s) { return s.residual(); }); },
          "‖∇g‖ where the last step ended [N]; 0 for a method that minimises nothing.")
      .def_property_readonly(
          "error", [](Self& self) { return self.with([](auto& s) { return s.error(); }); },
          "Estimated distance of the worst vertex from the exact solution of the last step [m].")
      .def_property_readonly(
          "hash", [](Self& self) { return self.with([](auto& s) { return s.hash(); }); },
          "Hash of step, positions and velocities to the bit: 64 bits, the same on every run and machine of a build.")
      .def(
          "state", [](Self& self) { return self.with([](auto& s) { return State(s.checkpoint()); }); },
          "A copy of all that the rest of the motion depends on.")
      .def("restore", &Self::restore, py::arg("state"), "Goes on from a state of the same cloth, at any step.");
}

void add_description(py::class_<Self>& simulation) {
  simulation
      .def_property_readonly(
          "step_size", [](Self& self) { return settings(self).step; }, "h [s]")
      .def_property_readonly(
          "step_count", [](Self& self) { return self.scene().step_count(); },
          "Number of steps that cover the scene's duration.")
      .def_property_readonly(
          "duration", [](Self& self) { return self.scene().duration; }, "Duration of the scene [s].")
      .def_property_readonly(
          "method", [](Self& self) { return step_method_name(settings(self).integrator.step_method()); },
          "\"liu13\", \"implicit-sdirk2\", …")
      .def_property_readonly(
          "name", [](Self& self) { return self.scene().name; }, "The file's, without its ending.")
      .def_property_readonly(
          "triangles", [](Self& self) { return copied(settings(self).cloth.triangles); },
          "m×3 numbers of vertices, counterclockwise seen from the front. A copy.")
      .def_property_readonly(
          "cloths",
          [](Self& self) {
            py::dict cloths;
            for (const ClothPiece& piece : settings(self).cloth.pieces) {
              const py::ssize_t first = piece.first_vertex;
              cloths[py::str(piece.name)] = py::slice(first, first + piece.vertex_count, 1);
            }
            return cloths;
          },
          "The vertices of each named cloth, as a slice: positions[cloths[\"napkin\"]].")
      .def_property_readonly(
          "rest", [](Self& self) { return copied(settings(self).cloth.rest); },
          "The shape without strain, n×3 [m]. A copy.")
      .def_property_readonly(
          "masses",
          [](Self& self) {
            return py::array_t<double>(settings(self).cloth.masses.size(), settings(self).cloth.masses.data());
          },
          "Masses of the vertices, n [kg]. A copy.")
      .def_property_readonly(
          "pins", [](Self& self) { return self.with([](auto& s) { return s.cloth().pins; }); },
          "The vertices that do not move by themselves, as of the last step.")
      .def("__repr__", [](Self& self) {
        return fmt::format("<drape.Simulation of {} at {:g} s, {} vertices, {}>", self.scene().name,
                           self.with([](auto& s) { return s.time(); }), settings(self).cloth.vertex_count(),
                           step_method_name(settings(self).integrator.step_method()));
      });
}

}  // namespace

void add_simulation(py::module_& module) {
  add_results_of_steps(module);
  add_state(module);
  py::class_<Self> simulation(module, "Simulation", "A scene in motion.");
  add_motion(simulation);
  add_description(simulation);
}

}  // namespace drape::python
