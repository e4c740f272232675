#include <fmt/format.h>

#include <memory>

#include "check/candidate.hpp"
#include "cli/command_line.hpp"
#include "cli/frame_list.hpp"

namespace drape {
namespace {

struct AcceptArguments {
  std::string report = "out/check";
  std::vector<std::string> scenes;
  std::string frames;
};

ExitCode accept(const AcceptArguments& arguments, const CommonOptions& common) {
  const std::vector<int> frames = parse_frame_list(arguments.frames);
  const std::vector<Candidate> candidates = find_candidates(arguments.report, arguments.scenes);
  for (const Candidate& candidate : candidates) require_acceptable(candidate, frames);  // before any is
  for (const Candidate& candidate : candidates) {
    const std::filesystem::path folder = accept_candidate(candidate, frames);
    if (common.quiet) continue;
    fmt::print("{}: accepted{}\n", folder.string(),
               frames.empty() ? "" : fmt::format(": the pictures of the frames {}", arguments.frames));
  }
  return ExitCode::ok;
}

}  // namespace

void add_accept_command(CLI::App& app, const CommonOptions& common, Command& command) {
  auto arguments = std::make_shared<AcceptArguments>();
  CLI::App* sub =
      app.add_subcommand("accept", "Turn what a failed check found into the golden, without computing it again");
  sub->add_option("REPORT", arguments->report, "Report folder of the check")->required();
  sub->add_option("SCENE", arguments->scenes, "Only these scenes: names in the report, or scene files");
  sub->add_option("--frames", arguments->frames,
                  "Only the pictures of these frames, if the motion is unchanged: A,B,C");
  sub->callback(
      [arguments, &common, &command] { command = [arguments, &common] { return accept(*arguments, common); }; });
}

}  // namespace drape
