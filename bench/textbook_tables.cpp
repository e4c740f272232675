// Recomputes the homework's tables with the textbook methods and prints their iteration counts beside the homework's.

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "bench/textbook.hpp"

namespace drape::textbook {
namespace {

using Make = std::unique_ptr<Stepper> (*)(const Cloth&, const Settings&);

constexpr int timeline = 417;  // steps of 0.02 s: the homework's 250 time codes at 30 per second
constexpr std::array tolerances{1.0, 1e-1, 1e-2, 1e-3, 1e-4, 1e-5};

Cloth homework_cloth(double stiffness) {
  const Mesh grid = make_grid(20, 20);
  return make_cloth(grid, grid, 1.0, stiffness, {0, 20});
}

struct Motion {
  double mean_iterations = 0;
  double nearest = std::numeric_limits<double>::infinity();  ///< least distance of any vertex from the sphere's centre
                                                             ///< in all steps [m]
  std::vector<double> gradient_norms;                        ///< at the end of each step, ascending [N]
  std::vector<Eigen::RowVector3d> last_vertex;               ///< after each step [m]
};

Motion run(Make make, double stiffness, const Settings& settings, int steps) {
  const Cloth cloth = homework_cloth(stiffness);
  const auto stepper = make(cloth, settings);
  Motion motion;
  for (int s = 0; s < steps; ++s) {
    stepper->step();
    motion.mean_iterations += stepper->iterations / static_cast<double>(steps);
    motion.gradient_norms.push_back(gradient_norm(cloth, settings, *stepper));
    motion.last_vertex.emplace_back(stepper->positions.row(stepper->positions.rows() - 1));
    const Eigen::RowVector3d center = settings.sphere.value_or(Sphere{}).center.transpose();
    motion.nearest = std::min(motion.nearest, (stepper->positions.rowwise() - center).rowwise().norm().minCoeff());
  }
  std::sort(motion.gradient_norms.begin(), motion.gradient_norms.end());
  return motion;
}

std::string position_after(const Motion& motion, int steps) {
  const Eigen::RowVector3d& p = motion.last_vertex[static_cast<std::size_t>(steps - 1)];
  return fmt::format("({:.9f}, {:.9f}, {:.9f})", p[0], p[1], p[2]);
}

void print_positions(const std::string& name, const Motion& motion) {
  fmt::print("{}: vertex 440 after 10 steps {}, 50 {}, 417 {}\n", name, position_after(motion, 10),
             position_after(motion, 50), position_after(motion, timeline));
}

void print_table_1() {
  fmt::print("\n## Table 1: no sphere, k = 18, eps = 1e-3\n\n| method | mean iterations | homework |\n|---|---|---|\n");
  const Motion liu13 = run(make_liu13, 18, {}, timeline);
  const Motion newton = run(make_newton, 18, {}, timeline);
  const Motion scaled = run(make_newton, 18, {.compressed = CompressedHessian::scaled}, timeline);
  fmt::print("| liu13 | {:.5f} | 7.240 |\n", liu13.mean_iterations);
  fmt::print("| implicit, projected | {:.5f} | 3.29087 |\n", newton.mean_iterations);
  fmt::print("| implicit, scaled | {:.5f} | 3.29087 |\n\n", scaled.mean_iterations);
  print_positions("liu13", liu13);
  print_positions("implicit, projected", newton);
  print_positions("implicit, scaled", scaled);
}

void print_table_2() {
  fmt::print("\n## Table 2: with the sphere, k = 180, eps = 1e-3\n\n");
  fmt::print(
      "| method | steps | mean iterations | homework | nearest to the sphere's centre [m] |\n|---|---|---|---|---|\n");
  const auto row = [](const std::string& name, Make make, const Settings& settings, int steps, const char* homework) {
    const Motion motion = run(make, 180, settings, steps);
    fmt::print("| {} | {} | {:.5f} | {} | {:.4f} |\n", name, steps, motion.mean_iterations, homework, motion.nearest);
  };
  row("liu13", make_liu13, {.sphere = Sphere{}}, timeline, "39.10");
  row("implicit, projected", make_newton, {.sphere = Sphere{}}, 167, "7.07 to 8.59");
  row("implicit, scaled", make_newton, {.sphere = Sphere{}, .compressed = CompressedHessian::scaled}, 167,
      "7.07 to 8.59");
}

/// Prints the residuals at which Newton's method stops: the targets for comparable solvers.
void print_gradient_norms(const std::string& name, const Motion& motion) {
  double sum = 0;
  for (const double norm : motion.gradient_norms) sum += norm;
  const std::size_t count = motion.gradient_norms.size();
  fmt::print("{}: ||grad g|| at the end of a step [N]: mean {:.4g}, median {:.4g}, largest {:.4g}\n", name,
             sum / static_cast<double>(count), motion.gradient_norms[count / 2], motion.gradient_norms.back());
}

void print_table_3() {
  fmt::print("\n## Table 3: no sphere, k = 180\n\n");
  fmt::print(
      "| eps | liu13 | homework | implicit, projected | implicit, scaled | homework |\n|---|---|---|---|---|---|\n");
  constexpr std::array liu13_homework{2.0, 2.0, 2.295, 9.307, 52.12, 99.64};
  constexpr std::array newton_homework{2.0, 2.00719, 2.98561, 3.71703, 5.0, 7.29496};
  std::array<Motion, 6> liu13, newton, scaled;
  for (std::size_t i = 0; i < tolerances.size(); ++i) {
    const double tolerance = tolerances[i];
    liu13[i] = run(make_liu13, 180, {.tolerance = tolerance}, timeline);
    newton[i] = run(make_newton, 180, {.tolerance = tolerance}, timeline);
    scaled[i] = run(make_newton, 180, {.tolerance = tolerance, .compressed = CompressedHessian::scaled}, timeline);
    fmt::print("| {:g} | {:.5f} | {} | {:.5f} | {:.5f} | {} |\n", tolerance, liu13[i].mean_iterations,
               liu13_homework[i], newton[i].mean_iterations, scaled[i].mean_iterations, newton_homework[i]);
  }
  fmt::print("\n");
  for (const std::size_t i : {3u, 5u}) {
    const std::string suffix = fmt::format(", eps = {:g}", tolerances[i]);
    print_positions("liu13" + suffix, liu13[i]);
    print_positions("implicit, projected" + suffix, newton[i]);
    print_gradient_norms("implicit, projected" + suffix, newton[i]);
    print_gradient_norms("implicit, scaled" + suffix, scaled[i]);
  }
}

void print_gradient_norms_with_sphere() {
  fmt::print("\n## With the sphere, k = 180, 417 steps\n\n");
  for (const double tolerance : {1e-3, 1e-5}) {
    for (const auto compressed : {CompressedHessian::projected, CompressedHessian::scaled}) {
      const Settings settings{.sphere = Sphere{}, .tolerance = tolerance, .compressed = compressed};
      const Motion motion = run(make_newton, 180, settings, timeline);
      const char* name = compressed == CompressedHessian::projected ? "projected" : "scaled";
      print_gradient_norms(
          fmt::format("implicit, {}, eps = {:g}, {:.5f} iterations", name, tolerance, motion.mean_iterations), motion);
    }
  }
}

void print_energy_log() {
  fmt::print("\n## Energy log: semi-implicit, h = 0.001, k = 180, no damping [J]\n\n");
  fmt::print(
      "| step | total | kinetic | gravity | elastic | homework's elastic, in double |\n|---|---|---|---|---|---|\n");
  constexpr std::array<std::pair<int, const char*>, 6> rows{{{1, "9.34e-17"},
                                                             {5, "4.17e-12"},
                                                             {10, "6.002e-10"},
                                                             {13, "4.016e-09"},
                                                             {16, "1.8284e-08"},
                                                             {20, "9.43816e-08"}}};
  const Settings settings{.step = 0.001};
  const Cloth cloth = homework_cloth(180);
  const auto stepper = make_semi_implicit(cloth, settings);
  int steps = 0;
  for (const auto& [row, homework] : rows) {
    for (; steps < row; ++steps) stepper->step();
    const Energies e = energies(cloth, settings, *stepper);
    fmt::print("| {} | {:.6g} | {:.6g} | {:.6g} | {:.6g} | {} |\n", row, e.total(), e.kinetic, e.gravity, e.elastic,
               homework);
  }
}

}  // namespace
}  // namespace drape::textbook

int main() {
  fmt::print(
      "The homework's 20x20 cloth by the textbook methods. h = 0.02 s and 417 steps where nothing else is said.\n");
  drape::textbook::print_energy_log();
  drape::textbook::print_table_1();
  drape::textbook::print_table_2();
  drape::textbook::print_table_3();
  drape::textbook::print_gradient_norms_with_sphere();
}
