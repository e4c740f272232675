#include "check/html_report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "check/compare_motion.hpp"
#include "check/name_difference.hpp"
#include "check/picture.hpp"
#include "core/files.hpp"
#include "core/installation.hpp"
#include "core/text.hpp"
#include "reports/chart.hpp"
#include "reports/components.hpp"
#include "reports/listing.hpp"
#include "reports/page.hpp"

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

std::string write_diagrams(const CheckReport& report, const std::filesystem::path& folder, FigureStyle style) {
  std::string problem;
  const auto write = [&](const SceneResult& scene, const Comparison& comparison, const std::string& prefix) {
    for (NamedChart& diagram : scene_charts(scene, comparison)) {
      diagram.name = prefix + diagram.name;
      const std::string missing = write_chart(diagram, folder / scene.name, style);
      if (problem.empty()) problem = missing;
    }
  };
  for (const SceneResult& scene : report.scenes) {
    write(scene, scene.windows, "");
    if (scene.end_to_end) write(scene, *scene.end_to_end, "end_to_end.");
  }
  return problem;
}

namespace {

using html::Markup;
using html::Tone;

std::string plural(std::int64_t count, const std::string& one) {
  return fmt::format("{} {}{}", count, one, count == 1 ? "" : "s");
}

/// Turns a message without capital and full stop into a sentence.
std::string whole_sentence(std::string text) {
  if (!text.empty() && text.front() >= 'a' && text.front() <= 'z') text.front() += 'A' - 'a';
  return text + ".";
}

/// Describes the differences in a frame.
std::string describe(const FrameResult& frame) {
  const PictureDifference& d = frame.difference;
  const std::string why = frame.why.empty() ? "" : " (" + frame.why + ")";
  const std::string moment = fmt::format("Frame {}, {:.2f} s{}: ", frame.frame, frame.time, why);
  const std::string unjudged = frame.judged ? "" : "It is not judged. ";
  if (d.verdict == PictureVerdict::exact) return moment + "identical.";
  return moment + (frame.kind.empty() ? "" : frame.kind + ". ") + unjudged +
         fmt::format("{} ({:.3g}%) differ, by at most {} of 255; FLIP error at most {:.3f}, {:.4f} on average.",
                     plural(d.pixels, "pixel"), 100 * d.fraction, d.largest_channel, d.max_flip, d.mean_flip);
}

/// Returns the index of the frame whose picture differs most from the first one's: most motions begin with a flat
/// cloth.
std::size_t most_telling(const std::vector<FrameResult>& frames, const std::array<int, 2>& size) {
  std::size_t telling = 0;
  std::int64_t most = 0;
  try {
    const auto picture = [&](const FrameResult& frame) { return decode_png(frame.expected, {size[0], size[1]}); };
    const Image first = picture(frames.at(0));
    for (std::size_t i = 1; i < frames.size(); ++i) {
      const std::int64_t differs = summed_difference(picture(frames[i]), first);
      if (differs <= most) continue;
      most = differs;
      telling = i;
    }
  } catch (const std::invalid_argument&) {  // a damaged picture, from a shard
  }
  return telling;
}

Markup viewer(const SceneResult& scene, const Comparison& comparison, const std::string& id) {
  std::vector<html::ComparedPictures> moments;
  std::size_t shown =
      comparison.first_bad_frame || comparison.frames.empty() ? 0 : most_telling(comparison.frames, scene.size);
  for (const FrameResult& frame : comparison.frames) {
    html::ComparedPictures moment;
    moment.name = fmt::format("{}", frame.frame);
    moment.tone = frame.judged ? tone_of(frame.difference.verdict) : Tone::neutral;
    moment.ignored = scene.settings.ignore;
    if (!frame.judged) moment.ignored = {{0, 0, scene.size[0], scene.size[1]}};
    moment.expected = frame.expected;
    moment.actual = frame.actual;
    moment.difference = frame.amplified;
    moment.error_map = frame.flip_map;
    moment.caption = describe(frame);
    moment.size = scene.size;
    if (frame.difference.verdict != PictureVerdict::exact) moment.worst = frame.difference.worst_pixel;
    // Pictures of a changed motion can only be accepted together with it.
    const bool alone =
        scene.has_candidate() && &comparison == &scene.windows && comparison.motion != MotionVerdict::changed;
    if (alone && frame.difference.verdict == PictureVerdict::changed) {
      moment.action =
          html::command("Accept this picture", fmt::format("{} --frames {}", scene.accept_command, frame.frame));
    }
    if (comparison.first_bad_frame == frame.frame) shown = moments.size();
    moments.push_back(std::move(moment));
  }
  return moments.empty() ? Markup() : html::comparison(id, moments, shown);
}

Markup windows_table(const Comparison& comparison) {
  html::Table table{"Windows of motion, each run from a golden state",
                    {{"Steps"},
                     {"Verdict"},
                     {"Bits differ from step", true},
                     {"Largest deviation", true},
                     {"Vertex", true},
                     {"At step", true},
                     {"Remark"}},
                    {}};
  for (const WindowResult& w : comparison.windows) {
    table.rows.push_back(
        {fmt::format("{}–{}", w.first_step, w.last_step), verdict_badge(w.verdict),
         w.other_bits ? fmt::format("{}", *w.other_bits) : "–", readable_length(w.largest ? w.largest->distance : 0),
         w.largest ? fmt::format("{}", w.largest->vertex) : "–", w.largest ? fmt::format("{}", w.largest->step) : "–",
         w.problem ? describe_problem(*w.problem) : ""});
  }
  return html::table(table);
}

Markup frames_table(const Comparison& comparison) {
  html::Table table{"Compared frames",
                    {{"Frame", true},
                     {"Time [s]", true},
                     {"Reason"},
                     {"Verdict"},
                     {"Pixels that differ", true},
                     {"Share", true},
                     {"Largest channel", true},
                     {"Mean FLIP", true},
                     {"Largest FLIP", true}},
                    {}};
  for (const FrameResult& frame : comparison.frames) {
    const PictureDifference& d = frame.difference;
    table.rows.push_back({fmt::format("{}", frame.frame), fmt::format("{:.2f}", frame.time), frame.why,
                          verdict_badge(d.verdict), fmt::format("{}", d.pixels),
                          fmt::format("{:.3g}%", 100 * d.fraction), fmt::format("{}", d.largest_channel),
                          fmt::format("{:.4f}", d.mean_flip), fmt::format("{:.3f}", d.max_flip)});
  }
  return html::table(table);
}

Markup provenance(const SceneResult& scene) {
  const PictureLimits& limits = scene.settings.limits;
  return html::facts(
      {{"Scene", html::code(scene.file.string())},
       {"Golden", html::code(scene.golden.string())},
       {"Recorded", scene.recorded_at},
       {"Recorded by", fmt::format("drape {}, {}", scene.recorded_on.drape, scene.recorded_on.compiler)},
       {"Recorded on", fmt::format("{}; {}", scene.recorded_on.processor, scene.recorded_on.system)},
       {"Drawn by", scene.recorded_on.renderer},
       {"Instruction set", scene.recorded_on.kernels},
       {"Limits", fmt::format("motion {}; noise up to {} of 255 in a channel, {:g}% of the pixels, FLIP error {:g}",
                              readable_length(scene.settings.motion_tolerance), limits.channel, 100 * limits.pixels,
                              limits.flip)}});
}

/// Returns curves and tables.
Markup figures(const SceneResult& scene, const Comparison& comparison) {
  std::vector<Markup> charts;
  for (const NamedChart& diagram : scene_charts(scene, comparison)) charts.push_back(html::chart(diagram.chart));
  const Markup content = html::row(charts);
  Markup tables;
  if (!comparison.windows.empty()) tables += windows_table(comparison);
  if (!comparison.frames.empty()) tables += frames_table(comparison);
  return content + (tables.empty() ? tables : html::details("All figures", tables));
}

}  // namespace

Tone tone_of(SceneVerdict verdict) {
  switch (verdict) {
    case SceneVerdict::passed:
      return Tone::good;
    case SceneVerdict::changed:
    case SceneVerdict::missing:
    case SceneVerdict::error:
      return Tone::bad;
    case SceneVerdict::updated:
      return Tone::caution;
  }
  return Tone::neutral;
}

Tone tone_of(MotionVerdict verdict) {
  return verdict == MotionVerdict::same_bits          ? Tone::good
         : verdict == MotionVerdict::within_tolerance ? Tone::caution
                                                      : Tone::bad;
}

Tone tone_of(PictureVerdict verdict) {
  return verdict == PictureVerdict::exact ? Tone::good : verdict == PictureVerdict::noise ? Tone::caution : Tone::bad;
}

double largest_deviation(const Comparison& comparison) {
  double largest = 0;
  for (const WindowResult& window : comparison.windows) {
    if (window.largest) largest = std::max(largest, window.largest->distance);
  }
  return largest;
}

double largest_flip(const Comparison& comparison) {
  double largest = 0;
  for (const FrameResult& frame : comparison.frames) largest = std::max(largest, frame.difference.max_flip);
  return largest;
}

Markup scene_content(const SceneResult& scene, const std::string& id) {
  std::vector<html::Finding> findings;
  if (!name_other_machine(scene.recorded_on, scene.checked_on).empty()) {
    findings.push_back({Tone::caution, whole_sentence(sentence(scene, {FindingKind::elsewhere}))});
  }
  for (const SceneFinding& finding : scene.findings) {
    if (finding.kind == FindingKind::elsewhere) continue;  // comes first
    const std::string text = sentence(scene, finding);
    findings.push_back({&finding == &scene.findings.front() ? tone_of(scene.verdict) : Tone::neutral,
                        finding.kind == FindingKind::error ? text : whole_sentence(text)});
  }
  if (const std::string ignored = describe_ignored(scene); !ignored.empty()) {
    findings.push_back({Tone::neutral, ignored + "."});
  }
  Markup content;
  if (!findings.empty()) content += html::findings(findings);
  if (!scene.rerun_command.empty()) content += html::command("Check this scene again", scene.rerun_command);
  if (!scene.passed() && !scene.accept_command.empty())
    content += html::command("Accept the change", scene.accept_command);
  content += viewer(scene, scene.windows, id);
  if (!scene.animation.empty()) {
    content += html::figure(
        html::animation(scene.animation, scene.stills, "Animation of expected, actual and difference side by side"),
        "Expected, actual and difference around the first frame that changed.");
  }
  if (scene.actual.frames > 0) {
    const auto player = [&](const std::string& what, const html::PlayedMotion& motion) {
      return html::details("Turn the " + what + " motion",
                           html::motion_player(id + "-" + what, motion, "The " + what + " motion of " + scene.name) +
                               html::note(describe(motion)));
    };
    content += player("expected", scene.expected) + player("actual", scene.actual);
  }
  content += figures(scene, scene.windows);
  if (scene.end_to_end) {
    content += html::section(3, id + "-end-to-end", "The whole motion, run from the start",
                             viewer(scene, *scene.end_to_end, id + "-whole") + figures(scene, *scene.end_to_end));
  }
  return content + html::details("How the golden was recorded", provenance(scene));
}

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
  if (report.missing > 0) problems.push_back(describe_missing(report));
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

html::Table overview(const std::vector<const SceneResult*>& scenes) {
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
  return table;
}

Markup introduction(const CheckReport& report) {
  return html::paragraph(html::element("time", {{"datetime", report.date}}, report.date) +
                         fmt::format(", {:.1f} s", report.seconds)) +
         (report.command.empty() ? Markup() : html::command("Run this check again", full_command(report))) +
         (report.accept_command.empty() ? Markup() : html::command("Accept all changes", report.accept_command)) +
         (report.overrides.empty() ? Markup()
                                   : html::paragraph("This check ran with " + html::code(report.overrides) +
                                                     ", so nothing of it can be accepted. First edit the scene files, "
                                                     "then check them again without --set."));
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
  html::Listing listing{"scenes", overview(scenes), {}};
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const SceneResult& scene = *scenes[i];
    const std::string viewer = anchor(i) + "-pictures";
    // The details of an unchanged scene are collapsed.
    const Markup content = scene_content(scene, viewer);
    listing.entries.push_back(
        {anchor(i), verdict_name(scene.verdict),
         html::section(2, anchor(i), Markup(scene.name) + verdict_badge(scene.verdict),
                       failed(scene) ? content : html::details("Pictures and figures", content))});
  }
  page.content = html::listing(listing);
  page.foot = foot(report);
  return html::render(page);
}

void write_html_report(const CheckReport& report, const std::filesystem::path& file) {
  write_file_atomically(file, html_report(report));
}

}  // namespace drape
