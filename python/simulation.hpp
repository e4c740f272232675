#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <chrono>
#include <cstdlib>
#include <memory>
#include <mutex>
#include <new>
#include <optional>
#include <utility>

#include "scene/scene.hpp"
#include "sim/frame.hpp"
#include "sim/simulation.hpp"

namespace drape::python {

/// An array n×3 that Python sees and cannot write, with numbers of its own: it lives as long as anybody looks at it,
/// and shows what was last put into it. Schemes exchange their vectors, so a look at a simulation's own would dangle.
class Mirror {
 public:
  explicit Mirror(const Vertices& now) : numbers_(std::make_shared<Vertices>(now)) {}
  /// Puts other numbers into it, as many.
  void show(const Vertices& now) { *numbers_ = now; }
  [[nodiscard]] pybind11::array array() const;

 private:
  std::shared_ptr<Vertices> numbers_;
};

/// An object that Python can have without having made it, by __new__ alone: pybind11 only allocates it then. So its
/// memory begins with zeros, and it knows.
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

/// What Python sees as drape.State.
struct State : Made, Simulation::Checkpoint {
  State() = default;
  explicit State(Simulation::Checkpoint checkpoint) : Simulation::Checkpoint(std::move(checkpoint)) {}
};

/// What Python sees as drape.Simulation: a scene in motion. Any thread may call it; while one computes, without
/// Python's lock, others wait.
class SceneSimulation : public Made {
 public:
  explicit SceneSimulation(Scene scene);

  /// Takes steps, and looks from time to time whether Python has a signal to handle: that ends it with the last whole
  /// step.
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
  /// Waits without Python's lock: who computes may need it to go on.
  std::unique_lock<std::mutex> wait();
  void show();
  /// Whether Python has handled a signal with an exception, which is then set; looked at every 50 ms.
  bool signalled();

  std::mutex mutex_;
  Scene scene_;
  std::chrono::steady_clock::time_point looked_ = std::chrono::steady_clock::now();  // for a signal
  Simulation simulation_;
  Mirror positions_, velocities_;
};

/// Where the picture is taken from, in place of what the scene's [camera] and [video] say.
struct PictureWishes {
  std::optional<std::array<int, 2>> size;                   ///< [pixels]
  std::optional<std::array<double, 3>> position, target;    ///< [m]
  std::optional<double> azimuth, elevation, field_of_view;  ///< [degrees]
  std::optional<std::string> color_by;                      ///< stretch, speed or curvature
  std::optional<double> color_limit;                        ///< of the last colour, in the unit of color_by
};

/// Draws the cloth as it is now: height×width×3 bytes.
pybind11::array render(SceneSimulation& simulation, const PictureWishes& wishes);

/// Adds the class Simulation, and what it returns, to the module.
void add_simulation(pybind11::module_& module);

}  // namespace drape::python
