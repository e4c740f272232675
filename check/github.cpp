#include "check/github.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string_view>

#include "core/text.hpp"
#include "html/markdown.hpp"

namespace drape {
namespace {

/// Escapes a text for a workflow command, see "Workflow commands for GitHub Actions".
/// @param property true for the value of a property, in which ':' and ',' are special
std::string command_text(std::string_view text, bool property) {
  std::string escaped;
  for (const char c : escape_controls(text)) {
    const bool special = c == '%' || c == '\r' || c == '\n' || (property && (c == ':' || c == ','));
    escaped += special ? fmt::format("%{:02X}", static_cast<unsigned>(c)) : std::string(1, c);
  }
  return escaped;
}

}  // namespace

std::string github_summary(const CheckReport& report) {
  std::vector<const SceneResult*> scenes;
  for (const SceneResult& scene : report.scenes) scenes.push_back(&scene);
  std::ranges::stable_sort(scenes, std::less(), [](const SceneResult* scene) { return scene->passed(); });
  const auto failed = std::ranges::count_if(scenes, [](const SceneResult* scene) { return !scene->passed(); });
  std::string text = fmt::format("### drape check: {}\n\n",
                                 failed == 0 ? fmt::format("{} scenes are as they were", scenes.size())
                                             : fmt::format("{} of {} scenes failed", failed, scenes.size()));
  text += "| scene | verdict | motion | pictures | what was found |\n|---|---|---|---|---|\n";
  for (const SceneResult* scene : scenes) {
    const Comparison& windows = scene->windows;
    text += fmt::format("| {} | {} {} | {} | {} | {} |\n", markdown(scene->file.string()), scene->passed() ? "✅" : "❌",
                        verdict_name(scene->verdict), windows.windows.empty() ? "–" : verdict_name(windows.motion),
                        windows.frames.empty() ? "–" : picture_verdict(*scene, windows),
                        markdown(fmt::format("{}", fmt::join(scene->findings, "; "))));
  }
  if (!report.accept_command.empty())
    text += fmt::format("\nTo accept all of it: {}\n", markdown_code(report.accept_command));
  return text;
}

std::string github_annotations(const CheckReport& report) {
  std::string text;
  for (const SceneResult& scene : report.scenes) {
    if (scene.passed()) continue;
    text += fmt::format("::error file={},title={}::{}\n", command_text(scene.file.string(), true),
                        command_text(fmt::format("drape check: {}", verdict_name(scene.verdict)), true),
                        command_text(fmt::format("{}", fmt::join(scene.findings, "; ")), false));
  }
  return text;
}

}  // namespace drape
