#include "check/junit_report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tinyxml2.h>

#include <string>
#include <vector>

#include "check/compare_motion.hpp"
#include "core/text.hpp"

namespace drape {
namespace {

struct Case {
  const SceneResult* scene;
  std::string name, failure, output;  // `failure` is its message; empty: passed

  [[nodiscard]] bool is_error() const { return scene->verdict == SceneVerdict::error; }
};

std::string sentences(const SceneResult& scene) {
  std::string text;
  for (const std::string& finding : scene.findings) text += finding + "\n";
  return text;
}

Case motion_case(const SceneResult& scene, const Comparison& comparison, const char* name) {
  Case test{&scene, name, {}, verdict_name(comparison.motion)};
  if (comparison.motion == MotionVerdict::changed) {
    test.failure = describe_motion(comparison.windows);
    if (test.failure.empty()) test.failure = scene.findings.empty() ? "changed" : scene.findings.front();
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
  if (test.failure.empty()) test.failure = scene.findings.empty() ? "changed" : scene.findings.back();
  return test;
}

std::vector<Case> cases_of(const SceneResult& scene) {
  if (scene.verdict == SceneVerdict::missing) return {{&scene, "golden", "there is no golden to compare with", {}}};
  if (scene.verdict == SceneVerdict::error)
    return {{&scene, "golden", fmt::format("{}", fmt::join(scene.findings, "; ")), {}}};
  if (scene.verdict == SceneVerdict::updated) return {{&scene, "golden", {}, "updated"}};
  std::vector<Case> cases{motion_case(scene, scene.windows, "motion"), picture_case(scene, scene.windows, "pictures")};
  if (!scene.film.empty()) cases.push_back({&scene, "film", scene.film, {}});
  if (!scene.time.empty()) cases.push_back({&scene, "time", scene.time, {}});
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
    const std::string& accept = test.scene->accept_command;
    xml.PushText(printable(sentences(*test.scene) + "rerun: " + test.scene->rerun_command +
                           (accept.empty() ? "" : "\naccept: " + accept))
                     .c_str());
    xml.CloseElement();
  } else if (!test.output.empty()) {
    xml.OpenElement("system-out");
    xml.PushText(test.output.c_str());
    xml.CloseElement();
  }
  xml.CloseElement();
}

}  // namespace

std::string junit_report(const CheckReport& report) {
  std::vector<Case> cases;
  int failures = 0, errors = 0;
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
  xml.PushAttribute("tests", static_cast<int>(cases.size()));
  xml.PushAttribute("failures", failures);
  xml.PushAttribute("errors", errors);
  xml.PushAttribute("time", fmt::format("{:.3f}", report.seconds).c_str());
  xml.PushAttribute("timestamp", report.date.substr(0, report.date.find('Z')).c_str());
  for (const Case& test : cases) write(xml, test);
  xml.CloseElement();
  xml.CloseElement();
  return std::string(xml.CStr()) + "\n";
}

}  // namespace drape
