#include "check/finding.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "check/compare_motion.hpp"
#include "check/name_difference.hpp"
#include "check/report.hpp"

namespace drape {
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

}  // namespace drape
