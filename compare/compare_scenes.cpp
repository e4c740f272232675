#include "compare/compare_scenes.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <iterator>
#include <set>
#include <string_view>

#include "compare/page.hpp"
#include "compare/panels.hpp"
#include "core/text.hpp"
#include "drape/core/error.hpp"
#include "drape/render/view.hpp"
#include "drape/scene/scene.hpp"
#include "output/html_writer.hpp"
#include "output/png_encoder.hpp"
#include "output/registry.hpp"
#include "run/frame_source.hpp"
#include "run/outputs.hpp"

namespace drape {
namespace {

constexpr double same_place = 1e-3;  // tolerance, in mean edge lengths

VertexMatch match(const Cloth& cloth, const Cloth& first) {
  VertexMatch found;
  found.comparable = cloth.vertex_count() == first.vertex_count();
  if (!found.comparable || cloth.triangles == first.triangles) return found;
  const double tolerance = same_place * mean_edge(first.positions, first.triangles);
  if ((cloth.positions - first.positions).rowwise().norm().maxCoeff() <= tolerance) return found;
  if (auto order = match_vertices(cloth.positions, first.positions, tolerance)) {
    found.order = std::move(*order);
    found.note = "its vertices are in another order than the first motion's, and are matched by the first frame";
  } else {
    found.note =
        "its triangles are not the first motion's, nor is its first frame: vertices of the same number are compared";
  }
  return found;
}

}  // namespace

std::vector<VertexMatch> match_scenes(const std::vector<LoadedScene>& scenes) {
  std::vector<VertexMatch> all;
  for (const Scene& scene : scenes) all.push_back(match(scene.simulation.cloth, scenes.front().simulation.cloth));
  return all;
}

namespace {

constexpr std::size_t most_named = 4;  // in a label; the page lists all differences
constexpr const char *absent = "–", *present = "there";

bool counts(const std::string& key) {
  constexpr std::array<std::string_view, 5> taken_from_first{"camera.", "video.", "caption.", "overlay.", "check."};
  return key != "scene" && std::ranges::none_of(taken_from_first, [&](auto table) { return key.starts_with(table); });
}

/// Returns the effect of an effect's key: "effects.sphere"; empty for other keys.
std::string effect_of(const std::string& key) {
  return key.starts_with("effects.") ? key.substr(0, key.rfind('.')) : std::string();
}

bool has_effect(const LoadedScene& scene, const std::string& effect) {
  return std::ranges::any_of(scene.source.fields,
                             [&](const SceneField& field) { return effect_of(field.path) == effect; });
}

std::string text_of(const LoadedScene& scene, const std::string& key) {
  const auto field = std::ranges::find(scene.source.fields, key, &SceneField::path);
  return field == scene.source.fields.end() ? absent : format_field(field->value, "");
}

bool all_same(const std::vector<std::string>& values) {
  return std::ranges::all_of(values, [&](const std::string& value) { return value == values.front(); });
}

/// Returns distinct names: the scenes' names, else their file names, else their paths; the scenes' names by default.
std::vector<std::string> names_of(const std::vector<LoadedScene>& scenes) {
  std::vector<std::vector<std::string>> choices(3);
  for (const LoadedScene& scene : scenes) {
    choices[0].push_back(scene.name);
    choices[1].push_back(scene.source.file.filename().string());
    choices[2].push_back(scene.source.file.string());
  }
  for (const std::vector<std::string>& names : choices) {
    if (std::set(names.begin(), names.end()).size() == names.size()) return names;
  }
  return choices[0];
}

/// Returns "step = 0.01"; the value alone for a method or scheme. Effects and each of several cloths keep their names:
/// "sphere.radius = 0.3", "shirt.mass = 0.2".
std::string difference_text(const KeyDifference& difference, std::size_t scene) {
  const std::string& value = difference.values[scene];
  const std::string within = difference.key.substr(difference.key.find('.') + 1);  // without its first table
  if (effect_of(difference.key) == "effects") return (value == absent ? "no " : "") + within;
  const std::string name = difference.key.substr(difference.key.rfind('.') + 1);
  if (name == "method" || name == "scheme") return value;
  if (within.starts_with("transform.")) return name + " = " + value;  // no cloth can be called so
  const bool numbered = within.find_first_of("0123456789") == 0;
  return (numbered ? difference.key : within) + " = " + value;
}

/// Returns false if a motion is of another program: it has no keys to compare.
bool have_keys(const std::vector<LoadedScene>& scenes) {
  return std::ranges::none_of(scenes, [](const LoadedScene& scene) { return scene.source.fields.empty(); });
}

}  // namespace

std::vector<KeyDifference> differences(const std::vector<LoadedScene>& scenes) {
  if (!have_keys(scenes)) return {};
  std::vector<std::string> keys;
  for (const LoadedScene& scene : scenes) {
    for (const SceneField& field : scene.source.fields) {
      // Report an effect that some scenes lack as one difference, without its keys.
      const std::string effect = effect_of(field.path);
      const bool shared = effect.empty() || std::ranges::all_of(scenes, [&](const LoadedScene& other) {
                            return has_effect(other, effect);
                          });
      const std::string& key = shared ? field.path : effect;
      if (counts(key) && std::ranges::find(keys, key) == keys.end()) keys.push_back(key);
    }
  }
  std::vector<KeyDifference> found;
  for (const std::string& key : keys) {
    KeyDifference difference{key, {}};
    const bool is_effect = effect_of(key) == "effects";
    for (const LoadedScene& scene : scenes) {
      difference.values.push_back(!is_effect ? text_of(scene, key) : has_effect(scene, key) ? present : absent);
    }
    if (!all_same(difference.values)) found.push_back(std::move(difference));
  }
  return found;
}

std::vector<std::string> labels(const std::vector<LoadedScene>& scenes, const std::vector<KeyDifference>& differences) {
  std::vector<KeyDifference> told;  // without keys of the look, which is visible
  std::ranges::copy_if(differences, std::back_inserter(told),
                       [](const KeyDifference& difference) { return !difference.key.starts_with("look."); });
  std::vector<std::string> names;
  std::ranges::transform(scenes, std::back_inserter(names), &Scene::name);
  const bool named = told.empty() || !all_same(names);
  if (told.empty()) names = names_of(scenes);
  std::vector<std::string> labels;
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    std::string label = named ? names[i] : "", rest;
    for (std::size_t d = 0; d < std::min(told.size(), most_named); ++d) {
      rest += (rest.empty() ? "" : ", ") + difference_text(told[d], i);
    }
    if (told.size() > most_named) rest += ", …";
    labels.push_back(label.empty() || rest.empty() ? label + rest : label + ": " + rest);
  }
  return labels;
}

namespace {

constexpr int most_page_pictures = 75, most_page_moments = 25;

bool is_page(const std::string& path) {
  const OutputFormat* format = find_format(path);
  return format != nullptr && format->extension == ".html";
}

/// Returns the outputs that are pages, or those that are not.
std::vector<std::string> outputs_that(bool pages, const CompareOptions& options) {
  std::vector<std::string> chosen;
  for (const std::string& path : options.outputs) {
    if (is_page(path) == pages) chosen.push_back(path);
  }
  return chosen;
}

/// Returns the frames to draw.
FrameRange frames_of(const std::vector<LoadedScene>& scenes, const CompareOptions& options) {
  const FrameRange all = all_frames(scenes, options), wanted = options.frames.value_or(all);
  if (wanted.last > all.last) {
    throw UsageError(fmt::format("--frames {}..{}: the film ends with frame {}", wanted.first, wanted.last, all.last));
  }
  return wanted;
}

PanelLayout layout_of(Pen& pen, const std::vector<LoadedScene>& scenes, const CompareOptions& options, bool bar) {
  return PanelLayout(pen, labels(scenes, differences(scenes)), scenes.front().video.size, options.columns, options.rows,
                     options.difference ? 1 : 0, bar);
}

class Comparison {
 public:
  Comparison(const std::vector<LoadedScene>& scenes, const CompareOptions& options, const std::stop_token& stop,
             Progress& progress)
      : scenes_(scenes),
        options_(options),
        stop_(stop),
        progress_(progress),
        first_(scenes.front()),
        frames_(frames_of(scenes, options)),
        matches_(match_scenes(scenes)),
        colors_(scenes, labels(scenes, differences(scenes)), options.difference, options.limit),
        layout_(layout_of(pen_, scenes, options, colors_.wanted())),
        motions_(scenes, options, look_ahead()),
        outputs_(outputs_that(false, options), comparison_info(scenes, options)),
        poster_(first_.simulation.cloth.triangles) {
    for (const VertexMatch& match : matches_) comparable_ = comparable_ && match.comparable;
    result_.differences = differences(scenes);
    result_.keys_known = have_keys(scenes);
    result_.frames_wanted = frames_.count();
    for (const std::string& label : labels(scenes, result_.differences)) {
      const IntegratorSettings& integrator = scenes[result_.motions.size()].simulation.integrator;
      const std::string& matched = matches_[result_.motions.size()].note;
      result_.motions.push_back(
          {label, {}, {}, {}, {}, {}, step_method_name({integrator.method, integrator.scheme}), matched, {}});
    }
  }

  CompareResult run() {
    if (const std::optional<CameraPath> path = find_path()) draw(*path);
    for (std::size_t i = 0; i < scenes_.size(); ++i) {
      if (!motions_.motion(i).known()) continue;
      result_.motions[i].statistics = motions_.motion(i).statistics();
      result_.motions[i].divergence = motions_.motion(i).divergence();
    }
    result_.interrupted = stop_.stop_requested();
    const Ending ending = result_.interrupted ? Ending::early : Ending::complete;
    if (!result_.times.empty()) {
      result_.outputs = outputs_.finish(ending);
      for (const std::string& path : outputs_that(true, options_)) write_page(path, ending);
    }
    for (const std::string& problem : outputs_.problems()) result_.problems.push_back(problem);
    return std::move(result_);
  }

 private:
  using Moment = SynchronisedMotions::Moment;

  /// Returns true if the motions must be known before the first picture is drawn.
  [[nodiscard]] bool look_ahead() const { return needs_motion(first_.camera) || colors_.needs_motion(); }

  /// Plays the motions from the start.
  template <class Work>
  void play(const char* stage, int last, Work work) {
    progress_.begin(stage, "frames", last + 1);
    motions_.play(last, stop_, [&](int k, const Moment& moment) {
      work(k, moment);
      progress_.done = k + 1;
    });
  }

  /// @returns nothing if interrupted
  std::optional<CameraPath> find_path() {
    const int count = all_frames(scenes_, options_).count();
    if (look_ahead()) {
      play("simulating", count - 1, [&](int, const Moment& moment) { colors_.survey(moment); });
    }
    if (stop_.stop_requested()) return std::nullopt;
    return motions_.camera_path(count, stop_);
  }

  void draw(const CameraPath& path) {
    for (const Scene& scene : scenes_) {
      Look look = scene.look;
      if (colors_.wanted() && !(options_.difference && &scene == &first_)) look.texture.clear();
      renderers_.emplace_back(data_folder(), first_.video.size, path.at(0), look, scene.simulation.cloth.vertex_count(),
                              scene.simulation.cloth.triangles, scene.uvs, options_.backend);
      renderers_.back().set_weave(scene.simulation.cloth.rest, scene.uvs);
    }
    if (!outputs_that(true, options_).empty()) begin_players();
    if (colors_.wanted()) bar_ = colors_.bar(pen_, layout_.size().x(), layout_.text_size());
    play("drawing", frames_.last, [&](int k, const Moment& moment) {
      if (k < frames_.first) return;
      for (Renderer& renderer : renderers_) renderer.look_from(path.at(k));
      add_frame(k, moment);
    });
    if (result_.times.empty()) return;
    for (std::size_t i = 0; i < packers_.size(); ++i) {
      result_.motions[i].played = packers_[i].finish(path.at(frames_.first), first_.camera.up);
    }
  }

  void add_frame(int index, const Moment& moment) {
    const double time = index * first_.video.speed / first_.video.fps;
    take_figures(time, moment);
    std::vector<Image> panels;
    std::vector<std::string> extra;
    for (std::size_t i = 0; i < moment.size(); ++i) {
      const std::vector<Rgb> colors = colors_.colors(moment, i);
      panels.push_back(colors.empty() ? renderers_[i].draw(*moment[i]) : renderers_[i].draw(*moment[i], colors));
      if (!options_.difference) continue;
      extra.push_back(i == 0 ? "" : "at most " + readable_length(*result_.motions[i].most.back()) + " from the first");
    }
    if (on_page(index)) {
      moments_.push_back({time, {}});
      poster_.see(moment.front()->positions);
      for (const Image& panel : panels) moments_.back().pictures.push_back(encode_png(panel));
    }
    add_to_players(moment);
    const std::string when = "t = " + readable_time(time, first_.video.speed / first_.video.fps);
    outputs_.add({*moment.front(), layout_.compose(pen_, panels, extra, when, bar_)});
  }

  /// Prepares the page's players, unless the motions are too large for a browser.
  void begin_players() {
    const FilmInfo film = comparison_info(scenes_, options_);
    std::size_t vertices = 0;
    for (const Scene& scene : scenes_) vertices += static_cast<std::size_t>(scene.simulation.cloth.vertex_count());
    if (vertices * static_cast<std::size_t>(frames_.count()) > MotionPacker::most_positions) return;
    for (const Scene& scene : scenes_) {
      FilmInfo own = film;
      own.cloth = &scene.simulation.cloth;
      own.look = &scene.look;
      packers_.emplace_back(own);
    }
  }

  void add_to_players(const Moment& moment) {
    try {
      for (std::size_t i = 0; i < packers_.size(); ++i) packers_[i].add(*moment[i]);
    } catch (const OutputError& error) {
      packers_.clear();
      result_.missing = fmt::format("the page has no motion to turn: {}", error.what());
    }
  }

  void take_figures(double time, const Moment& moment) {
    result_.times.push_back(time);
    for (std::size_t i = 0; i < moment.size(); ++i) {
      ComparedMotion& motion = result_.motions[i];
      motion.total_energy.emplace_back();
      if (knows_energies(i)) motion.total_energy.back() = moment[i]->energies.value_or(Energies{}).total();
      motion.most.emplace_back();
      motion.mean.emplace_back();
      if (!comparable_) continue;
      const Eigen::VectorXd away = distances(*moment[i], *moment.front(), matches_[i].order);
      motion.most.back() = away.maxCoeff();
      motion.mean.back() = away.mean();
    }
  }

  [[nodiscard]] bool knows_energies(std::size_t i) const {
    return options_.recorded.empty() || !options_.recorded[i] || options_.recorded[i]->header().energies;
  }

  /// Returns true if the page shows this frame: evenly spread frames, with the first and the last.
  [[nodiscard]] bool on_page(int index) const {
    if (outputs_that(true, options_).empty()) return false;
    const int moments = std::clamp(most_page_pictures / static_cast<int>(scenes_.size()), 2, most_page_moments);
    return is_spread(index - frames_.first, frames_.count(), moments);
  }

  void write_page(const std::string& path, Ending ending) {
    try {
      PartialFile file(path);
      file.write(comparison_page(result_, moments_, static_cast<std::size_t>(poster_.index()),
                                 bar_ ? encode_png(*bar_) : "", options_.command));
      const std::uintmax_t size = file.commit(ending);
      result_.outputs.push_back({{file.name(ending), size}});
      if (ending == Ending::complete) write_diagrams(path);
    } catch (const OutputError& error) {
      result_.problems.emplace_back(error.what());
    }
  }

  /// Writes the diagrams of a page beside it.
  void write_diagrams(const std::filesystem::path& page) {
    const std::filesystem::path folder = page.parent_path() / (page.stem().string() + "-diagrams");
    for (const NamedChart& diagram : comparison_charts(result_)) {
      if (const std::string missing = write_chart(diagram, folder, options_.style); !missing.empty())
        result_.missing = missing;
    }
  }

  const std::vector<LoadedScene>& scenes_;
  const CompareOptions& options_;
  const std::stop_token& stop_;
  Progress& progress_;
  const Scene& first_;
  Pen pen_;
  FrameRange frames_;
  std::vector<VertexMatch> matches_;
  PanelColors colors_;
  PanelLayout layout_;
  SynchronisedMotions motions_;
  Outputs outputs_;
  bool comparable_ = true;  // the motions have matching vertices
  std::vector<Renderer> renderers_;
  std::deque<MotionPacker> packers_;  // by motion; empty without a page
  std::optional<Image> bar_;
  std::vector<PageMoment> moments_;
  PosterFrame poster_;  // among the page's moments, of the first motion
  CompareResult result_;
};

}  // namespace

FilmInfo comparison_info(const std::vector<LoadedScene>& scenes, const CompareOptions& options) {
  Pen pen;
  const FrameRange frames = frames_of(scenes, options);
  const Scene& first = scenes.front();
  const bool bar = options.difference || first.look.color_by;
  const PanelLayout layout = layout_of(pen, scenes, options, bar);
  const Eigen::Vector2i size = layout.size();
  FilmInfo film;
  film.scene = first.name;
  film.fps = first.video.fps;
  film.seconds_per_frame = first.video.speed / first.video.fps;
  film.first_frame = frames.first;
  film.expected_frames = frames.count();
  film.width = size.x();
  film.height = size.y();
  film.largest_file = options.largest_file;
  film.bands = bar ? color_bar_height(layout.text_size()) : 0;
  film.sheet = options.sheet;
  if (film.sheet) film.sheet->labelled = false;  // every picture has its time
  return film;
}

void require_comparison(const std::vector<LoadedScene>& scenes, const CompareOptions& options) {
  if (scenes.size() < 2) throw UsageError("drape compare needs at least two motions");
  for (const std::string& path : outputs_that(false, options)) {
    if (!format_of(path).drawn()) {
      throw UsageError(fmt::format("drape compare draws pictures, but -o {} has none", path));
    }
  }
  const int vertices = scenes.front().simulation.cloth.vertex_count();
  for (const LoadedScene& scene : scenes) {
    if (!options.difference || scene.simulation.cloth.vertex_count() == vertices) continue;
    throw UsageError(fmt::format("--difference compares vertex by vertex, but {} has {} vertices and {} has {}",
                                 shown(scenes.front().source.file), vertices, shown(scene.source.file),
                                 scene.simulation.cloth.vertex_count()));
  }
  for (const LoadedScene& scene : scenes) require_texture(scene);
  const Outputs films(outputs_that(false, options), comparison_info(scenes, options));
  for (const std::string& path : outputs_that(true, options)) require_writable(path);
}

CompareResult compare_scenes(const std::vector<LoadedScene>& scenes, const CompareOptions& options,
                             const std::stop_token& stop, Progress& progress) {
  return Comparison(scenes, options, stop, progress).run();
}

namespace {

/// Combines the vertices and colliders of all motions at a moment.
Frame together(const SynchronisedMotions::Moment& moment) {
  Frame all{};
  Eigen::Index rows = 0;
  for (const Frame* frame : moment) rows += frame->positions.rows();
  all.positions.resize(rows, 3);
  rows = 0;
  for (const Frame* frame : moment) {
    all.positions.middleRows(rows, frame->positions.rows()) = frame->positions;
    rows += frame->positions.rows();
    all.colliders.insert(all.colliders.end(), frame->colliders.begin(), frame->colliders.end());
  }
  return all;
}

}  // namespace

FilmExtent compared_extent(const std::vector<LoadedScene>& scenes, const CompareOptions& options, std::size_t i) {
  const Scene& scene = scenes[i];
  const std::int64_t steps =
      options.recorded.empty() || !options.recorded[i] ? scene.step_count() : options.recorded[i]->last_step();
  return FilmExtent(scenes.front().video, scene.simulation.step, options.steps.value_or(steps), std::nullopt);
}

FrameRange all_frames(const std::vector<LoadedScene>& scenes, const CompareOptions& options) {
  FrameRange all;
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    all.last = std::max(all.last, compared_extent(scenes, options, i).frames.last);
  }
  return all;
}

SynchronisedMotions::SynchronisedMotions(const std::vector<LoadedScene>& scenes, const CompareOptions& options,
                                         bool often)
    : scenes_(scenes), first_count_(compared_extent(scenes, options, 0).frames.count()) {
  const std::optional<std::size_t> memory =
      often ? std::optional(FrameTape::usual_memory / scenes.size()) : std::nullopt;
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    sources_.emplace_back(scenes[i], options.recorded.empty() ? nullptr : options.recorded[i],
                          compared_extent(scenes, options, i), memory);
  }
}

void SynchronisedMotions::play(int last, const std::stop_token& stop,
                               const std::function<void(int, const Moment&)>& work) {
  std::deque<FramePlayer> players;  // a deque, since players cannot be moved
  for (FrameSource& source : sources_) players.emplace_back(source);
  Moment moment(players.size());
  for (int k = 0; k <= last && !stop.stop_requested(); ++k) {
    for (std::size_t i = 0; i < players.size(); ++i) moment[i] = &players[i].next();
    work(k, moment);
  }
  // A motion counts as known after its last frame: ask for one more.
  for (std::size_t i = 0; i < players.size() && !stop.stop_requested(); ++i) players[i].next();
}

std::optional<CameraPath> SynchronisedMotions::camera_path(int count, const std::stop_token& stop) {
  const Scene& first = scenes_.front();
  struct Stopped {};
  const auto throw_if_stopped = [&] {
    if (stop.stop_requested()) throw Stopped();
  };
  try {
    Camera camera = first.camera;
    if (!camera.position) {
      camera = well_placed(camera, known_film(first, first.video.size, first_count_, [&](const auto& visit) {
                             sources_.front().pass(visit, stop);
                             throw_if_stopped();
                           }));
    }
    return drape::camera_path(camera, known_film(first, first.video.size, count, [&](const auto& visit) {
                                play(count - 1, stop, [&](int, const Moment& moment) { visit(together(moment)); });
                                throw_if_stopped();
                              }));
  } catch (const Stopped&) {
    return std::nullopt;
  }
}

}  // namespace drape
