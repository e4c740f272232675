#include "check/golden_mismatch.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <vector>

#include "check/record_motion.hpp"

namespace drape {
namespace {

/// Returns "half the speed", "twice the speed", "0.8 of the speed".
std::string speed_in_words(double ratio) {
  if (ratio == 0.5) return "half the speed";
  if (ratio == 2) return "twice the speed";
  return ratio > 1 ? fmt::format("{:.3g} times the speed", ratio) : fmt::format("{:.3g} of the speed", ratio);
}

}  // namespace

std::string motion_mismatch(const Scene& scene, const Golden& golden) {
  if (const int count = scene.simulation.cloth.vertex_count(); count != golden.vertex_count) {
    return fmt::format("the cloth has {} vertices, the golden one {}", count, golden.vertex_count);
  }
  if (scene.simulation.step != golden.step) {
    return fmt::format("the step is {} s, in the golden {} s", scene.simulation.step, golden.step);
  }
  if (scene.step_count() != golden.step_count) {
    return fmt::format("the motion has {} steps, the golden one {}", scene.step_count(), golden.step_count);
  }
  return {};
}

std::string picture_mismatch(const Scene& scene, const CheckSettings& settings, const Golden& golden,
                             bool some_frames) {
  if (scene.simulation.cloth.vertex_count() != golden.vertex_count) {
    return "the pictures cannot be compared: the cloth has different vertices";
  }
  if (const Eigen::Vector2i size = picture_size(scene, settings); size != golden.size) {
    return fmt::format("the pictures have {}x{} pixels, the golden ones {}x{}", size.x(), size.y(), golden.size.x(),
                       golden.size.y());
  }
  if (const double seconds = scene.video.speed / scene.video.fps; seconds != golden.seconds_per_frame) {
    return fmt::format("a frame of the film comes every {:g} s of the scene, in the golden every {:g} s", seconds,
                       golden.seconds_per_frame);
  }
  std::vector<int> recorded;
  for (const GoldenFrame& frame : golden.frames) recorded.push_back(frame.frame);
  if (!some_frames && !settings.frames.empty() && settings.frames != recorded) {
    return fmt::format("the scene compares the frames {}, but the golden has {}", fmt::join(settings.frames, ", "),
                       fmt::join(recorded, ", "));
  }
  return {};
}

std::vector<std::string> film_mismatch(const Scene& scene, const CheckSettings& settings, const Golden& golden) {
  std::vector<std::string> changes;
  if (!golden.film) return changes;
  const GoldenFilm now = film_of(scene), &then = *golden.film;
  if (now.speed != then.speed) {
    changes.push_back(fmt::format("the film plays at {} (video.speed is {:g}, in the golden {:g})",
                                  speed_in_words(now.speed / then.speed), now.speed, then.speed));
  }
  if (now.fps != then.fps)
    changes.push_back(fmt::format("the film has {:g} frames a second, the golden one {:g}", now.fps, then.fps));
  // Pictures of the film's own size are reported as different anyway.
  if (settings.size && now.size != then.size) {
    changes.push_back(fmt::format("the film has {}x{} pixels, the golden one {}x{}", now.size.x(), now.size.y(),
                                  then.size.x(), then.size.y()));
  }
  if (now.samples != then.samples) {
    changes.push_back(fmt::format("the film has {} sample{} per pixel, the golden one {}", now.samples,
                                  now.samples == 1 ? "" : "s", then.samples));
  }
  return changes;
}

bool same_but_for_rounding(const std::vector<View>& a, const std::vector<View>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const View& one, const View& other) {
    constexpr double rounding = 1e-9;
    return one.position.isApprox(other.position, rounding) &&
           (one.target - other.target).norm() <= rounding * one.position.norm() &&
           one.up.isApprox(other.up, rounding) &&
           std::abs(one.field_of_view - other.field_of_view) <= rounding * one.field_of_view;
  });
}

}  // namespace drape
