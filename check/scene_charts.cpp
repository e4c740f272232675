#include "check/scene_charts.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "core/text.hpp"

namespace drape {
namespace {

NamedChart motion_chart(const SceneResult& scene, const Comparison& comparison) {
  html::ChartSeries series;
  for (const WindowResult& window : comparison.windows) {
    for (const Deviation& deviation : window.deviations) {
      series.points.push_back({static_cast<double>(deviation.step),
                               deviation.distance,
                               fmt::format("step {}: {}", deviation.step, readable_length(deviation.distance)),
                               {}});
    }
    series.points.push_back({NAN, NAN, {}, {}});  // each window starts from a golden state: interrupt the line
  }
  html::Chart chart{"Largest vertex deviation from the golden motion, halfway through and at the end of every window",
                    "step",
                    "deviation [m]",
                    html::Scale::linear,
                    html::Scale::logarithmic,
                    {series},
                    {{scene.settings.motion_tolerance, "tolerance"}}};
  return {"motion", std::move(chart)};
}

NamedChart picture_chart(const SceneResult& scene, const Comparison& comparison) {
  html::ChartSeries largest{"largest in a pixel", {}}, mean{"mean", {}};
  for (const FrameResult& frame : comparison.frames) {
    const PictureDifference& d = frame.difference;
    const auto x = static_cast<double>(frame.frame);
    largest.points.push_back({x, d.max_flip, fmt::format("frame {}: {:.3f}", frame.frame, d.max_flip), {}});
    mean.points.push_back({x, d.mean_flip, fmt::format("frame {}: {:.4f}", frame.frame, d.mean_flip), {}});
  }
  html::Chart chart{"Visible difference of the pictures: their FLIP error, from 0 (identical) to 1.",
                    "frame",
                    "FLIP error",
                    html::Scale::linear,
                    html::Scale::linear,
                    {largest, mean},
                    {{scene.settings.limits.flip, "limit per pixel"}}};
  return {"pictures", std::move(chart)};
}

}  // namespace

std::vector<NamedChart> scene_charts(const SceneResult& scene, const Comparison& comparison) {
  std::vector<NamedChart> charts;
  if (!comparison.windows.empty()) charts.push_back(motion_chart(scene, comparison));
  if (!comparison.frames.empty()) charts.push_back(picture_chart(scene, comparison));
  return charts;
}

std::string write_diagrams(const CheckReport& report, const std::filesystem::path& folder) {
  std::string problem;
  const auto write = [&](const SceneResult& scene, const Comparison& comparison, const std::string& prefix) {
    for (NamedChart& diagram : scene_charts(scene, comparison)) {
      diagram.name = prefix + diagram.name;
      const std::string missing = write_chart(diagram, folder / scene.name);
      if (problem.empty()) problem = missing;
    }
  };
  for (const SceneResult& scene : report.scenes) {
    write(scene, scene.windows, "");
    if (scene.end_to_end) write(scene, *scene.end_to_end, "end_to_end.");
  }
  return problem;
}

}  // namespace drape
