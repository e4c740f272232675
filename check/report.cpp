#include "check/report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tinyxml2.h>
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "check/compare_motion.hpp"
#include "check/name_difference.hpp"
#include "core/files.hpp"
#include "core/text.hpp"
#include "reports/latex.hpp"

namespace drape {

bool CheckReport::passed() const {
  return missing == 0 && std::ranges::all_of(scenes, [](const SceneResult& scene) { return scene.passed(); });
}

std::string describe_missing(const CheckReport& report) {
  if (report.missing == 0) return {};
  return fmt::format("{} of {} scenes are in none of the shards", report.missing,
                     report.scenes.size() + report.missing);
}

std::string describe_ignored(const SceneResult& scene) {
  std::vector<int> frames;
  for (const FrameResult& frame : scene.windows.frames) {
    if (!frame.judged) frames.push_back(frame.frame);
  }
  const std::string part = scene.ignored > 0 ? fmt::format("{:.3g} % of the picture", 100 * scene.ignored) : "";
  const std::string whole =
      frames.empty() ? "" : fmt::format("frame{} {}", frames.size() == 1 ? "" : "s", fmt::join(frames, ", "));
  if (part.empty() && whole.empty()) return {};
  const bool several = frames.size() > 1 || (!part.empty() && !whole.empty());
  return part + (part.empty() || whole.empty() ? "" : " and ") + whole + (several ? " are ignored" : " is ignored");
}

std::string picture_verdict(const SceneResult& scene, const Comparison& comparison) {
  const bool judged = scene.ignored < 1 && std::ranges::any_of(comparison.frames, &FrameResult::judged);
  const bool compared = !comparison.frames.empty() && comparison.picture != PictureVerdict::changed;
  return compared && !judged ? "not judged" : verdict_name(comparison.picture);
}

const char* verdict_name(MotionVerdict verdict) {
  switch (verdict) {
    case MotionVerdict::same_bits:
      return "same bits";
    case MotionVerdict::within_tolerance:
      return "within tolerance";
    case MotionVerdict::changed:
      return "changed";
  }
  return "";
}

const char* verdict_name(PictureVerdict verdict) {
  switch (verdict) {
    case PictureVerdict::exact:
      return "exact";
    case PictureVerdict::noise:
      return "noise";
    case PictureVerdict::changed:
      return "changed";
  }
  return "";
}

const char* verdict_name(SceneVerdict verdict) {
  switch (verdict) {
    case SceneVerdict::passed:
      return "passed";
    case SceneVerdict::changed:
      return "changed";
    case SceneVerdict::missing:
      return "missing";
    case SceneVerdict::updated:
      return "updated";
    case SceneVerdict::error:
      return "error";
  }
  return "";
}

std::filesystem::path frame_file(const SceneResult& scene, int frame, const std::string& kind) {
  return std::filesystem::path(scene.name) / fmt::format("frame_{:04}.{}.png", frame, kind);
}

namespace {

/// Returns "half the speed", "twice the speed", "0.8 of the speed".
std::string speed_in_words(double ratio) {
  if (ratio == 0.5) return "half the speed";
  if (ratio == 2) return "twice the speed";
  return ratio > 1 ? fmt::format("{:.3g} times the speed", ratio) : fmt::format("{:.3g} of the speed", ratio);
}

std::string describe(const Difference& d) {
  const double now = d.now.empty() ? 0 : d.now.front(), golden = d.golden.empty() ? 0 : d.golden.front();
  switch (d.of) {
    case Property::mesh:
      return "the pictures cannot be compared: the cloth has different vertices";
    case Property::vertices:
      return fmt::format("the cloth has {} vertices, the golden one {}", now, golden);
    case Property::step:
      return fmt::format("the step is {} s, in the golden {} s", now, golden);
    case Property::steps:
      return fmt::format("the motion has {} steps, the golden one {}", now, golden);
    case Property::size:
      return fmt::format("the pictures have {} pixels, the golden ones {}", fmt::join(d.now, "x"),
                         fmt::join(d.golden, "x"));
    case Property::frame_time:
      return fmt::format("a frame of the film comes every {:g} s of the scene, in the golden every {:g} s", now,
                         golden);
    case Property::frames:
      return fmt::format("the scene compares the frames {}, but the golden has {}", fmt::join(d.now, ", "),
                         fmt::join(d.golden, ", "));
    case Property::speed:
      return fmt::format("the film plays at {} (video.speed is {:g}, in the golden {:g})", speed_in_words(now / golden),
                         now, golden);
    case Property::rate:
      return fmt::format("the film has {:g} frames a second, the golden one {:g}", now, golden);
    case Property::film_size:
      return fmt::format("the film has {} pixels, the golden one {}", fmt::join(d.now, "x"), fmt::join(d.golden, "x"));
    case Property::samples:
      return fmt::format("the film has {} sample{} per pixel, the golden one {}", now, now == 1 ? "" : "s", golden);
  }
  return {};
}

std::string describe_film(const std::vector<Difference>& changes) {
  std::string text;
  for (const Difference& change : changes) text += (text.empty() ? "" : "; ") + describe(change);
  return text;
}

/// @param how "", or " end to end"
std::string describe_pictures(const Comparison& comparison, const char* how) {
  int changed = 0;
  const FrameResult* worst = nullptr;
  for (const FrameResult& frame : comparison.frames) {
    if (!frame.judged || frame.difference.verdict != PictureVerdict::changed) continue;
    ++changed;
    if (worst == nullptr || frame.difference.max_flip > worst->difference.max_flip) worst = &frame;
  }
  if (worst == nullptr) return {};
  const PictureDifference& d = worst->difference;
  return fmt::format(
      "{} of {} pictures changed{}: frame {} by up to {} of 255 in {:.3g} % of the pixels, FLIP error up to {:.3f}{}",
      changed, comparison.frames.size(), how, worst->frame, d.largest_channel, 100 * d.fraction, d.max_flip,
      worst->kind.empty() ? "" : "; it is " + worst->kind);
}

}  // namespace

std::string sentence(const SceneResult& scene, const SceneFinding& finding) {
  switch (finding.kind) {
    case FindingKind::error:
      return finding.text;
    case FindingKind::no_golden:
      return "there is no golden to compare with";
    case FindingKind::first_golden:
      return "there was no golden to compare with; it has now been recorded: look at it";
    case FindingKind::recorded:
      return "the golden was recorded";
    case FindingKind::recorded_again:
      return "the golden was recorded again";
    case FindingKind::method:
      return fmt::format(
          "the golden was recorded with {}, and is compared with that; today the scene has {}: "
          "`drape bless` takes it",
          finding.golden, finding.text);
    case FindingKind::vertex_order:
      return "the vertices are in another order than the golden's, and are matched by the first frame";
    case FindingKind::incomparable:
      return describe(finding.difference);
    case FindingKind::motion:
      return describe_motion(scene.windows.windows);
    case FindingKind::pictures:
      return describe_pictures(scene.windows, "");
    case FindingKind::film:
      return describe_film(scene.film);
    case FindingKind::slow:
      if (!scene.time) return {};
      return fmt::format(
          "the first {} steps take {:.2f} times as long as when the golden was recorded; {:g} is allowed",
          scene.time->steps, scene.time->ratio, scene.settings.time.value_or(0));
    case FindingKind::not_timed:
      return fmt::format("time was not compared: the golden was recorded with {}, and {} is used here",
                         scene.recorded_on.kernels, scene.checked_on.kernels);
    case FindingKind::whole_motion:
      return scene.end_to_end ? "end to end, " + describe_motion(scene.end_to_end->windows) : "";
    case FindingKind::whole_pictures:
      return scene.end_to_end ? describe_pictures(*scene.end_to_end, " end to end") : "";
    case FindingKind::same_motion:
      return "the motion did not change";
    case FindingKind::same_windows:
      return "the motion and the compared pictures did not change";
    case FindingKind::elsewhere:
      return "the golden was recorded " + name_other_machine(scene.recorded_on, scene.checked_on);
    case FindingKind::scene_changed:
      return "the scene file has changed since the golden was recorded";
    case FindingKind::overrides:
      return fmt::format("it was checked with {}: to make that golden, edit the scene and check it again",
                         finding.text);
    case FindingKind::no_candidate:
      return "there is nothing to accept: " + finding.text;
  }
  return {};
}

std::vector<std::string> sentences(const SceneResult& scene) {
  std::vector<std::string> texts;
  for (const SceneFinding& finding : scene.findings) texts.push_back(sentence(scene, finding));
  return texts;
}

using Json = nlohmann::ordered_json;
namespace {

Json to_json(const std::optional<Deviation>& deviation) {
  if (!deviation) return nullptr;
  return {{"step", deviation->step}, {"vertex", deviation->vertex}, {"distance", deviation->distance}};
}

Json to_json(const WindowResult& window) {
  Json deviations = Json::array();
  for (const Deviation& deviation : window.deviations) deviations.push_back(to_json(deviation));
  return {{"first_step", window.first_step},
          {"last_step", window.last_step},
          {"verdict", verdict_name(window.verdict)},
          {"other_bits", window.other_bits ? Json(*window.other_bits) : Json(nullptr)},
          {"first", to_json(window.first)},
          {"largest", to_json(window.largest)},
          {"deviations", std::move(deviations)},
          {"problem", window.problem ? describe_problem(*window.problem) : ""}};
}

/// Returns the JSON of a frame; `prefix` distinguishes the files of an end-to-end comparison.
Json to_json(const SceneResult& scene, const FrameResult& frame, const std::string& prefix) {
  const PictureDifference& d = frame.difference;
  Json json{{"frame", frame.frame},
            {"time", frame.time},
            {"why", frame.why},
            {"verdict", verdict_name(d.verdict)},
            {"pixels", d.pixels},
            {"fraction", d.fraction},
            {"largest_channel", d.largest_channel},
            {"mean_flip", d.mean_flip},
            {"max_flip", d.max_flip},
            {"worst_pixel", d.worst_pixel},
            {"kind", frame.kind},
            {"judged", frame.judged}};
  if (d.verdict == PictureVerdict::exact) return json;
  for (const char* kind : {"expected", "actual", "difference", "flip"}) {
    json["files"][kind] = frame_file(scene, frame.frame, prefix + kind).string();
  }
  return json;
}

Json to_json(const SceneResult& scene, const Comparison& comparison, const std::string& prefix) {
  Json windows = Json::array(), frames = Json::array();
  for (const WindowResult& window : comparison.windows) windows.push_back(to_json(window));
  for (const FrameResult& frame : comparison.frames) frames.push_back(to_json(scene, frame, prefix));
  return {{"motion", verdict_name(comparison.motion)},
          {"picture", verdict_name(comparison.picture)},
          {"first_bad_frame", comparison.first_bad_frame ? Json(*comparison.first_bad_frame) : Json(nullptr)},
          {"windows", std::move(windows)},
          {"frames", std::move(frames)}};
}

Json to_json(const SceneResult& scene) {
  Json json{{"name", scene.name},
            {"file", scene.file.string()},
            {"golden", scene.golden.string()},
            {"verdict", verdict_name(scene.verdict)},
            {"findings", sentences(scene)},
            {"motion_tolerance", scene.settings.motion_tolerance},
            {"limits",
             {{"channel", scene.settings.limits.channel},
              {"pixels", scene.settings.limits.pixels},
              {"flip", scene.settings.limits.flip}}},
            {"size", scene.size},
            {"film", sentence(scene, {FindingKind::film})},
            {"time", sentence(scene, {FindingKind::slow})},
            {"ignored", scene.ignored},
            {"recorded_elsewhere", name_other_machine(scene.recorded_on, scene.checked_on)},
            {"scene_changed", scene.scene_changed},
            {"recorded_at", scene.recorded_at},
            {"recorded_on", to_json(scene.recorded_on)},
            {"rerun", scene.rerun_command},
            {"accept", scene.accept_command},
            {"candidate", scene.candidate},
            {"seconds", scene.seconds},
            {"windows", to_json(scene, scene.windows, "")}};
  if (scene.end_to_end) json["end_to_end"] = to_json(scene, *scene.end_to_end, "end_to_end.");
  if (!scene.animation.empty()) json["animation"] = scene.name + "/difference.gif";
  return json;
}

void write_frames(const SceneResult& scene, const Comparison& comparison, const std::string& prefix,
                  const std::filesystem::path& folder) {
  for (const FrameResult& frame : comparison.frames) {
    if (frame.difference.verdict == PictureVerdict::exact) continue;
    const auto write = [&](const char* kind, const Png& png) {
      write_file_atomically(folder / frame_file(scene, frame.frame, prefix + kind), png);
    };
    write("expected", frame.expected);
    write("actual", frame.actual);
    write("difference", frame.amplified);
    write("flip", frame.flip_map);
  }
}

}  // namespace

std::string json_report(const CheckReport& report) {
  Json scenes = Json::array();
  for (const SceneResult& scene : report.scenes) scenes.push_back(to_json(scene));
  const Json json{{"format", 1},
                  {"passed", report.passed()},
                  {"missing", report.missing},
                  {"command", full_command(report)},
                  {"date", report.date},
                  {"seconds", report.seconds},
                  {"machine", to_json(report.machine)},
                  {"scenes", std::move(scenes)}};
  // File names may be other than UTF-8.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

void write_frame_files(const CheckReport& report, const std::filesystem::path& folder) {
  for (const SceneResult& scene : report.scenes) {
    write_frames(scene, scene.windows, "", folder);
    if (scene.end_to_end) write_frames(scene, *scene.end_to_end, "end_to_end.", folder);
  }
}

namespace {

struct Case {
  const SceneResult* scene;
  std::string name, failure, output;  // `failure` is its message; empty: passed

  [[nodiscard]] bool is_error() const { return scene->verdict == SceneVerdict::error; }
};

Case motion_case(const SceneResult& scene, const Comparison& comparison, const char* name) {
  Case test{&scene, name, {}, verdict_name(comparison.motion)};
  if (comparison.motion == MotionVerdict::changed) {
    test.failure = describe_motion(comparison.windows);
    if (test.failure.empty())
      test.failure = scene.findings.empty() ? "changed" : sentence(scene, scene.findings.front());
  }
  return test;
}

Case picture_case(const SceneResult& scene, const Comparison& comparison, const char* name) {
  Case test{&scene, name, {}, picture_verdict(scene, comparison)};
  if (comparison.picture != PictureVerdict::changed) return test;
  for (const FrameResult& frame : comparison.frames) {
    if (!frame.judged || frame.difference.verdict != PictureVerdict::changed) continue;
    test.failure += fmt::format("{}frame {}: {:.3g} % of the pixels, FLIP error up to {:.3f}",
                                test.failure.empty() ? "changed: " : "; ", frame.frame, 100 * frame.difference.fraction,
                                frame.difference.max_flip);
  }
  if (test.failure.empty()) test.failure = scene.findings.empty() ? "changed" : sentence(scene, scene.findings.back());
  return test;
}

std::vector<Case> cases_of(const SceneResult& scene) {
  if (scene.verdict == SceneVerdict::missing) return {{&scene, "golden", "there is no golden to compare with", {}}};
  if (scene.verdict == SceneVerdict::error)
    return {{&scene, "golden", fmt::format("{}", fmt::join(sentences(scene), "; ")), {}}};
  if (scene.verdict == SceneVerdict::updated) return {{&scene, "golden", {}, "updated"}};
  std::vector<Case> cases{motion_case(scene, scene.windows, "motion"), picture_case(scene, scene.windows, "pictures")};
  if (!scene.film.empty()) cases.push_back({&scene, "film", sentence(scene, {FindingKind::film}), {}});
  if (scene.time) cases.push_back({&scene, "time", sentence(scene, {FindingKind::slow}), {}});
  if (scene.end_to_end) {
    cases.push_back(motion_case(scene, *scene.end_to_end, "motion end to end"));
    cases.push_back(picture_case(scene, *scene.end_to_end, "pictures end to end"));
  }
  return cases;
}

void write(tinyxml2::XMLPrinter& xml, const Case& test) {
  xml.OpenElement("testcase");
  xml.PushAttribute("classname", printable(test.scene->file.string()).c_str());
  xml.PushAttribute("name", test.name.c_str());
  // Only the first case of a scene has the time, which covers all of them.
  xml.PushAttribute(
      "time",
      fmt::format("{:.3f}", test.name == "motion" || test.name == "golden" ? test.scene->seconds : 0.0).c_str());
  if (!test.failure.empty()) {
    xml.OpenElement(test.is_error() ? "error" : "failure");
    xml.PushAttribute("message", printable(test.failure).c_str());
    std::vector<std::string> lines = sentences(*test.scene);
    lines.push_back("rerun: " + test.scene->rerun_command);
    if (const std::string& accept = test.scene->accept_command; !accept.empty()) lines.push_back("accept: " + accept);
    xml.PushText(printable(fmt::format("{}", fmt::join(lines, "\n"))).c_str());
    xml.CloseElement();
  } else if (!test.output.empty()) {
    xml.OpenElement("system-out");
    xml.PushText(test.output.c_str());
    xml.CloseElement();
  }
  xml.CloseElement();
}

/// Writes an error for the scenes that are missing.
void write_missing(tinyxml2::XMLPrinter& xml, const CheckReport& report) {
  xml.OpenElement("testcase");
  xml.PushAttribute("classname", "drape check");
  xml.PushAttribute("name", "shards");
  xml.PushAttribute("time", "0.000");
  xml.OpenElement("error");
  xml.PushAttribute("message", describe_missing(report).c_str());
  xml.CloseElement();
  xml.CloseElement();
}

}  // namespace

std::string junit_report(const CheckReport& report) {
  std::vector<Case> cases;
  const int missing = report.missing > 0 ? 1 : 0;
  int failures = 0, errors = missing;
  for (const SceneResult& scene : report.scenes) {
    for (Case& test : cases_of(scene)) {
      if (!test.failure.empty()) ++(test.is_error() ? errors : failures);
      cases.push_back(std::move(test));
    }
  }
  tinyxml2::XMLPrinter xml;
  xml.PushHeader(false, true);
  xml.OpenElement("testsuites");
  xml.OpenElement("testsuite");
  xml.PushAttribute("name", "drape check");
  xml.PushAttribute("tests", static_cast<int>(cases.size()) + missing);
  xml.PushAttribute("failures", failures);
  xml.PushAttribute("errors", errors);
  xml.PushAttribute("time", fmt::format("{:.3f}", report.seconds).c_str());
  xml.PushAttribute("timestamp", report.date.substr(0, report.date.find('Z')).c_str());
  for (const Case& test : cases) write(xml, test);
  if (missing > 0) write_missing(xml, report);
  xml.CloseElement();
  xml.CloseElement();
  return std::string(xml.CStr()) + "\n";
}

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
  std::string text = fmt::format("### drape check: {}{}{}\n\n",
                                 failed == 0 ? fmt::format("{} scenes are as they were", scenes.size())
                                             : fmt::format("{} of {} scenes failed", failed, scenes.size()),
                                 report.missing > 0 ? ", " : "", describe_missing(report));
  text += "| scene | verdict | motion | pictures | what was found |\n|---|---|---|---|---|\n";
  for (const SceneResult* scene : scenes) {
    const Comparison& windows = scene->windows;
    text += fmt::format("| {} | {} {} | {} | {} | {} |\n", markdown(scene->file.string()), scene->passed() ? "✅" : "❌",
                        verdict_name(scene->verdict), windows.windows.empty() ? "–" : verdict_name(windows.motion),
                        windows.frames.empty() ? "–" : picture_verdict(*scene, windows),
                        markdown(fmt::format("{}", fmt::join(sentences(*scene), "; "))));
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
                        command_text(fmt::format("{}", fmt::join(sentences(scene), "; ")), false));
  }
  return text;
}

}  // namespace drape
