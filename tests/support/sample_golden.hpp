#pragma once

#include <algorithm>
#include <random>

#include "check/golden.hpp"

namespace drape::test {

/// Makes a golden of random numbers, rounded to its own precision.
inline Golden sample_golden(int vertices, std::int64_t steps, std::int64_t window_steps,
                            const std::vector<int>& frames) {
  std::mt19937 generator(17);
  std::uniform_real_distribution<double> uniform(-2, 2);
  Golden golden;
  golden.scene_digest = "0123456789abcdef";
  golden.date = "2026-01-31T12:00:00Z";
  golden.machine.renderer = "llvmpipe \"256 bits\"";
  golden.size = {32, 24};
  golden.step = 0.02;
  golden.step_count = steps;
  golden.window_steps = window_steps;
  golden.vertex_count = vertices;
  golden.row = 4;
  golden.body_count = 7;
  golden.group_count = 2;
  golden.seconds_per_frame = 0.04;
  golden.film = {.fps = 12.5, .speed = 0.5, .size = {640, 480}, .samples = 2};
  if (steps > 0) golden.time = {.steps = std::min<std::int64_t>(20, steps), .ratio = 123.5};
  golden.quanta = {0x1p-29, 0x1p-25, 0x1p-24};
  const auto random = [&](double quantum) {
    const Vertices any = Vertices::NullaryExpr(vertices, 3, [&] { return uniform(generator); });
    return rounded(any, quantum);
  };
  const std::vector<std::int64_t> starts = window_starts(steps, window_steps);
  for (std::size_t i = 0; i < starts.size(); ++i) {
    const bool last = i + 1 == starts.size();
    const RoundingUnits quanta = last ? golden.quanta.at_end() : golden.quanta;
    GoldenWindow& window = golden.windows.emplace_back();
    window.start = {random(quanta.position), random(quanta.velocity), starts[i]};
    window.start.x(vertices / 2, 1) = 1 / 3.0;  // a pin
    window.energies = {.kinetic = uniform(generator), .gravity = -1 / 3., .elastic = 1e-17};
    const std::int64_t count = last ? 0 : starts[i + 1] - starts[i];
    if (count > 1) window.middle = random(golden.quanta.compared);
    for (std::int64_t k = 0; k < count; ++k) {
      GoldenStep& step = window.steps.emplace_back();
      step.hash = static_cast<std::uint32_t>(generator());
      for (int body = 0; body < golden.body_count; ++body) step.bodies.push_back(uniform(generator));
      step.bodies = rounded(step.bodies, golden.quanta.compared);
      for (int number = 0; number < 3 * golden.group_count; ++number) step.groups.push_back(uniform(generator));
      step.groups = rounded(step.groups, golden.quanta.compared);
    }
  }
  for (const int frame : frames) {
    golden.frames.push_back({.frame = frame, .time = 0.04 * frame, .why = "the start", .x = random(0x1p-29)});
    golden.frames.back().view.position = {1.0 / 7, 0, 3.0 + frame};
  }
  return golden;
}

}  // namespace drape::test
