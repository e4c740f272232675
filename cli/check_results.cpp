#include "cli/check_results.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spdlog/spdlog.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <system_error>

#include "check/github.hpp"
#include "check/html_report.hpp"
#include "check/json_report.hpp"
#include "check/junit_report.hpp"
#include "check/scene_charts.hpp"
#include "cli/terminal.hpp"
#include "core/atomic_file.hpp"
#include "core/console.hpp"
#include "core/shell.hpp"
#include "core/text.hpp"
#include "core/wrap.hpp"
#include "sweep/merge.hpp"

namespace drape {
namespace {

/// Describes the result of a scene in one line.
std::string describe(const SceneResult& scene) {
  const std::string file = shown(scene.file);
  if (scene.verdict != SceneVerdict::passed) {
    return fmt::format("{}: {}: {}", file, verdict_name(scene.verdict), fmt::join(scene.findings, "; "));
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

void write_reports(const CheckShard& shard, const std::filesystem::path& folder) {
  const auto& [html, json, junit] = check_report_files;
  write_html_report(shard.report, folder / html);
  write_file_atomically(folder / json, json_report(shard.report));
  write_file_atomically(folder / junit, junit_report(shard.report));
  if (!shard.whole) write_file_atomically(folder / check_mark, pack_shard(shard));
  write_frame_files(shard.report, folder);
  if (const std::string missing = write_diagrams(shard.report, folder); !missing.empty()) spdlog::debug(missing);
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
  return "drape accept " + shell_word(report.string());
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
  if (!result.renderer.empty()) spdlog::debug("drawn by {}", result.renderer);
}

ExitCode conclude_check(const CheckShard& shard, const std::filesystem::path& folder, const CommonOptions& common,
                        ResultPrinter& verdicts) {
  write_reports(shard, folder);
  if (!common.quiet) verdicts.print(shown(folder / check_report_files.front()));
  tell_github(shard.report, verdicts);
  ExitCode code = exit_code(shard.report);
  if (const std::size_t missing = shard.missing(); missing > 0) {
    spdlog::error("{} of {} scenes are in none of the shards", missing, shard.scenes);
    code = ExitCode::interrupted;
  }
  if (verdicts.reason().empty()) return code;
  spdlog::error("cannot write the verdicts to standard output: {}", verdicts.reason());
  return std::max(code, ExitCode::output);
}

}  // namespace drape
