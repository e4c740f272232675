#include "cli/summary.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <poll.h>
#include <spdlog/spdlog.h>
#include <sys/eventfd.h>
#include <unistd.h>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>
#include <system_error>

#include "check/html_report.hpp"
#include "check/report.hpp"
#include "cli/terminal.hpp"
#include "core/console.hpp"
#include "core/files.hpp"
#include "core/text.hpp"
#include "drape/scene/scene.hpp"
#include "scene/selection.hpp"

namespace drape {
namespace {

/// An event with a file descriptor that becomes readable.
class Event {
 public:
  Event() : descriptor_(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {
    if (descriptor_ < 0) throw std::system_error(errno, std::generic_category(), "cannot wait for input");
  }
  Event(const Event&) = delete;
  Event& operator=(const Event&) = delete;
  ~Event() { close(descriptor_); }

  void set() const { eventfd_write(descriptor_, 1); }
  [[nodiscard]] int descriptor() const { return descriptor_; }

 private:
  int descriptor_;
};

}  // namespace

void StepByStep::begin(const Simulation&) { print_text(stdout, "Press Enter for the next step, q to stop.\n"); }

void StepByStep::after_step(const Simulation& simulation, const StepReport& report, double seconds) {
  const Energies e = simulation.energies();
  std::string text = fmt::format("step {}: total {:.6g} = kinetic {:.6g} + gravity {:.6g} + elastic {:.6g} J",
                                 simulation.state().step, e.total(), e.kinetic, e.gravity, e.elastic);
  if (!is_explicit(simulation.settings().integrator.method)) {
    text += fmt::format(", {} iterations{}", report.iterations, report.converged ? "" : " (not converged)");
  }
  if (report.estimate) {
    text += fmt::format(", {} substeps, estimated error {}{}", report.substeps, readable_length(*report.estimate),
                        report.converged ? "" : ", above the requested accuracy");
  }
  print_text(stdout, text + fmt::format(", {:.1f} µs\n", 1e6 * seconds));
  wait_for_line();
}

void StepByStep::wait_for_line() {
  if (input_ended_) return;
  const Event stopped;
  const std::stop_callback wake(stop_.get_token(), [&] { stopped.set(); });
  while (!input_ended_ && !stop_.stop_requested()) {
    std::array<pollfd, 2> either{{{.fd = STDIN_FILENO, .events = POLLIN, .revents = 0},
                                  {.fd = stopped.descriptor(), .events = POLLIN, .revents = 0}}};
    if (poll(either.data(), either.size(), -1) < 0 && errno == EINTR) continue;
    if (either[1].revents != 0) return;
    char character = 0;
    if (read(STDIN_FILENO, &character, 1) != 1) {
      input_ended_ = true;  // input from a file or a closed input does not block the run
    } else if (character == 'q') {
      stop_.request_stop();
    } else if (character == '\n') {
      return;
    }
  }
}

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
  if (choice.method != Method::verlet) {
    return text + fmt::format(" (auto, as {}: verlet would take about {:.2g} times as long)", choice.reason,
                              choice.verlet / choice.quasi_newton);
  }
  const double longer = choice.quasi_newton / choice.verlet, apart = longer - choice.contact / choice.verlet;
  text += fmt::format(" (auto, as {}: quasi-newton would take about {:.2g} times as long", choice.reason, longer);
  constexpr double notable = 1.5;
  return text + (longer > notable * apart ? fmt::format(", and {:.2g} while it touches nothing)", apart) : ")");
}

}  // namespace

std::string describe(const LoadedScene& scene, const RunOptions& options) {
  const SimulationSettings& s = scene.simulation;
  const std::int64_t steps = options.steps.value_or(scene.step_count());
  if (options.recorded) {
    const MotionReader& motion = *options.recorded;
    return fmt::format("{}: motion of {}, {} vertices, {} steps of {:g} s ({:g} s), {} states stored",
                       shown(scene.source.file), shown(motion.header().name), motion.header().vertices,
                       motion.last_step(), s.step, static_cast<double>(motion.last_step()) * s.step, motion.states());
  }
  std::string text =
      fmt::format("{}: {}, {} vertices, {} springs, {}, {} steps of {:g} s ({:g} s)", shown(scene.source.file),
                  method_text(scene), s.cloth.vertex_count(), s.cloth.springs.size(), shape_of(s.cloth).text(), steps,
                  s.step, static_cast<double>(steps) * s.step);
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
    found.push_back(
        fmt::format("the cloth's energy rose by {:.2g} J without a source, {:.2g} of the most that it can have: omit "
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
  if (s.redone() > 0) text += fmt::format(", {} steps redone by backward Euler", s.redone());
  if (const auto errors = s.exactness().errors()) {
    text += fmt::format(", estimated error {} per step (at most {})", readable_length(errors->mean),
                        readable_length(errors->largest));
  }
  if (const auto& residual_force = s.exactness().residual_force()) {
    text += fmt::format(", at rest with {}", out_of_balance(*residual_force));
  }
  if (s.steps() > 0) {
    text += fmt::format(", {} per step (median {})", duration(1e-6 * s.mean_microseconds()),
                        duration(1e-6 * s.median_microseconds()));
  }
  return text + fmt::format("\nsimulate {}", duration(s.total_seconds()));
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

namespace {

/// Describes the result of a scene in one line.
std::string describe(const SceneResult& scene) {
  const std::string file = shown(scene.file);
  if (scene.verdict != SceneVerdict::passed) {
    return fmt::format("{}: {}: {}", file, verdict_name(scene.verdict), fmt::join(sentences(scene), "; "));
  }
  std::string text =
      fmt::format("{}: passed: motion {}, {} {}", file, verdict_name(scene.windows.motion), scene.windows.frames.size(),
                  scene.windows.frames.size() == 1 ? "picture" : "pictures");
  text += " " + picture_verdict(scene, scene.windows);
  if (const std::string ignored = describe_ignored(scene); !ignored.empty()) text += fmt::format(" ({})", ignored);
  if (scene.end_to_end) {
    text += fmt::format("; end to end {}, {}", verdict_name(scene.end_to_end->motion),
                        picture_verdict(scene, *scene.end_to_end));
  }
  return text + fmt::format(" ({:.1f} s)", scene.seconds);
}

Ink ink_of(SceneVerdict verdict) {
  if (verdict == SceneVerdict::passed) return Ink::green;
  return verdict == SceneVerdict::changed || verdict == SceneVerdict::error ? Ink::red : Ink::yellow;
}

/// Returns a line for the terminal with the verdict in colour.
std::string colored(const SceneResult& result, const CommonOptions& common) {
  const Terminal where = terminal(stdout, common.color);
  std::string line = wrapped(escape_controls(describe(result)), where.width, 2);
  const std::string verdict = verdict_name(result.verdict);
  const std::size_t at = line.find(": " + verdict + ":");
  if (at == std::string::npos) return line;
  return line.substr(0, at + 2) + inked(verdict, ink_of(result.verdict), where) + line.substr(at + 2 + verdict.size());
}

void write_reports(const CheckReport& report, const std::filesystem::path& folder, FigureStyle style) {
  const auto& [html, json, junit] = check_report_files;
  write_html_report(report, folder / html);
  write_file_atomically(folder / json, json_report(report));
  write_file_atomically(folder / junit, junit_report(report));
  write_frame_files(report, folder);
  if (const std::string missing = write_diagrams(report, folder, style); !missing.empty()) spdlog::debug(missing);
}

/// Writes the job summary and annotations at the scenes' files, under GitHub Actions.
void tell_github(const CheckReport& report, ResultPrinter& verdicts) {
  if (const char* file = std::getenv("GITHUB_STEP_SUMMARY"); file != nullptr && *file != '\0') {
    std::ofstream summary(file, std::ios::app);
    if (!(summary << github_summary(report) << std::flush)) spdlog::warn("cannot write {}, GitHub's summary", file);
  }
  if (std::getenv("GITHUB_ACTIONS") == nullptr) return;
  if (const std::string lines = github_annotations(report); !lines.empty()) {
    verdicts.print(lines.substr(0, lines.size() - 1));
  }
}

}  // namespace

void ResultPrinter::print(const std::string& line) {
  if (print_unescaped(stdout, line + "\n")) return;
  if (reason_.empty()) reason_ = std::generic_category().message(errno);
}

std::string accept_command(const std::filesystem::path& report) {
  return "drape accept " + shell_file(report.string());
}

void tell(const SceneResult& result, const CommonOptions& common, ResultPrinter& verdicts) {
  const bool good = result.passed();
  if (result.verdict == SceneVerdict::error) {
    spdlog::error(describe(result));
  } else if (!common.quiet || !good) {
    verdicts.print(colored(result, common));
  }
  for (const WindowResult& window : result.windows.windows) {
    spdlog::debug("steps {} to {}: {}", window.first_step, window.last_step, verdict_name(window.verdict));
  }
  for (const FrameResult& frame : result.windows.frames) {
    spdlog::debug("frame {}: {}, {} pixels differ, FLIP error up to {:.3f}", frame.frame,
                  verdict_name(frame.difference.verdict), frame.difference.pixels, frame.difference.max_flip);
  }
  if (const std::string& by = result.checked_on.renderer; !by.empty()) spdlog::debug("drawn by {}", by);
}

ExitCode conclude_check(const CheckReport& report, const std::filesystem::path& folder, FigureStyle style,
                        const CommonOptions& common, ResultPrinter& verdicts) {
  write_reports(report, folder, style);
  if (!common.quiet) verdicts.print(shown(folder / check_report_files.front()));
  tell_github(report, verdicts);
  ExitCode code = exit_code(report);
  if (report.missing > 0) {
    spdlog::error(describe_missing(report));
    code = ExitCode::interrupted;
  }
  if (verdicts.reason().empty()) return code;
  spdlog::error("cannot write the verdicts to standard output: {}", verdicts.reason());
  return std::max(code, ExitCode::output);
}

}  // namespace drape
