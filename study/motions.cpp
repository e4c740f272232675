#include "study/motions.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <utility>

#include "core/bytes.hpp"
#include "core/files.hpp"
#include "core/text.hpp"
#include "drape/core/error.hpp"
#include "output/html_writer.hpp"
#include "render/camera_path.hpp"
#include "run/outputs.hpp"
#include "run/run_scene.hpp"

namespace drape {
namespace {

constexpr std::size_t most_frames = 100, most_positions = 50'000;
constexpr double highest_rate = 50;  // [1/s]; with shorter steps, the motion plays slower than real time

/// Returns the largest number of frames for a page, an even number.
std::size_t frames_of_page(const Scene& scene) {
  const auto vertices = static_cast<std::size_t>(std::max(1, scene.simulation.cloth.vertex_count()));
  return std::clamp<std::size_t>(most_positions / vertices, 2, most_frames) & ~std::size_t{1};
}

/// Keeps every second frame.
void thin(std::vector<Frame>& frames) {
  for (std::size_t i = 0; 2 * i < frames.size(); ++i) {
    if (i > 0) frames[i] = std::move(frames[2 * i]);
  }
  frames.resize((frames.size() + 1) / 2);
}

}  // namespace

html::PlayedMotion pack_for_page(const Scene& scene, const std::vector<Frame>& frames, const View& first) {
  std::size_t every = 1;
  while ((frames.size() + every - 1) / every > frames_of_page(scene)) every *= 2;
  FilmInfo film;
  film.scene = scene.name;
  film.cloth = &scene.simulation.cloth;
  film.look = &scene.look;
  if (frames.size() > every) film.seconds_per_frame = frames[every].time - frames[0].time;
  film.fps = std::min(1 / film.seconds_per_frame, highest_rate);
  MotionPacker packer(film);
  try {
    for (std::size_t i = 0; i < frames.size(); i += every) packer.add(frames[i]);
  } catch (const OutputError&) {
    return {};
  }
  return packer.finish(first, scene.camera.up);
}

StudyMotionRecorder::StudyMotionRecorder(const Scene& scene) : scene_(scene), most_(frames_of_page(scene)) {}

void StudyMotionRecorder::add(const Simulation& simulation) {
  if (simulation.state().step % every_ != 0) return;
  if (frames_.size() == most_) {
    thin(frames_);
    every_ *= 2;
    if (simulation.state().step % every_ != 0) return;
  }
  frames_.push_back({.index = static_cast<int>(frames_.size()),
                     .time = simulation.time(),
                     .positions = simulation.state().x,
                     .colliders = simulation.colliders(simulation.time())});
}

html::PlayedMotion StudyMotionRecorder::finish() const {
  if (frames_.empty()) return {};
  const auto pass = [this](const auto& visit) { std::ranges::for_each(frames_, visit); };
  const auto count = static_cast<int>(frames_.size());
  return pack_for_page(scene_, frames_,
                       camera_path(scene_.camera, known_film(scene_, scene_.video.size, count, pass)).at(0));
}

std::optional<StudyMotion> record_study_motion(const StudyCase& study_case, const std::string& label,
                                               const std::stop_token& stop) {
  const Scene scene = study_case.load();
  StudyMotionRecorder recorder(scene);
  Simulation simulation(scene.simulation);
  recorder.add(simulation);
  try {
    run_steps(simulation, study_case.steps, stop, [&](const StepReport&) { recorder.add(simulation); });
  } catch (const DivergedError&) {
  }
  if (stop.stop_requested()) return std::nullopt;
  return StudyMotion{label, study_case.film_command("motion.html"), recorder.finish()};
}

namespace {

constexpr const char* motion_kind = "motion";
constexpr std::size_t most_motion_bytes = std::size_t{1} << 28;

// The fields of a motion but its bytes, described once for both directions: a RunsWriter (with const data) or a
// RunsRecord.
template <class Fields, class Motion>
void describe_motion(Fields& f, Motion& motion) {
  f("label", motion.label);
  f("command", motion.command);
  f("description", motion.played.description);
  f("frames", motion.played.frames);
  f("precision", motion.played.precision);
  f("size", motion.played.size);
  f("vertices", motion.played.vertices);
  f("triangles", motion.played.triangles);
}

std::string bytes_in(RunsRecord& record, const char* quantity) {
  std::string text;
  record(quantity, text);
  std::optional<std::string> bytes = from_base64(text);
  if (!bytes) record.fail(record.line(), fmt::format("'{}' is no base64", quantity));
  return std::move(*bytes);
}

ShownMotion read_motion(RunsRecord& record) {
  if (record.key.kind != motion_kind) {
    record.fail(record.line(), fmt::format("expected the kind '{}', found '{}'", motion_kind, record.key.kind));
  }
  ShownMotion shown{record.key.scene, {}};
  html::PlayedMotion& played = shown.motion.played;
  describe_motion(record, shown.motion);
  played.data = bytes_in(record, "data");
  played.texture = bytes_in(record, "texture");
  record.done();
  if (played.frames < 1) record.fail(record.line(), fmt::format("expected frames, found {}", played.frames));
  return shown;
}

}  // namespace

std::string motions_csv(const std::vector<ShownMotion>& motions) {
  RunsWriter f;
  for (std::size_t i = 0; i < motions.size(); ++i) {
    const html::PlayedMotion& played = motions[i].motion.played;
    if (played.frames == 0) continue;
    f.begin({motions[i].part, motion_kind, {}, {}, std::to_string(i + 1)});
    describe_motion(f, motions[i].motion);
    f("data", base64(played.data));
    f("texture", base64(played.texture));
  }
  return f.finish();
}

std::vector<ShownMotion> read_motions(const std::filesystem::path& file) {
  std::vector<ShownMotion> motions;
  if (!std::filesystem::exists(file)) return motions;
  for (RunsRecord& record : parse_runs(read_text(file, most_motion_bytes), shown(file))) {
    motions.push_back(read_motion(record));
  }
  return motions;
}

}  // namespace drape
