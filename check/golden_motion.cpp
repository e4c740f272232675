#include "check/golden_motion.hpp"

#include <fmt/format.h>
#include <zlib.h>
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <map>
#include <new>
#include <stdexcept>

#include "check/compare_motion.hpp"
#include "check/report.hpp"
#include "core/bytes.hpp"
#include "core/text.hpp"
#include "drape/core/error.hpp"
#include "render/camera_path.hpp"
#include "run/frame_source.hpp"
#include "run/outputs.hpp"
#include "run/run_scene.hpp"

namespace drape {

std::string pack_words(const Words& words) {
  const std::string planes = byte_planes(words);
  uLongf size = compressBound(planes.size());
  std::string packed(size, '\0');
  if (compress2(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(planes.data()),
                planes.size(), Z_BEST_COMPRESSION) != Z_OK) {
    throw std::bad_alloc();
  }
  packed.resize(size);
  return std::to_string(planes.size()) + "\n" + packed;
}

Words unpack_words(std::string_view bytes, std::uint64_t most) {
  const std::size_t line = bytes.find('\n');
  std::size_t size = 0;
  for (const char c : bytes.substr(0, line)) {
    if (c < '0' || c > '9' || size > (std::size_t{1} << 40))
      throw std::invalid_argument("has a size that cannot be read");
    size = 10 * size + static_cast<std::size_t>(c - '0');
  }
  // The compression ratio of zlib is below 1100: reserve no more for a damaged file.
  if (line == std::string_view::npos || size % 8 != 0 || size / 1100 > bytes.size()) {
    throw std::invalid_argument("is truncated");
  }
  if (size / 8 > most) throw std::invalid_argument("holds more than its manifest allows");
  bytes.remove_prefix(line + 1);
  std::string planes(size, '\0');
  uLongf unpacked = size;
  uLong used = bytes.size();
  if (uncompress2(reinterpret_cast<Bytef*>(planes.data()), &unpacked, reinterpret_cast<const Bytef*>(bytes.data()),
                  &used) != Z_OK ||
      unpacked != size || used != bytes.size()) {
    throw std::invalid_argument("is damaged");
  }
  return from_byte_planes(planes);
}

namespace {

/// Returns the number if it is finite. @throws std::invalid_argument otherwise
double finite(double value) {
  if (!std::isfinite(value)) throw std::invalid_argument("contains a number that is not finite");
  return value;
}

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
  double number() { return finite(std::bit_cast<double>(bits())); }
  /// Checks that enough words follow, before memory is allocated for them.
  void need(std::uint64_t words) const {
    if (words > words_.size() - next_) throw std::invalid_argument("is truncated");
  }
  [[nodiscard]] bool at_end() const { return next_ == words_.size(); }

 private:
  Words words_;
  std::size_t next_ = 0;
};

constexpr std::string_view magic = "drape motion 2\n";
constexpr double most_quanta = 9e18;  // a little below the limit of a signed word

std::int64_t multiple(double value, double quantum) {
  const double quanta = std::nearbyint(value / quantum);
  return std::abs(quanta) < most_quanta ? static_cast<std::int64_t>(quanta) : 0;
}

bool is_multiple(double value, double quantum) {
  return quantum > 0 && static_cast<double>(multiple(value, quantum)) * quantum == value &&
         !(value == 0 && std::signbit(value));
}

std::uint64_t bits_of(double value) { return std::bit_cast<std::uint64_t>(value); }

/// Predicts a coordinate from earlier vertices: the previous one, corrected by the difference of the two neighbours in
/// the row before, if there is one. Any vertex order gives a valid prediction.
double predicted(const Vertices& values, Eigen::Index i, Eigen::Index axis, Eigen::Index row) {
  if (i == 0) return 0;
  const double before = values(i - 1, axis);
  if (row < 2 || i <= row) return before;
  return before + (values(i - row, axis) - values(i - row - 1, axis));
}

class FieldWriter {
 public:
  FieldWriter(WordWriter& writer, int row) : writer_(writer), row_(row) {}

  void write(const Vertices& values, double quantum) {
    std::vector<bool> exact;
    for (Eigen::Index i = 0; i < values.rows(); ++i) {
      exact.push_back(!is_multiple(values(i, 0), quantum) || !is_multiple(values(i, 1), quantum) ||
                      !is_multiple(values(i, 2), quantum));
    }
    for (std::size_t i = 0; i < exact.size(); i += 64) {
      std::uint64_t word = 0;
      for (std::size_t k = i; k < std::min(i + 64, exact.size()); ++k) word |= std::uint64_t{exact[k]} << (k - i);
      writer_.bits(word);
    }
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      for (Eigen::Index i = 0; i < values.rows(); ++i) {
        const double value = values(i, axis), guess = predicted(values, i, axis, row_);
        // Differences are modulo 2⁶⁴, where all are reversible.
        const std::uint64_t difference = exact[static_cast<std::size_t>(i)]
                                             ? bits_of(value) - bits_of(guess)
                                             : static_cast<std::uint64_t>(multiple(value, quantum)) -
                                                   static_cast<std::uint64_t>(multiple(guess, quantum));
        writer_.whole(static_cast<std::int64_t>(difference));
      }
    }
  }

 private:
  WordWriter& writer_;
  Eigen::Index row_;
};

class FieldReader {
 public:
  FieldReader(WordReader& reader, int row, Eigen::Index vertices) : reader_(reader), row_(row), vertices_(vertices) {}

  Vertices read(double quantum) {
    reader_.need(3 * static_cast<std::uint64_t>(vertices_));
    Vertices values(vertices_, 3);
    std::vector<std::uint64_t> exact;
    for (Eigen::Index i = 0; i < vertices_; i += 64) exact.push_back(reader_.bits());
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      for (Eigen::Index i = 0; i < vertices_; ++i) {
        const double guess = predicted(values, i, axis, row_);
        const auto difference = static_cast<std::uint64_t>(reader_.whole());
        const auto at = static_cast<std::size_t>(i);
        if ((exact[at / 64] >> (at % 64) & 1) != 0) {
          values(i, axis) = finite(std::bit_cast<double>(bits_of(guess) + difference));
        } else {
          if (quantum == 0) throw std::invalid_argument("holds rounded numbers where there are none");
          const std::uint64_t n = static_cast<std::uint64_t>(multiple(guess, quantum)) + difference;
          values(i, axis) = finite(static_cast<double>(static_cast<std::int64_t>(n)) * quantum);
        }
      }
    }
    return values;
  }

 private:
  WordReader& reader_;
  Eigen::Index row_, vertices_;
};

/// Predictor of the numbers of a step from the previous two, by linear extrapolation.
class LinearPredictor {
 public:
  std::vector<std::uint64_t> next(std::size_t count) {
    if (last_.size() != count) last_.assign(count, 0);
    if (before_.size() != count) before_ = last_;
    std::vector<std::uint64_t> numbers(count);
    for (std::size_t i = 0; i < count; ++i) numbers[i] = 2 * last_[i] - before_[i];
    return numbers;
  }
  void add(std::vector<std::uint64_t> actual) { before_ = std::exchange(last_, std::move(actual)); }

 private:
  std::vector<std::uint64_t> last_, before_;  // in quanta, modulo 2⁶⁴
};

void write_bodies(WordWriter& writer, const std::vector<double>& bodies, double quantum, LinearPredictor& steady) {
  const std::vector<std::uint64_t> guess = steady.next(bodies.size());
  std::vector<std::uint64_t> actual;
  for (const double number : bodies) actual.push_back(static_cast<std::uint64_t>(multiple(number, quantum)));
  std::int64_t different = 0;
  for (std::size_t i = 0; i < actual.size(); ++i) different += actual[i] != guess[i] ? 1 : 0;
  writer.whole(static_cast<std::int64_t>(actual.size()));
  writer.whole(different);
  for (std::size_t i = 0; i < actual.size(); ++i) {
    if (actual[i] == guess[i]) continue;
    writer.whole(static_cast<std::int64_t>(i));
    writer.whole(static_cast<std::int64_t>(actual[i] - guess[i]));
  }
  steady.add(std::move(actual));
}

/// @param least smallest number of numbers
std::vector<double> read_bodies(WordReader& reader, int least, int most, double quantum, LinearPredictor& steady) {
  const auto count = static_cast<std::size_t>(reader.whole(least, most));
  std::vector<std::uint64_t> numbers = steady.next(count);
  for (auto different = reader.whole(0, static_cast<std::int64_t>(count)); different > 0; --different) {
    const auto i = static_cast<std::size_t>(reader.whole(0, static_cast<std::int64_t>(count) - 1));
    numbers[i] += static_cast<std::uint64_t>(reader.whole());
  }
  std::vector<double> bodies;
  for (const std::uint64_t n : numbers) bodies.push_back(static_cast<double>(static_cast<std::int64_t>(n)) * quantum);
  steady.add(std::move(numbers));
  return bodies;
}

/// Returns the largest number of words in a golden's motion.
std::uint64_t most_words(const Golden& golden) {
  const auto vertices = static_cast<std::uint64_t>(golden.vertex_count);
  const auto steps = static_cast<std::uint64_t>(golden.step_count);
  const std::uint64_t windows = steps / static_cast<std::uint64_t>(golden.window_steps) + 2;
  const std::uint64_t field = 3 * vertices + vertices / 64 + 1;
  return windows * (3 * field + 3) + golden.frames.size() * field +
         steps * (5 + 2 * static_cast<std::uint64_t>(golden.body_count + 3 * golden.group_count));
}

}  // namespace

std::string pack_motion(const Golden& golden) {
  WordWriter writer;
  FieldWriter fields(writer, golden.row);
  const RoundingUnits& quanta = golden.quanta;
  for (const GoldenWindow& window : golden.windows) {
    const RoundingUnits of = &window == &golden.windows.back() ? quanta.at_end() : quanta;
    fields.write(window.start.x, of.position);
    fields.write(window.start.v, of.velocity);
    if (window.middle.size() > 0) fields.write(window.middle, quanta.compared);
    for (const double energy : {window.energies.kinetic, window.energies.gravity, window.energies.elastic}) {
      writer.number(energy);
    }
  }
  LinearPredictor steady;
  for (const GoldenWindow& window : golden.windows) {
    for (const GoldenStep& step : window.steps) writer.bits(step.hash);
    for (const GoldenStep& step : window.steps) write_bodies(writer, step.bodies, quanta.compared, steady);
  }
  LinearPredictor of_groups;
  for (const GoldenWindow& window : golden.windows) {
    if (golden.group_count == 0) break;
    for (const GoldenStep& step : window.steps) write_bodies(writer, step.groups, quanta.compared, of_groups);
  }
  for (const GoldenFrame& frame : golden.frames) fields.write(frame.x, quanta.position);
  return std::string(magic) + pack_words(writer.words());
}

std::uint64_t most_motion_bytes(const Golden& golden) {
  // Slightly more than the words: zlib stores incompressible data with a small overhead.
  const std::uint64_t words = most_words(golden);
  return 8 * words + words / 64 + 1024;
}

void unpack_motion(std::string_view bytes, Golden& golden) {
  if (!bytes.starts_with(magic)) throw std::invalid_argument("is not a golden motion of this version of drape");
  WordReader reader(unpack_words(bytes.substr(magic.size()), most_words(golden)));
  FieldReader fields(reader, golden.row, golden.vertex_count);
  const RoundingUnits& quanta = golden.quanta;
  reader.need(static_cast<std::uint64_t>(golden.step_count));
  const std::vector<std::int64_t> starts = window_starts(golden.step_count, golden.window_steps);
  golden.windows.clear();
  for (std::size_t i = 0; i < starts.size(); ++i) {
    GoldenWindow& window = golden.windows.emplace_back();
    const std::int64_t steps = i + 1 < starts.size() ? starts[i + 1] - starts[i] : 0;
    window.start.step = starts[i];
    const RoundingUnits of = i + 1 == starts.size() ? quanta.at_end() : quanta;
    window.start.x = fields.read(of.position);
    window.start.v = fields.read(of.velocity);
    if (steps > 1) window.middle = fields.read(quanta.compared);
    window.energies = {.kinetic = reader.number(), .gravity = reader.number(), .elastic = reader.number()};
    window.steps.resize(static_cast<std::size_t>(steps));
  }
  LinearPredictor steady;
  for (GoldenWindow& window : golden.windows) {
    for (GoldenStep& step : window.steps) step.hash = static_cast<std::uint32_t>(reader.bits());
    for (GoldenStep& step : window.steps)
      step.bodies = read_bodies(reader, 0, golden.body_count, quanta.compared, steady);
  }
  const int group_numbers = 3 * golden.group_count;
  LinearPredictor of_groups;
  for (GoldenWindow& window : golden.windows) {
    if (group_numbers == 0) break;
    for (GoldenStep& step : window.steps) {
      step.groups = read_bodies(reader, group_numbers, group_numbers, quanta.compared, of_groups);
    }
  }
  for (GoldenFrame& frame : golden.frames) frame.x = fields.read(quanta.position);
  if (!reader.at_end()) throw std::invalid_argument("has trailing data");
}

namespace {

// No later state of a recorded motion shows that an earlier one has changed, so each is the middle or the end of a
// window.
constexpr std::int64_t played_window_steps = 2;

FilmExtent whole_film(const Scene& scene) {
  return FilmExtent(scene.video, scene.simulation.step, scene.step_count(), std::nullopt);
}

/// Observer that stores the windows of a motion.
class Recorder final : public StepObserver {
 public:
  /// @param recorded source of the energies; null: the simulation
  Recorder(const std::vector<std::int64_t>& starts, const RoundingUnits& quanta, PlayedMotion* recorded)
      : starts_(starts), quanta_(quanta), recorded_(recorded) {}

  void begin(const Simulation& simulation) override {
    GoldenWindow& window = windows.emplace_back();
    window.start = simulation.state();
    window.energies = energies(simulation);
  }

  void after_step(const Simulation& simulation, const StepReport&, double) override {
    GoldenWindow& window = windows.back();
    GoldenStep& step = window.steps.emplace_back(golden_step(simulation, group_count));
    step.bodies = rounded(std::move(step.bodies), quanta_.compared);
    step.groups = rounded(std::move(step.groups), quanta_.compared);
    body_count = std::max(body_count, static_cast<int>(step.bodies.size()));
    const std::int64_t end = starts_[windows.size()], now = simulation.state().step;
    if (now == window.start.step + (end - window.start.step) / 2) {
      window.middle = rounded(simulation.state().x, quanta_.compared);
    }
    if (now == end) window.energies = energies(simulation);
  }

  std::vector<GoldenWindow> windows;
  int body_count = 0;

 private:
  [[nodiscard]] Energies energies(const Simulation& simulation) const {
    return recorded_ != nullptr ? recorded_->energies(simulation.state().step) : simulation.energies();
  }

  const std::vector<std::int64_t>& starts_;
  RoundingUnits quanta_;
  PlayedMotion* recorded_;
};

/// Returns the index distance between rows of a grid mesh: the most frequent distance of a spring's ends except 1.
int row_of(const Cloth& cloth) {
  std::map<int, int> count;
  for (const Spring& spring : cloth.springs) ++count[spring.j - spring.i];
  count.erase(1);
  const auto commonest =
      std::max_element(count.begin(), count.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  return commonest == count.end() ? 1 : commonest->first;
}

/// Returns the known parts of a golden before its motion is run.
Golden described(const LoadedScene& scene, const CheckSettings& settings, const RecordPlan& plan) {
  Golden golden;
  golden.scene_digest = scene.source.digest;
  golden.size = picture_size(scene, settings);
  golden.step = scene.simulation.step;
  golden.step_count = scene.step_count();
  golden.window_steps = plan.window_steps;
  golden.vertex_count = scene.simulation.cloth.vertex_count();
  golden.row = row_of(scene.simulation.cloth);
  golden.camera = scene.camera;
  golden.seconds_per_frame = whole_film(scene).seconds_per_frame;
  golden.film = film_of(scene);
  if (scene.choice) {
    const IntegratorSettings& integrator = scene.simulation.integrator;
    golden.method = {.method = integrator.method, .substeps = integrator.substeps};
  }
  golden.quanta = plan.quanta;
  for (const ChosenFrame& chosen : plan.frames) {
    golden.frames.push_back(
        {.frame = chosen.frame, .time = whole_film(scene).time(chosen.frame), .why = chosen.why, .x = {}});
  }
  return golden;
}

}  // namespace

GoldenFilm film_of(const Scene& scene) {
  return {.fps = scene.video.fps, .speed = scene.video.speed, .size = scene.video.size, .samples = scene.look.samples};
}

Eigen::Vector2i picture_size(const Scene& scene, const CheckSettings& settings) {
  return settings.size.value_or(scene.video.size);
}

std::optional<RecordPlan> plan_recording(const LoadedScene& scene, const CheckSettings& settings,
                                         const std::stop_token& stop, Progress& progress, PlayedMotion* recorded) {
  const FilmExtent film = whole_film(scene);
  RecordPlan plan;
  plan.window_steps = recorded != nullptr
                          ? played_window_steps
                          : std::max<std::int64_t>(1, std::llround(std::min(settings.window_time / film.step, 1e9)));
  plan.quanta = quanta_for(scene.simulation, settings.motion_tolerance);
  for (const int frame : settings.frames) {
    if (frame > film.frames.last) {
      throw UsageError(fmt::format("{}: frame {} cannot be compared: the film ends with frame {}",
                                   shown(scene.source.file), frame, film.frames.last));
    }
    plan.frames.push_back({frame, named_frame});
  }
  if (!plan.frames.empty()) return plan;
  const std::optional<FilmFacts> facts = survey_motion(scene, plan.window_steps, plan.quanta, stop, progress, recorded);
  if (!facts) return std::nullopt;
  plan.frames = choose_frames(*facts);
  return plan;
}

RecordPlan plan_of(const Golden& golden) {
  RecordPlan plan{.frames = {}, .window_steps = golden.window_steps, .quanta = golden.quanta};
  for (const GoldenFrame& frame : golden.frames) plan.frames.push_back({frame.frame, frame.why});
  return plan;
}

std::vector<View> views_of_frames(const Scene& scene, const Eigen::Vector2i& size,
                                  const std::vector<GoldenFrame>& frames) {
  if (frames.empty()) return {};
  const Simulation simulation(scene.simulation);
  const auto pass = [&](const std::function<void(const Frame&)>& visit) {
    for (const GoldenFrame& frame : frames) {
      visit({.index = frame.frame,
             .time = frame.time,
             .positions = frame.x,
             .colliders = simulation.colliders(frame.time)});
    }
  };
  const int count = static_cast<int>(frames.size());
  const CameraPath path = camera_path(scene.camera, known_film(scene, size, count, pass));
  std::vector<View> views;
  for (int i = 0; i < count; ++i) views.push_back(path.at(i));
  return views;
}

std::optional<Golden> record_motion(const LoadedScene& scene, const CheckSettings& settings, const RecordPlan& plan,
                                    const std::stop_token& stop, Progress& progress, PlayedMotion* recorded) {
  Golden golden = described(scene, settings, plan);
  const FilmExtent film = whole_film(scene);
  FrameTape tape;
  auto wanted = golden.frames.begin();
  FrameSampler sampler(film, [&](Frame frame) {
    if (wanted != golden.frames.end() && wanted->frame == frame.index) {
      wanted++->x = rounded(frame.positions, plan.quanta.position);
    }
    tape.add(std::move(frame));
  });
  const std::vector<std::int64_t> starts = window_starts(film.steps, plan.window_steps);
  Recorder recorder(starts, plan.quanta, recorded);
  StepCounter counter(progress);
  progress.begin(recorded != nullptr ? "reading" : "simulating", "steps", film.steps);
  const std::array<StepObserver*, 3> observers{&recorder, &counter, &sampler};
  Simulation simulation(scene.simulation);
  if (recorded != nullptr) {
    play_chained(*recorded, simulation, starts, plan.quanta, observers, stop);
  } else {
    run_chained(simulation, starts, plan.quanta, observers, stop);
  }
  if (stop.stop_requested()) return std::nullopt;

  const auto pass = [&tape](const auto& visit) { tape.for_each(visit); };
  const CameraPath path = camera_path(scene.camera, known_film(scene, golden.size, tape.count(), pass));
  for (GoldenFrame& frame : golden.frames) frame.view = path.at(frame.frame);
  golden.frames_views = views_of_frames(scene, golden.size, golden.frames);
  golden.windows = std::move(recorder.windows);
  golden.body_count = recorder.body_count;
  golden.group_count = group_count;
  return golden;
}

}  // namespace drape
