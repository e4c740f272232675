#include "check/check_scene.hpp"

#include <gtest/gtest.h>
#include <tinyxml2.h>

#include <nlohmann/json.hpp>

#include "check/golden_folder.hpp"
#include "check/html_report.hpp"
#include "check/json_report.hpp"
#include "check/junit_report.hpp"
#include "check/motion_file.hpp"
#include "check/record_motion.hpp"
#include "core/text.hpp"
#include "tests/support/files.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/usage_error.hpp"

namespace drape {
namespace {

namespace fs = std::filesystem;

constexpr const char* swinging = R"(
[cloth]
mesh = { grid = [6, 6] }
stiffness = 50
pins = ["corner:x-y-"]
[time]
step = 0.02
duration = 2
[integrator]
method = "liu13"
tolerance = 1e-3
[effects.gravity]
[video]
fps = 30
size = [64, 48]
[check]
frames = [0, 10, 25]
)";

class CheckScene : public test::InScratchFolder {
 protected:
  CheckScene() { put(folder_ / "swing.toml", swinging); }

  [[nodiscard]] Scene scene(const std::vector<std::string>& overrides = {}) const {
    return load_scene(folder_ / "swing.toml", overrides);
  }
  void bless() { bless_scene(scene(), scene().check, GlBackend::automatic, {}, progress_); }

  SceneResult check_read(const Scene& of, const CheckOptions& options = {.update = UpdateMode::none}) {
    return check_scene(of, of.name, of.check, options, {}, progress_);
  }
  SceneResult check(const std::vector<std::string>& overrides = {},
                    const CheckOptions& options = {.update = UpdateMode::none}) {
    return check_read(scene(overrides), options);
  }

  [[nodiscard]] fs::path golden() const { return folder_ / "swing.golden"; }

  const std::vector<std::string> as_written;  // no overrides
  Progress progress_;
};

TEST_F(CheckScene, PassesWhatWasJustRecorded) {
  bless();
  const SceneResult result = check();
  EXPECT_EQ(result.verdict, SceneVerdict::passed);
  EXPECT_EQ(result.windows.motion, MotionVerdict::same_bits);
  EXPECT_EQ(result.windows.picture, PictureVerdict::exact);
  EXPECT_TRUE(result.findings.empty());
  EXPECT_FALSE(result.scene_changed);
  ASSERT_EQ(result.windows.windows.size(), 3u);
  // Frame 10 of 30 per second is at 1/3 s, between the steps 16 and 17 of 0.02 s.
  EXPECT_EQ(result.windows.windows[1].first_step, 16);
  EXPECT_EQ(result.windows.windows[1].last_step, 36);
  EXPECT_EQ(result.windows.windows[1].deviations, std::vector<double>(21, 0.0));
  ASSERT_EQ(result.windows.frames.size(), 3u);
  EXPECT_FALSE(result.windows.frames[1].expected.empty());
  EXPECT_TRUE(result.windows.frames[1].actual.empty());
}

TEST_F(CheckScene, WritesAMissingGoldenAndFailsAllTheSame) {
  EXPECT_EQ(check(as_written, {.update = UpdateMode::none}).verdict, SceneVerdict::missing);
  EXPECT_FALSE(fs::exists(golden()));
  EXPECT_EQ(check(as_written, {.update = UpdateMode::missing}).verdict, SceneVerdict::missing);
  EXPECT_TRUE(fs::exists(golden() / "manifest.json"));
  EXPECT_EQ(check(as_written, {.update = UpdateMode::missing}).verdict, SceneVerdict::passed);
}

TEST_F(CheckScene, UpdatesWhatItIsToldTo) {
  EXPECT_EQ(check(as_written, {.update = UpdateMode::changed}).verdict, SceneVerdict::updated);
  const std::string first = test::content(golden() / "motion.bin");
  EXPECT_EQ(check(as_written, {.update = UpdateMode::changed}).verdict, SceneVerdict::passed);
  const std::vector<std::string> heavier{"cloth.mass=2"};
  EXPECT_EQ(check(heavier, {.update = UpdateMode::missing}).verdict, SceneVerdict::changed);
  EXPECT_EQ(test::content(golden() / "motion.bin"), first);
  EXPECT_EQ(check(heavier, {.update = UpdateMode::changed}).verdict, SceneVerdict::updated);
  EXPECT_NE(test::content(golden() / "motion.bin"), first);
  EXPECT_EQ(check(heavier).verdict, SceneVerdict::passed);
  EXPECT_EQ(check(as_written, {.update = UpdateMode::all}).verdict, SceneVerdict::updated);
  EXPECT_EQ(test::content(golden() / "motion.bin"), first);
}

TEST_F(CheckScene, NamesTheStepTheVertexAndTheDistance) {
  bless();
  Scene changed = scene();
  changed.simulation.cloth.positions(20, 2) += 3e-3;
  const SceneResult result = check_read(changed);
  ASSERT_EQ(result.verdict, SceneVerdict::changed);
  const WindowResult& first = result.windows.windows[0];
  ASSERT_TRUE(first.first.has_value());
  EXPECT_EQ(first.first->step, 0);
  EXPECT_EQ(first.first->vertex, 20);
  EXPECT_NEAR(first.first->distance, 3e-3, 1e-12);
  EXPECT_TRUE(result.findings[0].starts_with("the motion changed at step 0 by 3 mm at vertex 20"))
      << result.findings[0];
  // The other windows begin in golden states, and the springs are as long as they were.
  EXPECT_EQ(result.windows.windows[1].verdict, MotionVerdict::same_bits);
  EXPECT_EQ(result.windows.picture, PictureVerdict::exact);
  EXPECT_EQ(result.windows.first_bad_frame, 0);
}

TEST_F(CheckScene, SeesAChangedVelocityInAGoldenState) {
  bless();
  const Golden golden = read_golden(this->golden());
  const auto check_with = [&](std::size_t window, double faster) {
    std::vector<GoldenWindow> windows = golden.windows;
    windows[window].start.v(20, 1) += faster;
    put(this->golden() / "motion.bin", pack_motion(windows, golden.quantum));
    return check();
  };
  for (const double faster : {1e-4, 1e-3, 1.0, 1e6}) {
    const SceneResult first = check_with(0, faster);
    EXPECT_EQ(first.windows.motion, MotionVerdict::changed) << faster;
    EXPECT_NE(first.findings.at(0).find("the velocity at step 0 changed by "), std::string::npos) << first.findings[0];
    EXPECT_NE(first.findings.at(0).find(" m/s at vertex 20"), std::string::npos) << first.findings[0];
    EXPECT_EQ(check_with(2, faster).windows.motion, MotionVerdict::changed) << faster;
    // The second window begins with step 16, whose bits the first one knows.
    EXPECT_NE(test::usage_error([&] { check_with(1, faster); }).find("motion.bin: contradicts itself"),
              std::string::npos);
  }
  // What leads nowhere within the window is what another processor's rounding looks like.
  EXPECT_EQ(check_with(0, 1e-9).windows.motion, MotionVerdict::within_tolerance);
}

TEST_F(CheckScene, SeesAChangedPositionInAGoldenStep) {
  bless();
  Golden golden = read_golden(this->golden());
  golden.windows[1].steps[3].x(20, 1) += 1e-4;
  put(this->golden() / "motion.bin", pack_motion(golden.windows, golden.quantum));
  const SceneResult result = check();
  EXPECT_EQ(result.verdict, SceneVerdict::changed);
  EXPECT_NE(result.findings.at(0).find("the golden is damaged: at step 20 "), std::string::npos) << result.findings[0];
}

TEST_F(CheckScene, ToleratesWhatRoundingDoes) {
  bless();
  Scene shaken = scene();
  for (Spring& spring : shaken.simulation.cloth.springs) spring.rest_length *= 1 + 1e-15;
  const SceneResult result = check_read(shaken);
  EXPECT_EQ(result.verdict, SceneVerdict::passed);
  EXPECT_EQ(result.windows.motion, MotionVerdict::within_tolerance);
  CheckSettings exact = scene().check;
  exact.motion_tolerance = 0;
  EXPECT_EQ(check_scene(shaken, "swing", exact, {.update = UpdateMode::none}, {}, progress_).windows.motion,
            MotionVerdict::changed);
}

TEST_F(CheckScene, ComparesSomeFramesIfAsked) {
  bless();
  const SceneResult result = check(as_written, {.frames = {25}, .update = UpdateMode::none});
  ASSERT_EQ(result.windows.frames.size(), 1u);
  EXPECT_EQ(result.windows.frames[0].frame, 25);
  ASSERT_EQ(result.windows.windows.size(), 2u);  // the motion's start, too
  EXPECT_FALSE(result.windows.windows[0].frame.has_value());
  EXPECT_NE(test::usage_error([&] { check(as_written, {.frames = {3}}); }).find("has no frame 3, only 0, 10, 25"),
            std::string::npos);
}

TEST_F(CheckScene, SeesTheWholeMotionEndToEnd) {
  bless();
  const SceneResult same = check(as_written, {.end_to_end = true, .update = UpdateMode::none});
  ASSERT_TRUE(same.end_to_end.has_value());
  EXPECT_EQ(same.end_to_end->motion, MotionVerdict::same_bits);
  EXPECT_EQ(same.end_to_end->picture, PictureVerdict::exact);

  const SceneResult moved = check({"cloth.stiffness=55"}, {.end_to_end = true, .update = UpdateMode::none});
  EXPECT_EQ(moved.windows.picture, PictureVerdict::exact);
  EXPECT_EQ(moved.end_to_end->picture, PictureVerdict::changed);
  EXPECT_EQ(moved.end_to_end->motion, MotionVerdict::changed);
}

TEST_F(CheckScene, DrawsAFrameAsTheFilmDoes) {
  const Scene film = scene();
  const auto golden = record_motion(film, film.check, plan_windows(film, film.check), {}, progress_);
  ASSERT_TRUE(golden.has_value());
  EXPECT_FALSE(golden->windows[0].shown.has_value());
  ASSERT_TRUE(golden->windows[1].shown.has_value());
  // 1/3 s is two thirds of the way from step 16 to step 17.
  const Vertices between = golden->windows[1].start.x / 3 + 2 * golden->windows[1].steps[0].x / 3;
  EXPECT_LE((between - *golden->windows[1].shown).cwiseAbs().maxCoeff(), 1e-12);
}

TEST_F(CheckScene, SpreadsEightFramesOverTheMotion) {
  CheckSettings settings;
  const std::vector<WindowPlan> plan = plan_windows(scene(), settings);
  ASSERT_EQ(plan.size(), 8u);
  EXPECT_EQ(plan.front().first, 0);
  for (const WindowPlan& window : plan) EXPECT_EQ(window.last - window.first, 20);
  EXPECT_GE(plan.back().last, 98);
  settings.frames = {61};
  EXPECT_NE(test::usage_error([&] { plan_windows(scene(), settings); }).find("the film ends with frame 60"),
            std::string::npos);
}

TEST_F(CheckScene, LoopsAroundTheFirstBadFrame) {
  bless();
  const SceneResult moved = check({"cloth.mass=1.2"}, {.update = UpdateMode::none, .artefacts = folder_ / "report"});
  EXPECT_TRUE(moved.animation.starts_with("GIF89a"));
  EXPECT_EQ(test::content(folder_ / "report/swing/difference.gif"), moved.animation);
  const auto width =
      static_cast<unsigned char>(moved.animation[6]) + 256 * static_cast<unsigned char>(moved.animation[7]);
  EXPECT_EQ(width, 3 * 64 + 2 * 4);
  const SceneResult looks = check({"look.color=red"}, {.update = UpdateMode::none, .artefacts = folder_ / "report"});
  EXPECT_TRUE(looks.animation.starts_with("GIF89a"));
  EXPECT_TRUE(check(as_written, {.update = UpdateMode::none, .artefacts = folder_ / "report"}).animation.empty());
}

TEST_F(CheckScene, ReportsToMachines) {
  bless();
  CheckReport report;
  report.date = "2026-01-31T12:00:00Z";
  report.scenes.push_back(check());
  for (const char* change : {"look.color=red", "cloth.mass=1.2"}) report.scenes.push_back(check({change}));
  report.scenes[1].name = "red & <blue>";
  EXPECT_FALSE(report.passed());
  const auto json = nlohmann::json::parse(json_report(report));
  EXPECT_EQ(json.at("passed"), false);
  EXPECT_EQ(json.at("scenes")[0].at("windows").at("motion"), "same bits");
  EXPECT_EQ(json.at("scenes")[1].at("windows").at("picture"), "changed");
  EXPECT_EQ(json.at("scenes")[1].at("windows").at("motion"), "same bits");
  EXPECT_EQ(json.at("scenes")[2].at("windows").at("windows")[0].at("deviations").size(), 21u);

  write_frame_files(report, folder_ / "report");
  const std::string difference = json.at("scenes")[1].at("windows").at("frames")[0].at("files").at("difference");
  EXPECT_TRUE(test::content(folder_ / "report" / difference).starts_with("\x89PNG"));

  tinyxml2::XMLDocument xml;
  ASSERT_EQ(xml.Parse(junit_report(report).c_str()), tinyxml2::XML_SUCCESS);
  const auto* suite = xml.RootElement()->FirstChildElement("testsuite");
  EXPECT_EQ(suite->IntAttribute("tests"), 6);
  EXPECT_EQ(suite->IntAttribute("failures"), 2);
  int cases = 0, failures = 0;
  for (const auto* test = suite->FirstChildElement("testcase"); test != nullptr; test = test->NextSiblingElement()) {
    ++cases;
    failures += test->FirstChildElement("failure") != nullptr ? 1 : 0;
  }
  EXPECT_EQ(cases, 6);
  EXPECT_EQ(failures, 2);
}

TEST_F(CheckScene, ReportsWhatCannotBeJudged) {
  bless();
  put(golden() / "motion.bin", "drape motion 1\n");
  CheckReport report;
  report.date = "2026-01-31T12:00:00Z";
  Scene odd = scene();
  odd.file = folder_ / "sw\xE4ng\x01.toml";  // Latin-1, and a control character
  try {
    check();
  } catch (const UsageError& error) {
    report.scenes.push_back(unjudged_scene(odd, "swing", odd.check, error));
  }
  ASSERT_EQ(report.scenes.size(), 1u);
  EXPECT_EQ(report.exit_code(), ExitCode::usage);

  const auto json = nlohmann::json::parse(json_report(report));
  EXPECT_EQ(json.at("passed"), false);
  EXPECT_EQ(json.at("scenes")[0].at("verdict"), "error");
  EXPECT_NE(json.at("scenes")[0].at("findings")[0].get<std::string>().find("motion.bin: it is cut off"),
            std::string::npos);

  const std::string junit = junit_report(report);
  EXPECT_EQ(junit, printable(junit));
  tinyxml2::XMLDocument xml;
  ASSERT_EQ(xml.Parse(junit.c_str()), tinyxml2::XML_SUCCESS);
  const auto* suite = xml.RootElement()->FirstChildElement("testsuite");
  EXPECT_EQ(suite->IntAttribute("errors"), 1);
  EXPECT_EQ(suite->IntAttribute("failures"), 0);
  EXPECT_NE(suite->FirstChildElement("testcase")->FirstChildElement("error"), nullptr);

  const std::string page = html_report(report);
  EXPECT_EQ(page, printable(page));
  EXPECT_NE(page.find("The scene could not be judged"), std::string::npos);
}

TEST(CheckReport, IsAsBadAsItsWorstScene) {
  CheckReport report;
  EXPECT_EQ(report.exit_code(), ExitCode::ok);
  const auto add = [&](SceneVerdict verdict, ExitCode error = ExitCode::ok) {
    report.scenes.emplace_back().verdict = verdict;
    report.scenes.back().error = error;
    return report.exit_code();
  };
  EXPECT_EQ(add(SceneVerdict::updated), ExitCode::ok);
  EXPECT_EQ(add(SceneVerdict::missing), ExitCode::differs);
  EXPECT_EQ(add(SceneVerdict::error, ExitCode::diverged), ExitCode::diverged);
  EXPECT_EQ(add(SceneVerdict::error, ExitCode::usage), ExitCode::diverged);
  EXPECT_EQ(add(SceneVerdict::passed), ExitCode::diverged);
}

TEST_F(CheckScene, DrawsIntoAFolderOfAnyName) {
  bless();
  for (const char* name : {"{x}", "a{scene}b", "{frame}", "{"}) {
    const fs::path folder = folder_ / name;
    const SceneResult moved = check({"cloth.mass=1.2"}, {.update = UpdateMode::none, .artefacts = folder});
    EXPECT_EQ(test::content(folder / "swing/difference.gif"), moved.animation) << name;
    EXPECT_TRUE(moved.animation.starts_with("GIF89a")) << name;
  }
}

TEST_F(CheckScene, AnInterruptedRecordingLeavesTheOldGolden) {
  bless();
  const std::string before = test::content(golden() / "manifest.json");
  std::stop_source stop;
  stop.request_stop();
  EXPECT_FALSE(bless_scene(scene(), scene().check, GlBackend::automatic, stop.get_token(), progress_).has_value());
  EXPECT_EQ(test::content(golden() / "manifest.json"), before);
}

TEST_F(CheckScene, SaysWhenItsPrecisionIsTooLow) {
  bless();
  CheckSettings finer = scene().check;
  finer.motion_tolerance = 1e-8;
  const auto message =
      test::usage_error([&] { check_scene(scene(), "swing", finer, {.update = UpdateMode::none}, {}, progress_); });
  EXPECT_NE(message.find("keeps positions to 1e-07 m"), std::string::npos) << message;
}

}  // namespace
}  // namespace drape
