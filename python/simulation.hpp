#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <chrono>
#include <cstdlib>
#include <memory>
#include <mutex>
#include <new>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "drape/scene/document.hpp"
#include "drape/scene/scene.hpp"
#include "drape/sim/simulation.hpp"
#include "drape/sim/state.hpp"

namespace drape::python {

/// Converts a dictionary, list, number, string, truth value or path to the value in a scene file; numpy's numbers and
/// arrays become plain ones, tuples arrays.
/// @throws pybind11::type_error naming the key of any other value, or of one nested deeper than any scene
TomlValue to_toml(const pybind11::handle& value, const std::string& name = "", int depth = 0);

/// Converts {"cloth.stiffness": 300} to overrides of the command line, "cloth.stiffness=300".
std::vector<std::string> to_overrides(const pybind11::dict& set);

/// Releases Python's lock during its lifetime, as pybind11::gil_scoped_release, also in a thread that outlives Python.
/// An ending interpreter kills threads that retake the lock in the middle of C++, which aborts the process. Such a
/// thread waits here until the process is over.
class WithoutLock {
 public:
  WithoutLock();
  ~WithoutLock();
  WithoutLock(const WithoutLock&) = delete;
  WithoutLock& operator=(const WithoutLock&) = delete;

 private:
  PyThreadState* thread_;
};

/// Calls work() with Python's lock, on a thread that has released it.
/// @returns its result; true, without a call, if Python ends
bool with_lock(bool (*work)());

/// Makes the end of Python wait for all computing threads, for two seconds at most.
void watch_end();

/// A read-only n×3 array for Python with its own memory: it lives while Python refers to it, and shows the last values
/// stored in it. A view of the simulation's own vectors would dangle, because schemes exchange them.
class Mirror {
 public:
  explicit Mirror(const Vertices& now) : numbers_(std::make_shared<Vertices>(now)) {}
  /// Stores other values of the same number.
  void show(const Vertices& now) { *numbers_ = now; }
  [[nodiscard]] pybind11::array array() const;

 private:
  std::shared_ptr<Vertices> numbers_;
};

/// Base of objects that Python can create by __new__ alone, which only allocates: the memory starts with zeros, so a
/// missing __init__ is detected.
class Made {
 public:
  /// @throws pybind11::type_error
  void require_made() const {
    if (!made_) throw pybind11::type_error("__init__() has not been called");
  }

  static void* operator new(std::size_t size) {
    void* const zeros = std::calloc(1, size);
    if (zeros == nullptr) throw std::bad_alloc();
    return zeros;
  }
  static void* operator new(std::size_t, void* place) { return place; }
  static void operator delete(void* memory) { std::free(memory); }

 private:
  bool made_ = true;
};

/// The Python class drape.State.
struct State : Made, Simulation::Checkpoint {
  State() = default;
  explicit State(Simulation::Checkpoint checkpoint) : Simulation::Checkpoint(std::move(checkpoint)) {}
};

/// The Python class drape.Simulation: a scene in motion. Any thread may call it; while one computes, without Python's
/// lock, others wait.
class SceneSimulation : public Made {
 public:
  explicit SceneSimulation(Scene scene);

  /// Takes steps and regularly checks Python for signals; a signal ends it after the last whole step.
  StepReport step(std::int64_t count);
  void restore(const State& checkpoint);

  /// Calls use(simulation) while no other thread does.
  template <class Use>
  auto with(const Use& use) {
    require_made();
    const auto lock = wait();
    try {
      return use(simulation_);
    } catch (const Interrupted&) {
      throw pybind11::error_already_set();
    }
  }

  [[nodiscard]] const Scene& scene() const { return require_made(), scene_; }
  [[nodiscard]] pybind11::array positions() const { return require_made(), positions_.array(); }
  [[nodiscard]] pybind11::array velocities() const { return require_made(), velocities_.array(); }

 private:
  /// Waits for the mutex without Python's lock, which the computing thread may need.
  std::unique_lock<std::mutex> wait();
  void show();
  /// Returns true if Python has handled a signal with an exception, which is then set; checks every 50 ms.
  bool signalled();

  std::mutex mutex_;
  Scene scene_;
  std::chrono::steady_clock::time_point looked_ =
      std::chrono::steady_clock::now();  // time of the last check for signals
  Simulation simulation_;
  Mirror positions_, velocities_;
};

/// Overrides of the scene's [camera] and [video].
struct PictureWishes {
  std::optional<std::array<int, 2>> size;                   ///< [pixels]
  std::optional<std::array<double, 3>> position, target;    ///< [m]
  std::optional<double> azimuth, elevation, field_of_view;  ///< [degrees]
  std::optional<std::string> color_by;                      ///< stretch, speed or curvature
  std::optional<double> color_limit;                        ///< value of the last colour, in the unit of color_by
};

/// Draws the current cloth: height×width×3 bytes.
pybind11::array render(SceneSimulation& simulation, const PictureWishes& wishes);

/// Adds the class Simulation and the classes of its results to the module.
void add_simulation(pybind11::module_& module);

}  // namespace drape::python
