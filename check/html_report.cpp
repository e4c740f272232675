#include "check/html_report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "check/html_scene.hpp"
#include "core/atomic_file.hpp"
#include "core/build_info.hpp"
#include "core/text.hpp"
#include "html/components.hpp"
#include "html/page.hpp"

namespace drape {
namespace {

using html::Markup;

bool failed(const SceneResult& scene) { return tone_of(scene.verdict) == html::Tone::bad; }

/// Sorts scenes: failed ones first, then recorded ones, otherwise in the order of the command line.
std::vector<const SceneResult*> by_importance(const CheckReport& report) {
  std::vector<const SceneResult*> scenes;
  for (const SceneResult& scene : report.scenes) scenes.push_back(&scene);
  const auto rank = [](const SceneResult& scene) {
    switch (scene.verdict) {
      case SceneVerdict::error:
        return 0;
      case SceneVerdict::changed:
        return 1;
      case SceneVerdict::missing:
        return 2;
      case SceneVerdict::updated:
        return 3;
      case SceneVerdict::passed:
        return 4;
    }
    return 4;
  };
  std::stable_sort(scenes.begin(), scenes.end(),
                   [&](const SceneResult* a, const SceneResult* b) { return rank(*a) < rank(*b); });
  return scenes;
}

/// Returns the outcome in one sentence: "2 of 5 scenes changed, 1 had no golden".
std::string headline(const CheckReport& report) {
  const auto count = [&](SceneVerdict verdict) {
    return std::count_if(report.scenes.begin(), report.scenes.end(),
                         [&](const SceneResult& scene) { return scene.verdict == verdict; });
  };
  const std::size_t all = report.scenes.size();
  const std::string scenes = all == 1 ? "scene" : "scenes";
  std::vector<std::string> problems;
  const auto tell = [&](SceneVerdict verdict, const char* what) {
    const auto number = count(verdict);
    if (number == 0) return;
    problems.push_back(all == 1           ? fmt::format("The scene {}", what)
                       : problems.empty() ? fmt::format("{} of {} scenes {}", number, all, what)
                                          : fmt::format("{} {}", number, what));
  };
  tell(SceneVerdict::changed, "changed");
  tell(SceneVerdict::missing, "had no golden");
  tell(SceneVerdict::error, "could not be judged");
  if (!problems.empty()) return fmt::format("{}", fmt::join(problems, ", "));
  if (const auto updated = count(SceneVerdict::updated); updated > 0) {
    return fmt::format("{} of {} {} recorded again", updated, all, scenes);
  }
  if (all == 0) return "No scene was checked";
  return all == 1 ? "The scene is unchanged" : fmt::format("All {} scenes are unchanged", all);
}

std::string anchor(std::size_t index) { return fmt::format("scene-{}", index); }

Markup pictures_badge(const SceneResult& scene) {
  const std::string verdict = picture_verdict(scene, scene.windows);
  return verdict == verdict_name(scene.windows.picture) ? verdict_badge(scene.windows.picture) : Markup(verdict);
}

Markup overview(const std::vector<const SceneResult*>& scenes) {
  html::Table table{"Checked scenes",
                    {{"Scene"},
                     {"Verdict"},
                     {"Motion"},
                     {"Largest deviation", true},
                     {"Pictures"},
                     {"Largest FLIP error", true},
                     {"Time [s]", true}},
                    {}};
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const SceneResult& scene = *scenes[i];
    const Comparison& c = scene.windows;
    const bool moved = !c.windows.empty(), drawn = !c.frames.empty();
    table.rows.push_back({html::link(fmt::format("#{}", anchor(i)), scene.name), verdict_badge(scene.verdict),
                          moved ? verdict_badge(c.motion) : Markup("–"),
                          moved ? readable_length(largest_deviation(c)) : "–",
                          drawn ? pictures_badge(scene) : Markup("–"),
                          drawn ? fmt::format("{:.3f}", largest_flip(c)) : "–", fmt::format("{:.1f}", scene.seconds)});
  }
  return html::table(table);
}

Markup introduction(const CheckReport& report) {
  return html::paragraph(html::element("time", {{"datetime", report.date}}, report.date) +
                         fmt::format(", {:.1f} s", report.seconds)) +
         (report.command.empty() ? Markup() : html::command("Run this check again", full_command(report))) +
         (report.accept_command.empty() ? Markup() : html::command("Accept all changes", report.accept_command));
}

std::vector<std::pair<std::string, Markup>> foot(const CheckReport& report) {
  const Machine& machine = report.machine;
  return {{"drape", fmt::format("{}, revision {}", machine.drape, build_info().revision)},
          {"Compiler", machine.compiler},
          {"Processor", machine.processor},
          {"Supported instruction sets", machine.cpu_flags},
          {"Instruction set in use", machine.kernels},
          {"System", machine.system},
          {"Drawn by", machine.renderer}};
}

}  // namespace

std::string html_report(const CheckReport& report) {
  const std::vector<const SceneResult*> scenes = by_importance(report);
  html::Page page;
  page.kind = "drape check";
  page.title = headline(report) + " · drape check";
  page.heading = headline(report);
  page.introduction = introduction(report);
  page.content = overview(scenes);
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const SceneResult& scene = *scenes[i];
    const std::string viewer = anchor(i) + "-pictures";
    // The details of an unchanged scene are collapsed.
    const Markup content = scene_content(scene, viewer);
    page.content += html::section(2, anchor(i), Markup(scene.name) + verdict_badge(scene.verdict),
                                  failed(scene) ? content : html::details("Pictures and figures", content));
  }
  page.foot = foot(report);
  return html::render(page);
}

void write_html_report(const CheckReport& report, const std::filesystem::path& file) {
  write_file_atomically(file, html_report(report));
}

}  // namespace drape
