#include "cli/summary.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/text.hpp"
#include "scene/cloth_shape.hpp"
#include "scene/method_names.hpp"

namespace drape {
namespace {

std::string bytes(std::uintmax_t count) {
  const auto n = static_cast<double>(count);
  if (n < 1e3) return fmt::format("{} B", count);
  if (n < 1e6) return fmt::format("{:.0f} kB", n / 1e3);
  return fmt::format("{:.2f} MB", n / 1e6);
}

std::string duration(double seconds) {
  if (seconds < 1e-3) return fmt::format("{:.1f} µs", 1e6 * seconds);
  if (seconds < 1) return fmt::format("{:.1f} ms", 1e3 * seconds);
  return fmt::format("{:.1f} s", seconds);
}

std::string out_of_balance(const ErrorMonitor::ResidualForce& residual_force) {
  if (!residual_force.of_weight) return fmt::format("{:.2g} N out of balance", residual_force.force);
  if (*residual_force.of_weight >= 1)
    return fmt::format("{:.2g} times its weight out of balance", *residual_force.of_weight);
  return fmt::format("{:.2g} % of its weight out of balance", 100 * *residual_force.of_weight);
}

/// Returns the name of an output by its files.
std::string name(const std::vector<OutputFile>& files) {
  const std::string first = shown(files.front().path);
  return files.size() == 1 ? first : fmt::format("{} … {}", first, shown(files.back().path));
}

/// Describes the method and, if it was chosen automatically, the reason.
std::string method_text(const Scene& scene) {
  const IntegratorSettings& integrator = scene.simulation.integrator;
  std::string text = step_method_name(integrator.step_method());
  if (integrator.substep_count() > 1) text += fmt::format(" in {} substeps", integrator.substep_count());
  if (!scene.choice) return text;
  const MethodChoice& choice = *scene.choice;
  if (choice.only) return text + fmt::format(" (auto, as {})", choice.reason);
  const bool verlet = choice.method == Method::verlet;
  const double other = verlet ? choice.quasi_newton / choice.verlet : choice.verlet / choice.quasi_newton;
  return text + fmt::format(" (auto, as {}: {} would take about {:.2g} times as long)", choice.reason,
                            verlet ? "quasi-newton" : "verlet", other);
}

}  // namespace

std::string describe(const Scene& scene, const RunOptions& options) {
  const SimulationSettings& s = scene.simulation;
  const std::int64_t steps = options.steps.value_or(scene.step_count());
  if (options.recorded) {
    const MotionReader& motion = *options.recorded;
    return fmt::format("{}: motion of {}, {} vertices, {} steps of {:g} s ({:g} s), {} states stored",
                       shown(scene.file), shown(motion.header().name), motion.header().vertices, motion.last_step(),
                       s.step, static_cast<double>(motion.last_step()) * s.step, motion.states());
  }
  std::string text = fmt::format("{}: {}, {} vertices, {} springs, {}, {} steps of {:g} s ({:g} s)", shown(scene.file),
                                 method_text(scene), s.cloth.vertex_count(), s.cloth.springs.size(),
                                 shape_of(s.cloth).text(), steps, s.step, static_cast<double>(steps) * s.step);
  for (const Effect& effect : s.effects) text += ", " + std::string(effect.name());
  return text;
}

std::string effect_shares(const Statistics& statistics) {
  std::string text;
  for (const auto& [name, share] : statistics.effects()) {
    text +=
        fmt::format("{}{} {:.1f} %", text.empty() ? "share of the step time: " : ", ", name, 100 * share.value_or(0));
  }
  return text.empty() ? "no effects" : text;
}

std::string describe_end(const RunResult& result, const std::string& resume) {
  const std::int64_t steps = result.statistics.steps();
  std::string text = fmt::format("after {} of {} steps", steps, result.steps_wanted);
  if (result.recorded) text = fmt::format("after {} of {} frames", result.frames, result.frames_wanted);
  const bool motion = result.motion && !result.motion->growing.empty();
  if (result.outputs.empty() && result.records.empty() && !motion) return text + "; nothing was written";
  for (const std::vector<OutputFile>& files : result.outputs) {
    text += fmt::format("{} {}", &files == &result.outputs.front() ? ";" : ",", name(files));
  }
  if (!result.outputs.empty()) {
    text += fmt::format(" {} {} of {} frames", result.outputs.size() == 1 ? "has" : "have",
                        result.frames == result.frames_wanted ? "all" : fmt::format("the first {}", result.frames),
                        result.frames_wanted);
  }
  if (motion) {
    text += fmt::format("; {} has the motion so far", result.motion->growing);
    if (!resume.empty()) text += fmt::format(", and {} continues it", resume);
  }
  if (!result.records.empty()) {
    text += fmt::format("; {} written up to that point", fmt::join(result.records, ", "));
  }
  return text;
}

std::vector<std::string> warnings(const RunResult& result) {
  const ErrorMonitor& exactness = result.statistics.exactness();
  const char* remedy =
      exactness.asked()
          ? "use a smaller [time] accuracy"
          : "omit [integrator] tolerance and stop with method = \"quasi-newton\", or use a smaller tolerance";
  std::vector<std::string> found;
  if (exactness.coarse()) {
    found.push_back(fmt::format("the steps were solved only to about {}, more than a hundredth of the cloth's size: {}",
                                readable_length(exactness.errors()->mean), remedy));
  }
  if (const auto& residual_force = exactness.residual_force(); residual_force && residual_force->notable()) {
    found.push_back(fmt::format("the cloth is at rest with {}, so this is not an equilibrium: {}",
                                out_of_balance(*residual_force), remedy));
  }
  if (const auto rise = result.statistics.energy_rise(); rise && rise->notable()) {
    found.push_back(fmt::format(
        "the cloth's energy rose by {:.2g} J with nothing that gives any, {:.2g} times all that it ever had: omit "
        "[integrator], or take a shorter [time] step",
        rise->energy, rise->of_available));
  }
  return found;
}

std::string describe_files(const std::vector<std::vector<OutputFile>>& outputs) {
  std::string text;
  for (const std::vector<OutputFile>& files : outputs) {
    std::uintmax_t size = 0;
    for (const OutputFile& file : files) size += file.size;
    text += fmt::format("{}{}  {}{}", text.empty() ? "" : "\n", name(files),
                        files.size() > 1 ? fmt::format("{} files, ", files.size()) : "", bytes(size));
    if (!files.front().note.empty()) text += ", " + files.front().note;
  }
  return text;
}

namespace {

/// Describes the results and the duration of the steps.
std::string of_steps(const Statistics& s) {
  std::string text = fmt::format("{} steps", s.steps());
  const auto& asked = s.exactness().asked();
  if (asked) {
    const double mean = s.mean_substeps();
    text += fmt::format(", {:.{}g} substeps each (at most {})", mean, mean < 1000 ? 3 : 7, s.max_substeps());
    if (s.not_converged() > 0) {
      text += fmt::format(", {} steps missed {}", s.not_converged(), readable_length(*asked));
    }
  }
  if (!asked && s.mean_iterations() == 0 && s.not_converged() > 0) {
    text += fmt::format(", {} steps end beyond contact or limits", s.not_converged());
  }
  if (s.mean_iterations() > 0) {
    text += fmt::format(", {:.2f} iterations each (at most {})", s.mean_iterations(), s.max_iterations());
    if (!asked && s.not_converged() > 0) {
      text += fmt::format(", {} steps not converged (worst residual {:.2g} N)", s.not_converged(), s.worst_residual());
    }
  }
  if (const auto errors = s.exactness().errors()) {
    text += fmt::format(", estimated error {} per step (at most {})", readable_length(errors->mean),
                        readable_length(errors->largest));
  }
  if (const auto& residual_force = s.exactness().residual_force()) {
    text += fmt::format(", at rest with {}", out_of_balance(*residual_force));
  }
  text += fmt::format(", {} per step (median {})\n", duration(1e-6 * s.mean_microseconds()),
                      duration(1e-6 * s.median_microseconds()));
  return text + fmt::format("simulate {}", duration(s.total_seconds()));
}

}  // namespace

std::string summarize(const RunResult& result) {
  std::string text = result.recorded ? fmt::format("{} frames", result.frames) : of_steps(result.statistics);
  if (!result.renderer.empty()) {
    text += fmt::format(", draw {}, encode {}", duration(result.draw_seconds), duration(result.write_seconds));
  } else if (result.frames_wanted > 0) {
    text += fmt::format(", write {}", duration(result.write_seconds));
  }
  text += fmt::format(", total {}", duration(result.elapsed_seconds));
  if (!result.outputs.empty()) text += "\n" + describe_files(result.outputs);
  if (result.motion && result.motion->complete) {
    text += fmt::format("\n{}  {}", shown(result.motion->complete->path), bytes(result.motion->complete->size));
  }
  for (const std::string& record : result.records) text += "\n" + record;
  return text;
}

}  // namespace drape
