#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "html/motion_player.hpp"
#include "scene/check_settings.hpp"

// What a check found, as plain data: the terminal's lines, the JSON, the JUnit XML and the HTML page are all made from
// it.

namespace drape {

/// How a motion compares with the golden one, from best to worst.
enum class MotionVerdict { same_bits, within_tolerance, changed };

/// How a picture compares with the golden one, from best to worst.
enum class PictureVerdict {
  exact,   ///< the same bytes
  noise,   ///< other bytes, but within every limit: another processor rounds differently
  changed  ///< anything else
};

/// What came out of a scene's check.
enum class SceneVerdict {
  passed,
  changed,  ///< the motion or a picture changed
  missing,  ///< there was no golden to compare with; it is there now unless the check was not to write one
  updated,  ///< the golden was recorded anew because the check was told to
  error     ///< it could not be judged: the golden is damaged, the motion diverged, the picture cannot be drawn, …
};

/// The bytes of a PNG file; empty: there is no such picture.
using Png = std::string;

/// The difference of two pictures of the same size.
struct PictureDifference {
  PictureVerdict verdict = PictureVerdict::exact;
  std::int64_t pixels = 0;           ///< that differ at all
  double fraction = 0;               ///< of all pixels, 0 to 1
  int largest_channel = 0;           ///< the largest difference in any channel, 0 to 255
  double mean_flip = 0;              ///< over all pixels, 0 to 1
  double max_flip = 0;               ///< 0 to 1
  std::array<int, 2> worst_pixel{};  ///< column and row, from the top left, of the largest FLIP error
};

/// One compared frame.
struct FrameResult {
  int frame = 0;       ///< number of the film's frame
  double time = 0;     ///< of the scene [s]
  std::string why;     ///< it is compared: "first contact with the sphere"
  bool judged = true;  ///< or it is shown only, see CheckSettings::ignore_frames
  PictureDifference difference;
  std::string kind;  ///< what kind of difference it is, see name_difference(); empty: none, or no kind of its own
  Png expected;      ///< the golden picture
  Png actual;        ///< this and the next two are empty if the pictures are the same bytes
  Png amplified;     ///< the absolute difference, brightened so that the largest is white
  Png flip_map;      ///< the FLIP error of every pixel in the colours of the map "magma", black 0 to pale yellow 1
};

/// A vertex that is not where it was.
struct Deviation {
  std::int64_t step = 0;
  int vertex = 0;
  double distance = 0;  ///< [m]
};

/// A piece of motion, computed from a golden state.
struct WindowResult {
  std::int64_t first_step = 0, last_step = 0;
  MotionVerdict verdict = MotionVerdict::same_bits;
  std::optional<std::int64_t> other_bits;  ///< the first step that did not end in the same bits; absent: all did
  std::vector<Deviation> deviations;  ///< the worst vertex of every step whose positions are compared; fewer if the
                                      ///< motion diverged
  std::optional<Deviation> first;     ///< the first of them that is beyond the tolerance
  std::optional<Deviation> largest;   ///< of all; absent if there is none
  std::string problem;  ///< a sentence if there is something else to say: that it diverged, or that a body moved
};

/// Motion and pictures of a scene beside its golden ones.
struct Comparison {
  MotionVerdict motion = MotionVerdict::same_bits;  ///< the worst of the windows
  PictureVerdict picture = PictureVerdict::exact;   ///< the worst of the frames
  std::vector<WindowResult> windows;                ///< ascending
  std::vector<FrameResult> frames;                  ///< ascending
  /// The first compared frame whose picture changed, or from which on the motion did.
  std::optional<int> first_bad_frame;
};

/// Where and with what something was computed.
struct Machine {
  std::string drape;      ///< version
  std::string compiler;   ///< "GNU 12.2.0"
  std::string system;     ///< "Linux 6.1.0 x86_64"
  std::string processor;  ///< "Intel(R) Xeon(R) …"
  std::string cpu_flags;  ///< those that matter to floating-point code: "sse2 sse4_1 avx avx2 fma"
  std::string kernels;    ///< instruction set of the simulation's kernels: "avx2"
  std::string renderer;   ///< "llvmpipe (LLVM 15.0.6, 256 bits), OpenGL 3.3 …"
};

struct SceneResult {
  std::string name;              ///< unique in the report: "5", or "homework-5" if there are several of that name
  std::filesystem::path file;    ///< the scene's
  std::filesystem::path golden;  ///< the golden's folder
  SceneVerdict verdict = SceneVerdict::passed;
  ErrorKind error = ErrorKind::usage;  ///< of the verdict "error": what is wrong
  std::vector<std::string> findings;  ///< sentences, most important first: "the motion changed at step 37 by up to …"
  Comparison windows;                 ///< the motion in windows from golden states, and the pictures of those states
  std::optional<Comparison> end_to_end;  ///< the whole motion run again and drawn, if that was asked for

  CheckSettings settings;  ///< with what the command line says
  std::string film;        ///< settings of the film that have changed, as sentences; empty: none
  std::string time;        ///< a sentence if the first steps take too long; empty: they do not, or were not measured
  double ignored = 0;      ///< the part of every picture that is not judged, 0 to 1
  std::string elsewhere;   ///< what was another where the golden was recorded, see name_other_machine()
  bool scene_changed = false;  ///< the scene file has changed since it was recorded
  std::string recorded_at;     ///< "2026-01-31T12:00:00Z"; empty without a golden
  Machine recorded_on;
  std::string renderer;       ///< what drew the pictures now
  std::array<int, 2> size{};  ///< of the pictures [pixels]
  std::string animation;      ///< a GIF's bytes: expected, actual and difference side by side, looping around the
                              ///< first bad frame; empty if there is none
  std::string stills;         ///< some of its moments for paper: a PNG's bytes
  html::PlayedMotion expected,
      actual;             ///< compared states of a changed motion, to turn; without frames: there are none
  std::string candidate;  ///< hash of the candidate that is kept beside the report; empty: there is none
  std::string rerun_command;
  std::string accept_command;  ///< makes what it is now the golden: drape accept, or drape bless without a candidate;
                               ///< empty: no command does, because the check was given other values than the file's
  double seconds = 0;          ///< that the check took

  /// Whether what it is now is kept beside the report, and can be accepted.
  [[nodiscard]] bool has_candidate() const { return !candidate.empty(); }

  /// Whether it is as its golden, or has become it.
  [[nodiscard]] bool passed() const { return verdict == SceneVerdict::passed || verdict == SceneVerdict::updated; }
};

/// A run of `drape check`.
struct CheckReport {
  std::string command;         ///< as it was typed, but for where and how fast it ran
  std::string run_options;     ///< the rest of it: " --report out/ci --jobs 4"; empty in a merged report
  std::string accept_command;  ///< makes everything that changed golden; empty: there is nothing
  std::string date;            ///< "2026-01-31T12:00:00Z"
  Machine machine;
  std::vector<SceneResult> scenes;  ///< in the order of the command line
  double seconds = 0;

  /// Whether nothing changed, nothing was missing, and everything could be judged.
  [[nodiscard]] bool passed() const;
};

/// The command as it was typed.
inline std::string full_command(const CheckReport& report) { return report.command + report.run_options; }

/// "2.1 % of the picture and frame 40 are ignored"; empty if nothing is.
std::string describe_ignored(const SceneResult& scene);

/// What came out of the pictures of a comparison: verdict_name(), or "not judged" where all of them are ignored.
std::string picture_verdict(const SceneResult& scene, const Comparison& comparison);

/// "same bits", "within tolerance", "changed".
const char* verdict_name(MotionVerdict verdict);
/// "exact", "noise", "changed".
const char* verdict_name(PictureVerdict verdict);
/// "passed", "changed", "missing", "updated", "error".
const char* verdict_name(SceneVerdict verdict);

/// The folder of a scene's files beside the report, relative to it: "5/".
/// @returns `name`/frame_0040.KIND.png for "expected", "actual", "difference" and "flip", and with "end_to_end." before
///          those for the pictures of the whole motion
std::filesystem::path frame_file(const SceneResult& scene, int frame, const std::string& kind);

}  // namespace drape
