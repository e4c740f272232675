// Measures the speedup by threads: bench/drape_threads [CELLS…], as Markdown. Times are wall times, so the machine must
// be idle. Each is the least of several rounds, in which the numbers of threads alternate.

#include <fmt/format.h>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <numeric>
#include <random>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "bench/moving_cloth.hpp"
#include "drape/sim/effects/acceleration.hpp"
#include "drape/sim/effects/self_collision.hpp"
#include "drape/sim/simulation.hpp"
#include "sim/parallel/vectors.hpp"

namespace drape {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int fewest_rounds = 9;
constexpr double shortest = 2;  // least total time of all rounds [s]
constexpr double turn = 0.05;   // time of one number of threads per round, long enough to wake all of them [s]

/// Measures the wall time of a call [s].
double seconds_of(const auto& run) {
  const auto begin = Clock::now();
  run();
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

/// Returns 1, 2, 4, … and the number of hardware threads.
std::vector<int> thread_counts() {
  const int all = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  std::vector<int> counts;
  for (int count = 1; count < all; count *= 2) counts.push_back(count);
  counts.push_back(all);
  return counts;
}

/// Formats a row of the table: the least time by each number of threads, and the speedups.
std::string row(const std::string& name, const std::vector<double>& seconds, int batch) {
  std::string text = fmt::format("| {} |", name);
  for (const double each : seconds) text += fmt::format(" {:.4g} |", 1e6 * each / batch);
  for (std::size_t k = 1; k < seconds.size(); ++k) text += fmt::format(" {:.2f} |", seconds.front() / seconds[k]);
  return text;
}

/// @param make makes the function to time, for a number of threads
template <class Make>
std::vector<double> measure(const Make& make) {
  std::vector<decltype(make(1))> subjects;
  for (const int count : thread_counts()) subjects.push_back(make(count));
  std::vector<double> least(subjects.size(), 1e9);
  const auto begin = Clock::now();
  const auto elapsed = [&] { return std::chrono::duration<double>(Clock::now() - begin).count(); };
  for (int round = 0; round < fewest_rounds || elapsed() < shortest; ++round) {
    for (std::size_t k = 0; k < subjects.size(); ++k) {
      const auto begun = Clock::now();
      do {
        least[k] = std::min(least[k], seconds_of(subjects[k]));
      } while (std::chrono::duration<double>(Clock::now() - begun).count() < turn);
    }
  }
  return least;
}

/// Shuffles vertex numbers among nearby vertices, as in a mesh from another program: the cloth has no regular pattern
/// of springs.
Cloth irregular(Cloth cloth) {
  constexpr std::size_t nearby = 1000;
  std::vector<int> places(static_cast<std::size_t>(cloth.vertex_count()));
  std::iota(places.begin(), places.end(), 0);
  std::mt19937 random(1);  // NOLINT(cert-msc51-cpp): the same cloth every time
  for (std::size_t first = 0; first < places.size(); first += nearby) {
    const auto begin = places.begin() + static_cast<std::ptrdiff_t>(first);
    std::shuffle(begin, begin + static_cast<std::ptrdiff_t>(std::min(nearby, places.size() - first)), random);
  }
  const auto place = [&](int vertex) { return places[static_cast<std::size_t>(vertex)]; };
  const Vertices positions = cloth.positions, velocities = cloth.velocities, rest = cloth.rest;
  for (int v = 0; v < cloth.vertex_count(); ++v) {
    cloth.positions.row(place(v)) = positions.row(v);
    cloth.velocities.row(place(v)) = velocities.row(v);
    cloth.rest.row(place(v)) = rest.row(v);
  }
  for (Triangle& triangle : cloth.triangles) {
    for (int& vertex : triangle) vertex = place(vertex);
  }
  for (Spring& spring : cloth.springs) {
    const auto [i, j] = std::minmax({place(spring.i), place(spring.j)});
    spring.i = i;
    spring.j = j;
  }
  for (int& pin : cloth.pins) pin = place(pin);
  std::ranges::sort(cloth.pins);
  return cloth;
}

struct Case {
  const char* name;
  Method method;
  int batch;  ///< iterations of its one step, or steps of a method without iterations
  bool irregular = false;
  LinearSolver linear_solver = LinearSolver::automatic;
};
constexpr Case cases[] = {
    {"semi-implicit step", Method::semi_implicit, 100},
    {"liu13 iteration", Method::liu13, 20},
    {"quasi-newton iteration", Method::quasi_newton, 20},
    {"implicit iteration by conjugate gradients", Method::implicit, 1, false, LinearSolver::conjugate_gradients},
    {"semi-implicit step, irregular mesh", Method::semi_implicit, 100, true},
    {"liu13 iteration, irregular mesh", Method::liu13, 20, true}};

std::string row_of(const Case& c, int cells) {
  SimulationSettings settings{.cloth = make_moving_cloth(cells), .effects = {Gravity{}}};
  if (c.irregular) settings.cloth = irregular(std::move(settings.cloth));
  settings.step = c.method == Method::semi_implicit ? 0.02 / cells : 0.02;
  // No iteration meets this tolerance.
  settings.integrator = {.method = c.method,
                         .stop = StoppingRule::change,
                         .tolerance = 0,
                         .max_iterations = c.batch,
                         .linear_solver = c.linear_solver};
  const std::vector<double> seconds = measure([&](int threads) {
    settings.threads = threads;
    const auto simulation = std::make_shared<Simulation>(settings);
    return [simulation, start = simulation->state(), steps = c.method == Method::semi_implicit ? c.batch : 1] {
      simulation->restore(start);
      for (int step = 0; step < steps; ++step) simulation->step();
    };
  });
  return row(fmt::format("{}, {}²", c.name, cells), seconds, c.batch);
}

/// A step of liu13 with one iteration, with an obstacle that the cloth touches.
struct Touch {
  const char* name;
  Effect with;
  Cloth (*cloth)(int cells);
};

std::vector<Touch> touches() {
  return {{"step of one iteration", Gravity{}, make_folded_cloth},
          {"the same, folded on itself", SelfCollision{.thickness = 0.012}, make_folded_cloth},
          {"the same, on a body", make_cushion(), make_lying_cloth}};
}

std::string row_of(const Touch& touch, int cells) {
  SimulationSettings settings{.cloth = touch.cloth(cells), .effects = {touch.with}};
  settings.step = 0.01;
  settings.integrator = {.method = Method::liu13, .stop = StoppingRule::change, .tolerance = 0, .max_iterations = 1};
  const std::vector<double> seconds = measure([&](int threads) {
    settings.threads = threads;
    const auto simulation = std::make_shared<Simulation>(settings);
    return [simulation, start = simulation->state()] {
      simulation->restore(start);
      simulation->step();
    };
  });
  return row(fmt::format("{}, {}²", touch.name, cells), seconds, 1);
}

std::string row_of_forks() {
  constexpr int forks = 100;
  return row("dividing an empty loop", measure([](int count) {
               return [threads = std::make_shared<Threads>(count), count] {
                 for (int i = 0; i < forks; ++i) threads->for_each(count, [](int) {});
               };
             }),
             forks);
}

std::string row_of_memory() {
  constexpr Eigen::Index vertices = 8'000'000;
  const auto numbers = std::make_shared<Vertices>(Vertices::Constant(vertices, 3, 0.5));
  constexpr int megabytes = vertices * 3 * 8 / 1'000'000;
  return row("reading 1 MB of 192", measure([&](int count) {
               return [threads = std::make_shared<Threads>(count), numbers] {
                 if (dot(*threads, *numbers, *numbers) == 0) std::abort();
               };
             }),
             megabytes);
}

}  // namespace
}  // namespace drape

int main(int argc, char** argv) {
  using namespace drape;
  std::string head = "| µs |", line = "|---|";
  for (const int count : thread_counts()) head += fmt::format(" {} thread{} |", count, count == 1 ? "" : "s");
  for (std::size_t k = 1; k < thread_counts().size(); ++k) head += fmt::format(" 1 ÷ {} |", thread_counts()[k]);
  for (std::size_t k = 1; k < 2 * thread_counts().size(); ++k) line += "---|";
  fmt::print("{}\n{}\n{}\n{}\n", head, line, row_of_forks(), row_of_memory());
  std::vector<int> sizes;
  for (int i = 1; i < argc; ++i) sizes.push_back(std::atoi(argv[i]));
  if (sizes.empty()) sizes = {20, 100, 300};
  for (const int cells : sizes) {
    for (const Case& c : cases) {
      fmt::print("{}\n", row_of(c, cells));
      std::fflush(stdout);
    }
    for (const Touch& touch : touches()) {
      fmt::print("{}\n", row_of(touch, cells));
      std::fflush(stdout);
    }
  }
}
