#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "check/finding.hpp"
#include "drape/core/error.hpp"
#include "drape/scene/scene.hpp"
#include "reports/players.hpp"

namespace drape {

using Words = std::vector<std::uint64_t>;

/// Serialises words: the most significant bytes of all words first, then the next ones, compressed by zlib. A line with
/// the unpacked size comes first.
std::string pack_words(const Words& words);

/// Reads these bytes.
/// @param most largest number of words; larger data are rejected before decompression
/// @throws std::invalid_argument that describes the error in the bytes
Words unpack_words(std::string_view bytes, std::uint64_t most);

/// Writer of numbers as words.
class WordWriter {
 public:
  /// Writes a number in zigzag encoding, which maps 0, −1, 1, −2, … to small unsigned numbers.
  void whole(std::int64_t n) { bits((static_cast<std::uint64_t>(n) << 1) ^ static_cast<std::uint64_t>(n >> 63)); }
  void bits(std::uint64_t n) { words_.push_back(n); }
  void number(double value) { bits(std::bit_cast<std::uint64_t>(value)); }
  [[nodiscard]] const Words& words() const { return words_; }

 private:
  Words words_;
};

/// Reader of words.
/// @throws std::invalid_argument at the end of the data, or for an invalid number
class WordReader {
 public:
  explicit WordReader(Words words) : words_(std::move(words)) {}

  std::uint64_t bits() {
    need(1);
    return words_[next_++];
  }
  std::int64_t whole() {
    const std::uint64_t n = bits();
    return static_cast<std::int64_t>(n >> 1) ^ -static_cast<std::int64_t>(n & 1);
  }
  std::int64_t whole(std::int64_t least, std::int64_t most) {
    const std::int64_t n = whole();
    if (n < least || n > most) throw std::invalid_argument("holds a number that makes no sense");
    return n;
  }
  double number();
  /// Checks that enough words follow, before memory is allocated for them.
  void need(std::uint64_t words) const {
    if (words > words_.size() - next_) throw std::invalid_argument("is truncated");
  }
  [[nodiscard]] bool at_end() const { return next_ == words_.size(); }

 private:
  Words words_;
  std::size_t next_ = 0;
};

/// Returns the number if it is finite. @throws std::invalid_argument otherwise
double finite(double value);

}  // namespace drape

// Results of a check as plain data, from which terminal output, JSON, JUnit XML and HTML page are made.

namespace drape {

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

/// Such a change, and the values that show it.
struct WindowProblem {
  WindowFault fault = WindowFault::diverged;
  std::int64_t step = 0;
  int vertex = 0;                 ///< of a velocity
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

  /// Returns true if every scene was judged, had a golden, and passed.
  [[nodiscard]] bool passed() const;
};

/// Returns the command line as typed, or of a merged report one for the whole check.
inline std::string full_command(const CheckReport& report) {
  return report.typed_command.empty() ? report.command + report.run_options : report.typed_command;
}

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

}  // namespace drape
