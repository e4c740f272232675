#include "study/homework_cases.hpp"

#include <utility>

namespace drape {
namespace {

// Numbers of steps in the whole timeline, 250/30 s, for both step lengths.
constexpr std::int64_t steps = 417, small_steps = 8334;
// The report evaluates the first 167 steps of the implicit method with the sphere.
constexpr std::int64_t sphere_steps = 167;

constexpr const char* semi = "scenes/homework/1.toml";      // k = 18, damping 0.2
constexpr const char* newton18 = "scenes/homework/2.toml";  // implicit, k = 18
constexpr const char* newton = "scenes/homework/3.toml";    // implicit, k = 180
constexpr const char* liu1800 = "scenes/homework/4.toml";   // liu13, k = 1800
constexpr const char* sphere = "scenes/homework/5.toml";    // liu13, k = 180, sphere

HomeworkRow row(int table, const std::string& method, double step, const std::string& tolerance, Reported reported,
                const char* scene, std::vector<std::string> overrides, std::int64_t count) {
  std::string label = method;
  if (!tolerance.empty()) label += ", ε = " + tolerance;
  return {table, method, step, tolerance, reported, {std::move(label), scene, std::move(overrides), count}};
}

}  // namespace

std::vector<HomeworkRow> homework_rows() {
  std::vector<HomeworkRow> rows;
  rows.push_back(row(1, "semi-implicit", 0.001, "", {{}, {}, 27.68}, semi, {}, small_steps));
  rows.push_back(row(1, "implicit", 0.02, "1e-3", {3.29087, 3.2926, 11863.7}, newton18, {}, steps));
  rows.push_back(row(1, "liu13", 0.02, "1e-3", {6.19664, 7.1966, 498.456}, newton18,
                     {"integrator.method=liu13", "integrator.max_iterations=100"}, steps));

  rows.push_back(row(2, "semi-implicit", 0.001, "", {{}, {}, 29.63}, sphere,
                     {"integrator.method=semi-implicit", "time.step=0.001", "effects.damping.factor=0.2"},
                     small_steps));
  rows.push_back(row(2, "implicit", 0.02, "1e-3", {7.06966, 8.59, 24222.8}, sphere,
                     {"integrator.method=implicit", "integrator.max_iterations=20"}, sphere_steps));
  rows.push_back(row(2, "liu13", 0.02, "1e-3", {38.9329, 39.10, 2227.29}, sphere, {}, steps));

  struct Line {
    const char* tolerance;
    Reported implicit, liu13;
  };
  const std::array<Line, 6> lines{{{"1", {2, 2, 7244.6}, {2, 2, 202.981}},
                                   {"1e-1", {2.00719, 2.0072, 7396.92}, {2, 2, 198.715}},
                                   {"1e-2", {2.98561, 2.9856, 10210.5}, {2.18465, 2.1847, 213.396}},
                                   {"1e-3", {3.71703, 3.7122, 13196.2}, {9.09113, 9.0887, 619.432}},
                                   {"1e-4", {5, 5.0048, 18122.2}, {54.6866, 51.9976, 3015.32}},
                                   {"1e-5", {7.29496, 7.3070, 25914.2}, {100.892, 99.9, 5941.71}}}};
  for (const Line& l : lines) {
    rows.push_back(row(3, "implicit", 0.02, l.tolerance, l.implicit, newton,
                       {std::string("integrator.tolerance=") + l.tolerance}, steps));
  }
  for (const Line& l : lines) {
    rows.push_back(row(3, "liu13", 0.02, l.tolerance, l.liu13, liu1800,
                       {"cloth.stiffness=180", std::string("integrator.tolerance=") + l.tolerance}, steps));
  }
  return rows;
}

std::vector<StudyCase> homework_extras() {
  return {{"semi-implicit, undamped", semi, {"effects.damping.factor=1"}, small_steps},
          {"semi-implicit, half the step", semi, {"time.step=0.0005"}, 2 * small_steps},
          {"semi-implicit, k = 180", semi, {"cloth.stiffness=180"}, small_steps}};
}

StudyCase homework_energy_case() {
  return {"semi-implicit, k = 180, undamped", semi, {"cloth.stiffness=180", "effects.damping.factor=1"}, 20};
}

}  // namespace drape
