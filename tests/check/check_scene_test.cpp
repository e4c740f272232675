#include "check/check_scene.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "check/golden_motion.hpp"
#include "check/manifest.hpp"
#include "core/bytes.hpp"
#include "output/png_encoder.hpp"
#include "tests/check/checked_scene.hpp"
#include "tests/support/synthetic_film.hpp"
#include "tests/support/usage_error.hpp"

namespace drape {
namespace {

namespace fs = std::filesystem;

class CheckScene : public test::CheckedScene {};

std::string film_sentence(const SceneResult& result) { return sentence(result, {FindingKind::film}); }

TEST_F(CheckScene, PassesWhatWasJustRecorded) {
  bless();
  const SceneResult result = check();
  EXPECT_EQ(result.verdict, SceneVerdict::passed);
  EXPECT_EQ(result.windows.motion, MotionVerdict::same_bits);
  EXPECT_EQ(result.windows.picture, PictureVerdict::exact);
  EXPECT_TRUE(result.findings.empty());
  EXPECT_FALSE(result.scene_changed);
  // Two seconds in windows of 0.4 s, without a gap.
  ASSERT_EQ(result.windows.windows.size(), 5u);
  for (std::size_t i = 0; i < 5; ++i) {
    const WindowResult& window = result.windows.windows[i];
    EXPECT_EQ(window.first_step, 20 * static_cast<std::int64_t>(i));
    EXPECT_EQ(window.last_step, window.first_step + 20);
    EXPECT_FALSE(window.other_bits.has_value());
    ASSERT_GE(window.deviations.size(), 2u);
    EXPECT_EQ(window.deviations.back().step, window.last_step);
    EXPECT_EQ(window.deviations.back().distance, 0);
  }
  ASSERT_EQ(result.windows.frames.size(), 3u);
  EXPECT_FALSE(result.windows.frames[1].expected.empty());
  EXPECT_TRUE(result.windows.frames[1].actual.empty());
}

TEST_F(CheckScene, SaysThatTheFilmPlaysAtAnotherSpeed) {
  bless();
  const SceneResult half = check({"video.speed=0.5", "video.fps=15"});
  EXPECT_EQ(half.verdict, SceneVerdict::changed);
  EXPECT_EQ(half.windows.motion, MotionVerdict::same_bits);
  EXPECT_EQ(half.windows.picture, PictureVerdict::exact);
  EXPECT_EQ(film_sentence(half),
            "the film plays at half the speed (video.speed is 0.5, in the golden 1); the film has 15 frames a second, "
            "the golden one 30");
  ASSERT_GE(half.findings.size(), 2u);
  EXPECT_EQ(half.findings[0].kind, FindingKind::film);
  EXPECT_EQ(sentences(half)[1], "the motion and the compared pictures did not change");
  EXPECT_EQ(film_sentence(check({"video.speed=2", "video.fps=60"})).find("the film plays at twice the speed"), 0u);
  EXPECT_EQ(film_sentence(check({"video.speed=0.8", "video.fps=24"})).find("the film plays at 0.8 of the speed"), 0u);
  EXPECT_EQ(film_sentence(check({"video.speed=3", "video.fps=90"})).find("the film plays at 3 times the speed"), 0u);
}

TEST_F(CheckScene, SaysThatTheFilmHasAnotherSizeThanItsPictures) {
  put(folder_ / "swing.toml", std::string(test::small_swing) + "size = [32, 24]\n");
  bless();
  EXPECT_EQ(check().verdict, SceneVerdict::passed);
  const SceneResult larger = check({"video.size=[128, 96]"});
  EXPECT_EQ(larger.verdict, SceneVerdict::changed);
  EXPECT_EQ(film_sentence(larger), "the film has 128x96 pixels, the golden one 64x48");
  EXPECT_EQ(larger.windows.picture, PictureVerdict::exact);
}

TEST_F(CheckScene, SaysThatTheFilmHasOtherSamples) {
  bless();
  const SceneResult finer = check({"look.samples=4"});
  EXPECT_EQ(finer.verdict, SceneVerdict::changed);
  EXPECT_EQ(film_sentence(finer), "the film has 4 samples per pixel, the golden one 1");
}

TEST_F(CheckScene, SaysNothingOfTheFilmToAGoldenThatHasNoneOfItsSettings) {
  bless();
  std::string text = test::content(golden() / "manifest.json");
  nlohmann::ordered_json json = nlohmann::ordered_json::parse(text);
  ASSERT_EQ(json.erase("film"), 1u);
  put(golden() / "manifest.json", sealed_manifest(json.dump()));
  const SceneResult half = check({"video.speed=0.5", "video.fps=15"});
  EXPECT_EQ(half.verdict, SceneVerdict::passed);
  EXPECT_TRUE(half.film.empty());
}

// No assertion depends on measured time: the golden's own time is replaced by a far larger or smaller one.
class CheckTime : public CheckScene {
 protected:
  CheckTime() { put(folder_ / "swing.toml", std::string(test::small_swing) + "time = 1.3\n"); }

  void replace_time(double factor) const {
    nlohmann::ordered_json json = nlohmann::ordered_json::parse(test::content(golden() / "manifest.json"));
    json.at("time").at("ratio") = json.at("time").at("ratio").get<double>() * factor;
    put(golden() / "manifest.json", sealed_manifest(json.dump()));
  }
};

TEST_F(CheckTime, FailsWhereTheGoldenTookAFractionOfIt) {
  bless();
  replace_time(1e-3);
  const SceneResult slow = check();
  EXPECT_EQ(slow.verdict, SceneVerdict::changed);
  EXPECT_EQ(slow.windows.motion, MotionVerdict::same_bits);
  EXPECT_EQ(slow.windows.picture, PictureVerdict::exact);
  ASSERT_TRUE(slow.time);
  EXPECT_GT(slow.time->ratio, 1.3);
  ASSERT_FALSE(slow.findings.empty());
  EXPECT_EQ(slow.findings[0].kind, FindingKind::slow);
  const std::string text = sentences(slow)[0];
  EXPECT_EQ(text.find("the first "), 0u) << text;
  EXPECT_NE(text.find("times as long as when the golden was recorded; 1.3 is allowed"), std::string::npos);
}

TEST_F(CheckTime, PassesWhereTheGoldenTookFarLonger) {
  bless();
  replace_time(1e3);
  const SceneResult fast = check();
  EXPECT_EQ(fast.verdict, SceneVerdict::passed);
  EXPECT_FALSE(fast.time);
}

TEST_F(CheckTime, NeedsAGoldenThatHasOne) {
  put(folder_ / "swing.toml", test::small_swing);
  bless();
  EXPECT_EQ(test::content(golden() / "manifest.json").find("\"time\": {"), std::string::npos);
  try {
    check({"check.time=1.3"});
    FAIL() << "there is nothing to compare with";
  } catch (const UsageError& error) {
    EXPECT_NE(std::string(error.what()).find("holds no time to compare with"), std::string::npos) << error.what();
  }
}

TEST_F(CheckTime, IsNotComparedBetweenInstructionSets) {
  bless();
  replace_time(1e-3);
  nlohmann::ordered_json json = nlohmann::ordered_json::parse(test::content(golden() / "manifest.json"));
  json.at("machine").at("kernels") = "abacus";
  put(golden() / "manifest.json", sealed_manifest(json.dump()));
  const SceneResult result = check();
  EXPECT_EQ(result.verdict, SceneVerdict::passed);
  ASSERT_FALSE(result.findings.empty());
  EXPECT_EQ(sentences(result)[0].find("time was not compared: the golden was recorded with abacus"), 0u);
}

TEST_F(CheckTime, IsMeasuredOverNoMoreThanTheMotion) {
  const std::optional<GoldenTime> time = measure_step_time(scene(), 0, {});
  ASSERT_TRUE(time);
  EXPECT_GE(time->steps, 1);
  EXPECT_LE(time->steps, scene().step_count());
  EXPECT_GT(time->ratio, 0);
  std::stop_source stopped;
  stopped.request_stop();
  EXPECT_FALSE(measure_step_time(scene(), 0, stopped.get_token()));
}

TEST_F(CheckScene, DrawsFromWhereAMovingCameraIsInEachFrame) {
  const std::vector<std::string> moving{"camera.follow=true", "camera.orbit=90"};
  const LoadedScene recorded = scene(moving);
  bless_scene(recorded, recorded.check, GlBackend::automatic, {}, progress_);
  const Golden golden_now = read_golden(golden());
  EXPECT_NE(golden_now.frames[0].view.position, golden_now.frames[1].view.position);
  EXPECT_EQ(check(moving).windows.picture, PictureVerdict::exact);
  EXPECT_EQ(check(moving, {.frames = {25}, .update = UpdateMode::none}).windows.picture, PictureVerdict::exact);
  const SceneResult whole = check(moving, {.end_to_end = true, .update = UpdateMode::none});
  EXPECT_EQ(whole.end_to_end->picture, PictureVerdict::exact);
  EXPECT_EQ(check({"camera.follow=true", "camera.orbit=91"}).windows.picture, PictureVerdict::changed);
  EXPECT_EQ(check({"camera.follow=true"}).windows.picture, PictureVerdict::changed);
  EXPECT_EQ(check({"camera.orbit=90"}).windows.picture, PictureVerdict::changed);
}

TEST_F(CheckScene, WritesAMissingGoldenAndFailsAllTheSame) {
  EXPECT_EQ(check(as_written, {.update = UpdateMode::none}).verdict, SceneVerdict::missing);
  EXPECT_FALSE(fs::exists(golden()));
  EXPECT_EQ(check(as_written, {.update = UpdateMode::missing}).verdict, SceneVerdict::missing);
  EXPECT_TRUE(fs::exists(golden() / "manifest.json"));
  EXPECT_EQ(check(as_written, {.update = UpdateMode::missing}).verdict, SceneVerdict::passed);
}

TEST_F(CheckScene, UpdatesWhatItIsToldTo) {
  EXPECT_EQ(check(as_written, {.update = UpdateMode::all}).verdict, SceneVerdict::updated);
  const std::string first = test::content(golden() / "motion.bin");
  const std::vector<std::string> heavier{"cloth.mass=2"};
  EXPECT_EQ(check(heavier, {.update = UpdateMode::missing}).verdict, SceneVerdict::changed);
  EXPECT_EQ(test::content(golden() / "motion.bin"), first);
  EXPECT_EQ(check(heavier, {.update = UpdateMode::all}).verdict, SceneVerdict::updated);
  EXPECT_NE(test::content(golden() / "motion.bin"), first);
  EXPECT_EQ(check(heavier).verdict, SceneVerdict::passed);
  EXPECT_EQ(check(as_written, {.update = UpdateMode::all}).verdict, SceneVerdict::updated);
  EXPECT_EQ(test::content(golden() / "motion.bin"), first);
}

/// Returns overrides for a small sphere with keyframes that never meets the cloth.
std::vector<std::string> bystander(const std::string& keyframes) {
  return {"effects.sphere.radius=0.1", "effects.sphere.keyframes=" + keyframes};
}

TEST_F(CheckScene, SeesWhatActsForAMomentOnly) {
  // A pin that is released, moved, or held longer, at any time of the film.
  const auto with_pins = [](const std::string& release, const std::string& offset) {
    return std::vector<std::string>{"effects.moving_pins.pins=[0]", "effects.moving_pins.release=" + release,
                                    "effects.moving_pins.keyframes=[{ time = 0.5, offset = [0, 0, " + offset + "] }]"};
  };
  const LoadedScene recorded = scene(with_pins("1.5", "0.1"));
  bless_scene(recorded, recorded.check, GlBackend::automatic, {}, progress_);
  EXPECT_EQ(check(with_pins("1.5", "0.1")).windows.motion, MotionVerdict::same_bits);
  EXPECT_EQ(check(with_pins("1.5", "0.10001")).windows.motion, MotionVerdict::changed);
  const SceneResult later = check(with_pins("1.52", "0.1"));
  EXPECT_EQ(later.windows.motion, MotionVerdict::changed);
  for (const WindowResult& window : later.windows.windows) {
    EXPECT_EQ(window.verdict == MotionVerdict::changed, window.first_step == 60) << window.first_step;
  }
  // The step that begins at 1.5 s is the first without the pin.
  EXPECT_EQ(later.windows.windows[3].other_bits, 76);
}

/// A tight cloth between held borders. A pulse moves it from 0.02 s to 0.05 s; it is at rest again after 0.2 s, where
/// positions are stored.
std::string pulse(const std::string& acceleration) {
  return R"(
[cloth]
mesh = { grid = [6, 6], size = [2.2, 2.2] }
rest = { grid = [6, 6], size = [2, 2] }
stiffness = 2000
pins = ["border"]
[time]
step = 0.005
duration = 0.8
[integrator]
method = "implicit"
[effects.field]
acceleration = [0, 0, "t > 0.02 && t < 0.05 ? )" +
         acceleration + R"( : 0"]
[effects.damping]
factor = 1e-60
[video]
fps = 25
size = [64, 48]
[check]
frames = [0]
)";
}

TEST_F(CheckScene, SeesAPulseBetweenStoredPositions) {
  put(folder_ / "swing.toml", pulse("50"));
  bless();
  EXPECT_EQ(check().windows.motion, MotionVerdict::same_bits);
  put(folder_ / "swing.toml", pulse("0"));
  const SceneResult other = check();
  EXPECT_EQ(other.windows.motion, MotionVerdict::changed);
  EXPECT_NE(sentences(other).at(0).find(" the mean of some vertices is "), std::string::npos) << sentences(other).at(0);
}

TEST_F(CheckScene, ReadsAGoldenOfFormat3) {
  bless();
  Golden golden = read_golden(this->golden());
  golden.group_count = 0;
  const std::string motion = pack_motion(golden);
  nlohmann::ordered_json json = nlohmann::ordered_json::parse(manifest_text(golden, checksum_of(motion)));
  json["format"] = 3;
  json.erase("groups");
  put(this->golden() / "motion.bin", motion);
  put(this->golden() / "manifest.json", sealed_manifest(json.dump()));
  EXPECT_EQ(check().verdict, SceneVerdict::passed);
}

TEST(GroupMeans, MoveAsTheVerticesDo) {
  const Vertices x = Vertices::Random(500, 3);
  Vertices moved = x;
  moved.rowwise() += Eigen::RowVector3d(0, 3e-6, 4e-6);
  const std::vector<double> before = group_means(x, group_count), after = group_means(moved, group_count);
  for (std::size_t k = 0; k < before.size(); k += 3) {
    const double distance =
        std::hypot(after[k] - before[k], after[k + 1] - before[k + 1], after[k + 2] - before[k + 2]);
    EXPECT_NEAR(distance, 5e-6, 1e-15);
  }
}

TEST(GroupMeans, SeeAMotionWhoseMeanIsZero) {
  // Two halves of a cloth, and alternate vertices, move in opposite directions.
  for (const int stripe : {1, 250}) {
    Vertices moved = Vertices::Zero(500, 3);
    for (int i = 0; i < 500; ++i) moved(i, 2) = i / stripe % 2 == 0 ? 1 : -1;
    const std::vector<double> means = group_means(moved, group_count);
    EXPECT_GT(std::abs(*std::ranges::max_element(means, {}, [](double m) { return std::abs(m); })), 0.02) << stripe;
  }
}

TEST(GroupMeans, LeaveAGroupWithoutVerticesAtTheOrigin) {
  const std::vector<double> means = group_means(Vertices::Constant(1, 3, 2.), group_count);
  EXPECT_EQ(std::ranges::count(means, 2.), 3);
  EXPECT_EQ(std::ranges::count(means, 0.), 3 * (group_count - 1));
}

TEST_F(CheckScene, SeesABodyMoveThatTouchesNothing) {
  const std::string still = "[{ time = 0, center = [9, 9, 9] }, { time = 1, center = [9, 9, 9] }]";
  const std::string passing =
      "[{ time = 0, center = [9, 9, 9] }, { time = 0.5, center = [9, 9, 9] }, "
      "{ time = 0.55, center = [9, 9, 9.001] }, { time = 0.6, center = [9, 9, 9] }]";
  const LoadedScene recorded = scene(bystander(still));
  bless_scene(recorded, recorded.check, GlBackend::automatic, {}, progress_);
  EXPECT_EQ(check(bystander(still)).windows.motion, MotionVerdict::same_bits);
  const SceneResult moved = check(bystander(passing));
  EXPECT_EQ(moved.windows.motion, MotionVerdict::changed);
  const std::string text = sentences(moved).at(0);
  EXPECT_NE(text.find("sphere 1 is "), std::string::npos) << text;
  EXPECT_NE(text.find(" from its golden position"), std::string::npos) << text;
}

TEST_F(CheckScene, EndToEndIsTheMotionThatWasRecorded) {
  // The windows begin in rounded states, and so does the end-to-end motion.
  bless();
  const Golden recorded = read_golden(golden());
  ASSERT_GT(recorded.quanta.position, 0);
  const auto again = record_motion(scene(), scene().check, plan_of(recorded), {}, progress_);
  ASSERT_TRUE(again.has_value());
  for (std::size_t i = 0; i < recorded.windows.size(); ++i) {
    EXPECT_EQ(again->windows[i].start.x, recorded.windows[i].start.x) << i;
    EXPECT_EQ(again->windows[i].start.v, recorded.windows[i].start.v) << i;
  }
}

TEST_F(CheckScene, KeepsPinsAndConstraintsExact) {
  const LoadedScene limited = scene({"effects.strain_limit.max_stretch=1.05"});
  EXPECT_EQ(quanta_for(limited.simulation, 1e-6).position, 0);
  const RoundingUnits quanta = quanta_for(scene().simulation, 1e-6);
  EXPECT_GT(quanta.position, 1e-10);
  EXPECT_LT(quanta.position, 1e-8);
  State state{Vertices::Constant(3, 3, 1 / 3.0), Vertices::Constant(3, 3, 1 / 7.0), 4};
  const State kept = rounded(state, {1}, quanta);
  EXPECT_EQ(kept.x.row(1), state.x.row(1));
  EXPECT_NE(kept.x.row(0), state.x.row(0));
  EXPECT_LE((kept.x - state.x).cwiseAbs().maxCoeff(), quanta.position / 2);
  EXPECT_EQ(rounded(kept, {1}, quanta).x, kept.x);
}

TEST_F(CheckScene, DrawsAFrameAsTheFilmDoes) {
  const LoadedScene film = scene();
  const auto plan = plan_recording(film, film.check, {}, progress_);
  const auto golden = record_motion(film, film.check, *plan, {}, progress_);
  ASSERT_TRUE(golden.has_value());
  // Frame 10 at 30 per second is at 1/3 s, two thirds of the way from step 16 to step 17.
  Simulation simulation(film.simulation);
  while (simulation.state().step < 16) simulation.step();
  const Vertices before = simulation.state().x;
  simulation.step();
  const Vertices between = before / 3 + 2 * simulation.state().x / 3;
  EXPECT_LE((between - golden->frames[1].x).cwiseAbs().maxCoeff(), golden->quanta.position);
}

TEST_F(CheckScene, IgnoresWhatItIsToldTo) {
  bless();
  const SceneResult changed = check({"look.color=red"});
  EXPECT_EQ(changed.windows.picture, PictureVerdict::changed);
  const SceneResult all = check({"look.color=red", "check.ignore=[[0, 0, 64, 24], [0, 20, 64, 28]]"});
  EXPECT_EQ(all.verdict, SceneVerdict::passed);
  EXPECT_EQ(all.ignored, 1);
  EXPECT_EQ(describe_ignored(all), "100 % of the picture is ignored");
  const SceneResult corner = check({"look.color=red", "check.ignore=[[0, 0, 8, 6], [60, 40, 100, 100]]"});
  EXPECT_EQ(corner.verdict, SceneVerdict::changed);
  EXPECT_DOUBLE_EQ(corner.ignored, (8 * 6 + 4 * 8) / (64.0 * 48));
  const SceneResult frames = check({"look.color=red", "check.ignore_frames=[0, 10, 25]"});
  EXPECT_EQ(frames.verdict, SceneVerdict::passed);
  EXPECT_EQ(describe_ignored(frames), "frames 0, 10, 25 are ignored");
  EXPECT_EQ(check({"look.color=red", "check.ignore_frames=[0, 10]"}).verdict, SceneVerdict::changed);
}

TEST_F(CheckScene, RefusesAPictureThatSomebodyChanged) {
  bless();
  put(golden() / "frames/0010.png", encode_png(test::plain_image(64, 48, {1, 2, 3})));
  EXPECT_EQ(test::usage_error([&] { check(); }),
            (golden() / "frames/0010.png").string() +
                ": has been modified since it was recorded; restore it, or record it again with drape bless");
}

TEST_F(CheckScene, NamesTheStepTheVertexAndTheDistance) {
  bless();
  LoadedScene changed = scene();
  changed.simulation.cloth.positions(20, 2) += 3e-3;
  const SceneResult result = check_read(changed);
  ASSERT_EQ(result.verdict, SceneVerdict::changed);
  const WindowResult& first = result.windows.windows[0];
  ASSERT_TRUE(first.first.has_value());
  EXPECT_EQ(first.first->step, 0);
  EXPECT_EQ(first.first->vertex, 20);
  EXPECT_NEAR(first.first->distance, 3e-3, 1e-12);
  EXPECT_EQ(sentences(result)[0].find("the motion changed at step 0 by 3 mm at vertex 20"), 0u) << sentences(result)[0];
  // The other windows begin in golden states, and the springs keep their length.
  EXPECT_EQ(result.windows.windows[1].verdict, MotionVerdict::same_bits);
  EXPECT_EQ(result.windows.picture, PictureVerdict::exact);
  EXPECT_EQ(result.windows.first_bad_frame, 0);
}

TEST_F(CheckScene, ToleratesWhatRoundingDoes) {
  bless();
  LoadedScene shaken = scene();
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
  EXPECT_EQ(result.windows.windows.size(), 5u);  // the whole motion, whatever the frames
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
  EXPECT_NE(message.find("stores positions to 6e-08 m"), std::string::npos) << message;
}

}  // namespace
}  // namespace drape
