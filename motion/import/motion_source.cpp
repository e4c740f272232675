#include "motion/import/motion_source.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "core/text.hpp"
#include "drape/core/error.hpp"
#include "scene/mesh/source.hpp"

namespace drape {

void fail_import(const std::string& name, const std::string& message) {
  throw UsageError(shown(name) + ": " + escape_controls(message));
}

void require_finite(const std::string& name, const Vertices& x) {
  constexpr double furthest = 1e100;
  for (Eigen::Index v = 0; v < x.rows(); ++v) {
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      const double value = x(v, axis);
      if (std::abs(value) <= furthest) continue;
      fail_import(name,
                  fmt::format("vertex {} has the {} coordinate {}; expected a finite number", v, "xyz"[axis], value));
    }
  }
}

void add_faces(const std::string& name, const std::vector<std::size_t>& sizes, const std::vector<double>& corners,
               Mesh& mesh) {
  std::vector<int> vertices;
  std::vector<Eigen::Vector3d> places;
  std::size_t first = 0;
  for (const std::size_t size : sizes) {
    if (size < 3) fail_import(name, fmt::format("a face needs at least 3 corners, found {}", size));
    if (corners.size() - first < size) fail_import(name, "the list of faces is cut short");
    vertices.clear();
    for (std::size_t i = first; i < first + size; ++i) {
      if (!(corners[i] >= 0 && corners[i] < static_cast<double>(mesh.positions.rows()))) {
        fail_import(name, fmt::format("a face names vertex {}, but there are {}, numbered from 0", corners[i],
                                      mesh.positions.rows()));
      }
      vertices.push_back(static_cast<int>(corners[i]));
    }
    first += size;
    if (size == 3) {
      mesh.triangles.push_back({vertices[0], vertices[1], vertices[2]});
      continue;
    }
    if (size > most_concave_corners) fail_import(name, fmt::format("a face has {} corners: triangulate it", size));
    places.clear();
    for (const int v : vertices) places.emplace_back(mesh.positions.row(v).transpose());
    for (const auto& [a, b, c] : triangulate(places)) {
      mesh.triangles.push_back({vertices[a], vertices[b], vertices[c]});
    }
  }
}

Vertices vertices_of(const std::string& name, const std::vector<double>& numbers) {
  if (numbers.size() % 3 != 0) {
    fail_import(name, fmt::format("expected three numbers for each vertex, found {} numbers", numbers.size()));
  }
  Vertices x(static_cast<Eigen::Index>(numbers.size() / 3), 3);
  for (Eigen::Index v = 0; v < x.rows(); ++v) {
    for (Eigen::Index axis = 0; axis < 3; ++axis) x(v, axis) = numbers[static_cast<std::size_t>(3 * v + axis)];
  }
  return x;
}

namespace {

constexpr double usual_fps = 25;
constexpr double on_a_step = 0.02;  // fraction of a step; files may round their times
constexpr double most_steps = 1e9;

/// Returns the film speed that shows one step per frame, exactly if such a number exists.
double speed_of(double step, double fps) {
  const double about = step * fps;
  for (const double speed : {about, std::nextafter(about, 0), std::nextafter(about, HUGE_VAL)}) {
    if (speed / fps == step) return speed;
  }
  return about;
}

/// Chooses a film with one frame per step, unless the steps are too short or too long.
void choose_film(TimeGrid& grid, std::optional<double> of_file) {
  constexpr double slowest = 4, fastest = 120;
  const double rate = 1 / grid.step;
  if (of_file && std::isfinite(*of_file) && *of_file > 0 && *of_file <= 1000) {
    grid.fps = *of_file;
  } else if (rate >= slowest && rate <= fastest) {
    const double whole = std::round(rate);
    grid.fps = std::abs(rate - whole) < 1e-6 * rate ? whole : rate;
  } else {
    return;
  }
  grid.speed = speed_of(grid.step, grid.fps);
}

}  // namespace

TimeGrid make_time_grid(const std::string& name, std::size_t count, const std::vector<double>& times,
                        std::optional<double> fps, std::optional<double> of_file) {
  TimeGrid grid;
  if (fps || times.size() < 2) {
    grid.step = 1 / fps.value_or(of_file.value_or(usual_fps));
    for (std::size_t i = 0; i < count; ++i) grid.steps.push_back(static_cast<std::int64_t>(i));
    choose_film(grid, fps ? fps : of_file);
    return grid;
  }
  double least = HUGE_VAL;
  for (std::size_t i = 1; i < times.size(); ++i) {
    const double gap = times[i] - times[i - 1];
    if (!(gap > 0) || !std::isfinite(gap)) {
      fail_import(name,
                  fmt::format("its times do not increase: frame {} is at {} s, and frame {} at {} s; --fps takes its "
                              "frames as evenly spaced",
                              i - 1, times[i - 1], i, times[i]));
    }
    least = std::min(least, gap);
  }
  double steps = 0;
  grid.steps.push_back(0);
  for (std::size_t i = 1; i < times.size(); ++i) {
    steps += std::round((times[i] - times[i - 1]) / least);
    if (steps > most_steps) fail_import(name, "its times are too far apart; --fps takes its frames as evenly spaced");
    grid.steps.push_back(static_cast<std::int64_t>(steps));
  }
  const double first = times[1] - times[0], mean = (times.back() - times.front()) / steps;
  const bool exact = times[0] == 0 && grid.steps[1] == 1 && std::ranges::all_of(grid.steps, [&](const std::int64_t& s) {
                       return static_cast<double>(s) * first == times[static_cast<std::size_t>(&s - grid.steps.data())];
                     });
  grid.step = exact ? first : mean;
  for (std::size_t i = 0; i < times.size(); ++i) {
    const double expected = times[0] + static_cast<double>(grid.steps[i]) * grid.step;
    if (std::abs(times[i] - expected) <= on_a_step * grid.step) continue;
    fail_import(name,
                fmt::format("its times lie on no equal steps: frame {} is at {} s, which is no multiple of {:.6g} s; "
                            "--fps takes its frames as evenly spaced",
                            i, times[i], grid.step));
  }
  choose_film(grid, of_file);
  return grid;
}

}  // namespace drape
