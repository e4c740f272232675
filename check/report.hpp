#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "drape/core/error.hpp"
#include "drape/scene/scene.hpp"
#include "reports/players.hpp"

// Results of a check as plain data, from which terminal output, JSON, JUnit XML and HTML page are made.

namespace drape {

struct SceneResult;

/// Properties of a scene and its film that may differ from the golden's.
enum class Property { mesh, vertices, step, steps, size, frame_time, frames, speed, rate, film_size, samples };

/// A property that differs from the golden's: one number, a size [pixels], or the numbers of frames; for a mesh none.
struct Difference {
  Property of = Property::mesh;
  std::vector<double> golden, now;
};

/// First steps that take too long.
struct SlowSteps {
  std::int64_t steps = 0;
  double ratio = 0;  ///< their time relative to the golden one
};

/// Kinds of findings.
enum class FindingKind {
  error,  ///< the scene was not judged; the text is a message
  no_golden,
  first_golden,  ///< there was no golden; this check recorded it
  recorded,
  recorded_again,
  method,        ///< SceneFinding::golden is the recorded method, the text today's
  vertex_order,  ///< the vertices were matched by the first frame
  incomparable,  ///< because of SceneFinding::difference
  motion,        ///< SceneResult::windows
  pictures,
  film,          ///< SceneResult::film
  slow,          ///< SceneResult::time
  not_timed,     ///< time was not compared, as it depends on the instruction set
  whole_motion,  ///< SceneResult::end_to_end
  whole_pictures,
  same_motion,   ///< only the pictures changed
  same_windows,  ///< the motion and the pictures did not change
  elsewhere,     ///< SceneResult::recorded_on
  scene_changed,
  overrides,    ///< the text is the options
  no_candidate  ///< the text is the error that prevents a candidate
};

/// A fact that a check found.
struct SceneFinding {
  FindingKind kind = FindingKind::error;
  std::string text = {}, golden = {};
  Difference difference = {};
};

/// Returns a finding without capital and full stop: "the motion changed at step 37 by 2.1 mm at vertex 213". Empty if
/// the result lacks the values of that kind.
std::string sentence(const SceneResult& scene, const SceneFinding& finding);

/// Returns the sentences of all findings, most important first.
std::vector<std::string> sentences(const SceneResult& scene);

/// Agreement of a motion with the golden one, from best to worst.
enum class MotionVerdict { same_bits, within_tolerance, changed };

/// Agreement of a picture with the golden one, from best to worst.
enum class PictureVerdict {
  exact,   ///< equal bytes
  noise,   ///< within all limits; rounding differs between processors
  changed  ///< beyond a limit
};

/// Outcome of checking one scene.
enum class SceneVerdict {
  passed,
  changed,  ///< the motion or a picture changed
  missing,  ///< there was no golden; the check has written one unless told otherwise
  updated,  ///< the golden was recorded again on request
  error     ///< not judged: damaged golden, diverged motion, drawing failed, …
};

/// The bytes of a PNG file; empty: no picture.
using Png = std::string;

/// The difference of two pictures of the same size.
struct PictureDifference {
  PictureVerdict verdict = PictureVerdict::exact;
  std::int64_t pixels = 0;           ///< number of differing pixels
  double fraction = 0;               ///< share of all pixels, 0 to 1
  int largest_channel = 0;           ///< largest difference in any channel, 0 to 255
  double mean_flip = 0;              ///< mean over all pixels, 0 to 1
  double max_flip = 0;               ///< 0 to 1
  std::array<int, 2> worst_pixel{};  ///< column and row of the largest FLIP error, from the top left
};

/// One compared frame.
struct FrameResult {
  int frame = 0;       ///< number in the film
  double time = 0;     ///< time in the scene [s]
  std::string why;     ///< reason for its choice: "first contact with the sphere"
  bool judged = true;  ///< false: shown only, see CheckSettings::ignore_frames
  PictureDifference difference;
  std::string kind;  ///< kind of difference, see classify_difference(); empty: none or unnamed
  Png expected;      ///< the golden picture
  Png actual;        ///< this and the next two are empty for equal bytes
  Png amplified;     ///< absolute difference, brightened so that the largest is white
  Png flip_map;      ///< FLIP error per pixel in the colours of "magma", black 0 to pale yellow 1
};

/// A displaced vertex.
struct Deviation {
  std::int64_t step = 0;
  int vertex = 0;
  double distance = 0;  ///< [m]
};

/// A change of a window other than positions beyond the tolerance.
enum class WindowFault { diverged, other_bodies, moved_body, velocity, energies };

/// A fault of a window, and the values that show it.
struct WindowProblem {
  WindowFault fault = WindowFault::diverged;
  std::int64_t step = 0;
  int vertex = 0;                 ///< vertex whose velocity changed
  std::string of;                 ///< the moved body, or the message of a divergence
  double actual = 0, golden = 0;  ///< distance of a body [m], speed of a velocity's change [m/s], total energies [J]
};

/// A window of the motion, simulated from a golden state.
struct WindowResult {
  std::int64_t first_step = 0, last_step = 0;
  MotionVerdict verdict = MotionVerdict::same_bits;
  std::optional<std::int64_t> other_bits;  ///< first step with different bits; absent: none
  std::vector<Deviation> deviations;       ///< largest deviation in each compared step; fewer after a divergence
  std::optional<Deviation> first;          ///< first deviation beyond the tolerance
  std::optional<Deviation> largest;        ///< largest of all deviations; absent if there is none
  std::optional<WindowProblem> problem;    ///< the first other change
};

/// The motion and pictures of a scene compared with its golden.
struct Comparison {
  MotionVerdict motion = MotionVerdict::same_bits;  ///< the worst of the windows
  PictureVerdict picture = PictureVerdict::exact;   ///< the worst of the frames
  std::vector<WindowResult> windows;                ///< ascending
  std::vector<FrameResult> frames;                  ///< ascending
  /// First compared frame with a changed picture, or after the first change of the motion.
  std::optional<int> first_bad_frame;
};

/// The machine and the program of a computation.
struct Machine {
  std::string drape;      ///< version
  std::string compiler;   ///< "GNU 12.2.0"
  std::string system;     ///< "Linux 6.1.0 x86_64"
  std::string processor;  ///< "Intel(R) Xeon(R) …"
  std::string cpu_flags;  ///< flags relevant to floating-point code: "sse2 sse4_1 avx avx2 fma"
  std::string kernels;    ///< instruction set of the simulation's kernels: "avx2"
  std::string renderer;   ///< "llvmpipe (LLVM 15.0.6, 256 bits), OpenGL 3.3 …"
};

struct SceneResult {
  std::string name;              ///< unique in the report: "5", or "homework-5" for duplicate names
  std::filesystem::path file;    ///< the scene file
  std::filesystem::path golden;  ///< folder of the golden
  SceneVerdict verdict = SceneVerdict::passed;
  ErrorKind error = ErrorKind::usage;    ///< category, for the verdict "error"
  std::vector<SceneFinding> findings;    ///< most important first
  Comparison windows;                    ///< windows from golden states, and the pictures of those states
  std::optional<Comparison> end_to_end;  ///< the whole motion, run again and drawn; absent if not requested

  CheckSettings settings;         ///< settings with the command line's changes
  std::vector<Difference> film;   ///< changed film settings
  std::optional<SlowSteps> time;  ///< absent: in time, or not measured
  double ignored = 0;             ///< share of each picture that is not judged, 0 to 1
  bool scene_changed = false;     ///< the scene file differs from the recorded one
  std::string recorded_at;        ///< "2026-01-31T12:00:00Z"; empty without a golden
  Machine recorded_on;
  Machine checked_on;         ///< with the renderer of the new pictures
  std::array<int, 2> size{};  ///< size of the pictures [pixels]
  std::string animation;      ///< GIF bytes: expected, actual and difference side by side, around the first bad frame;
                              ///< empty: none
  std::string stills;         ///< PNG bytes: some frames of the animation for print
  html::PlayedMotion expected,
      actual;             ///< compared states of a changed motion, for interactive viewing; without frames: none
  std::string candidate;  ///< hash of the candidate beside the report; empty: none
  std::string rerun_command;
  std::string accept_command;  ///< makes the candidate golden: drape accept, or drape bless without one; empty for a
                               ///< check with overrides
  double seconds = 0;          ///< duration of the check

  /// Returns true if the report has a candidate of this scene to accept.
  [[nodiscard]] bool has_candidate() const { return !candidate.empty(); }

  /// Returns true if the scene equals its golden, or was recorded again.
  [[nodiscard]] bool passed() const { return verdict == SceneVerdict::passed || verdict == SceneVerdict::updated; }
};

/// The results of one `drape check`.
struct CheckReport {
  std::string command;         ///< command without the options below
  std::string run_options;     ///< options for output and speed: " --report out/ci --jobs 4"; empty in a merged report
  std::string typed_command;   ///< command line as typed; empty in a merged report
  std::string overrides;       ///< "--set cloth.mass=2"; empty: none, or a merged report
  std::string accept_command;  ///< accepts all changes; empty: there are none
  std::string date;            ///< "2026-01-31T12:00:00Z"
  Machine machine;
  std::vector<SceneResult> scenes;  ///< results in the order of the command line
  double seconds = 0;
  std::size_t missing = 0;  ///< number of scenes in shards that were not merged

  /// Returns true if every scene was judged, had a golden, and passed, and none is missing.
  [[nodiscard]] bool passed() const;
};

/// Returns the command line as typed; for a merged report, one for the whole check.
inline std::string full_command(const CheckReport& report) {
  return report.typed_command.empty() ? report.command + report.run_options : report.typed_command;
}

/// Returns "2 of 5 scenes are in none of the shards"; empty if none is missing.
std::string describe_missing(const CheckReport& report);

/// Returns "2.1 % of the picture and frame 40 are ignored"; empty if nothing is.
std::string describe_ignored(const SceneResult& scene);

/// Returns the verdict on the pictures of a comparison: verdict_name(), or "not judged" if all of them are ignored.
std::string picture_verdict(const SceneResult& scene, const Comparison& comparison);

/// Returns "same bits", "within tolerance" or "changed".
const char* verdict_name(MotionVerdict verdict);
/// Returns "exact", "noise" or "changed".
const char* verdict_name(PictureVerdict verdict);
/// Returns "passed", "changed", "missing", "updated" or "error".
const char* verdict_name(SceneVerdict verdict);

/// Returns the path of a scene's picture, relative to the report.
/// @returns `name`/frame_0040.KIND.png for "expected", "actual", "difference" and "flip"; KIND has the prefix
/// "end_to_end." for pictures of the whole motion
std::filesystem::path frame_file(const SceneResult& scene, int frame, const std::string& kind);

/// Returns the report as JSON: everything except the pictures, which are files beside it, see frame_file().
std::string json_report(const CheckReport& report);

/// Writes the pictures of all frames that are not exact as PNG files below a folder, named by frame_file().
/// @throws OutputError
void write_frame_files(const CheckReport& report, const std::filesystem::path& folder);

/// Returns JUnit XML for continuous-integration servers. Each scene has a test case for its motion and one for its
/// pictures, and two more if it was checked end to end.
std::string junit_report(const CheckReport& report);

/// Returns a check's results as Markdown for a GitHub job summary: a table of the scenes, failed ones first.
std::string github_summary(const CheckReport& report);

/// Returns a line for each failed scene, which GitHub shows beside the scene's file.
std::string github_annotations(const CheckReport& report);

}  // namespace drape
