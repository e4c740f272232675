#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "check/candidate.hpp"
#include "cli/check_results.hpp"
#include "cli/command_line.hpp"
#include "cli/frame_list.hpp"
#include "core/console.hpp"
#include "core/error.hpp"
#include "core/text.hpp"

namespace drape {
namespace {

struct AcceptArguments {
  std::string report = "out/check";
  std::vector<std::string> scenes;
  std::string frames;
};

/// @throws UsageError unless the folder contains a report of drape check
void require_report(const std::filesystem::path& folder) {
  std::error_code error;
  const auto status = std::filesystem::status(folder, error);
  if (std::filesystem::exists(folder / check_report_files.front(), error)) return;
  throw UsageError(fmt::format(
      "{}: {}; expected the report folder of a check: drape check SCENE writes out/check, or what --report says",
      shown(folder),
      !std::filesystem::exists(status)        ? "no such folder"
      : std::filesystem::is_directory(status) ? "there is no report of drape check in this folder"
                                              : "this is a file"));
}

ExitCode accept(const AcceptArguments& arguments, const CommonOptions& common) {
  const std::vector<int> frames = parse_frame_list(arguments.frames);
  require_report(arguments.report);
  const std::vector<Candidate> candidates = find_candidates(arguments.report, arguments.scenes);
  for (const Candidate& candidate : candidates) require_acceptable(candidate, frames);  // before accepting any
  for (const Candidate& candidate : candidates) {
    const std::filesystem::path folder = accept_candidate(candidate, frames);
    if (common.quiet) continue;
    print_text(stdout,
               fmt::format("{}: accepted{}\n", shown(folder),
                           frames.empty() ? "" : fmt::format(": the pictures of the frames {}", arguments.frames)));
  }
  return ExitCode::ok;
}

}  // namespace

void add_accept_command(CLI::App& app, const CommonOptions& common, Command& command) {
  auto arguments = std::make_shared<AcceptArguments>();
  CLI::App* sub = app.add_subcommand("accept", "Make what a failed check found the golden, without a new run");
  sub->add_option("REPORT", arguments->report, "Report folder of the check")->required();
  sub->add_option("SCENE", arguments->scenes, "Only these scenes: names in the report, or scene files");
  sub->add_option("--frames", arguments->frames,
                  "Only the pictures of these frames, if the motion is unchanged: A,B,C");
  sub->callback(
      [arguments, &common, &command] { command = [arguments, &common] { return accept(*arguments, common); }; });
}

}  // namespace drape
