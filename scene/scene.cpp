#include "scene/scene.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <initializer_list>

#include "scene/caption.hpp"
#include "scene/cloth_reader.hpp"
#include "scene/digest.hpp"
#include "scene/effects_reader.hpp"
#include "scene/method_names.hpp"
#include "scene/overrides.hpp"
#include "scene/physics.hpp"
#include "scene/quality.hpp"
#include "scene/table_reader.hpp"
#include "scene/tables.hpp"
#include "sim/effects/bending.hpp"
#include "sim/make_system.hpp"
#include "sim/schemes/registry.hpp"
#include "sim/simulation.hpp"

namespace drape {
namespace {

constexpr double most_steps = 1e9;
constexpr double most_frames = 1e7;

/// Rules between the keys of a scene's tables. Each rule is checked only if its values are in range.
class Checks {
 public:
  Checks(const Scene& scene, const TomlValue& document, Problems& problems)
      : scene_(scene), document_(document), problems_(problems) {}

  void length() const {
    const double steps = std::round(scene_.duration / scene_.simulation.step);
    const double frames = scene_.duration / scene_.video.speed * scene_.video.fps;
    if (!(steps <= most_steps)) {
      add("time", "duration",
          fmt::format("duration: {:g} s in steps of {:g} s are {:.4g} steps; the limit is {:g}", scene_.duration,
                      scene_.simulation.step, steps, most_steps));
    } else if (!(frames <= most_frames)) {
      add("video", "fps", fmt::format("the film would have {:.4g} frames; the limit is {:g}", frames, most_frames));
    }
  }

  void stopping_rule() const {
    const IntegratorSettings& integrator = scene_.simulation.integrator;
    if (integrator.stop != StoppingRule::error || !is_explicit(integrator.method)) return;
    add("integrator", "stop",
        fmt::format("stop: {} computes a step without solving for it, so there is no solve error to stop at; use an "
                    "implicit method, or omit the key",
                    method_name(integrator.method)));
  }

  void accuracy() const {
    if (!scene_.simulation.accuracy) return;
    for (const char* key : {"tolerance", "stop"}) {
      if (find_path(document_, std::string("integrator.") + key) == nullptr) continue;
      add("integrator", key,
          fmt::format("{}: an accuracy in [time] already determines when a step is solved well enough: omit one of "
                      "the two",
                      key));
    }
    const bool given = find_path(document_, "integrator.scheme") != nullptr;
    if (given && scene_.simulation.integrator.scheme == TimeScheme::backward_euler) {
      add("integrator", "scheme",
          "scheme: an accuracy in [time] is reached with \"sdirk2\": omit \"backward-euler\", or the accuracy");
    }
  }

  /// Checks the stability of the whole simulation, after all other checks passed.
  void stability() const {
    const SimulationSettings& settings = scene_.simulation;
    if (settings.integrator.allow_unstable) return;
    if (const auto problem = stability_problem(settings, make_system(settings))) {
      add("time", "step", "step: " + *problem);
    }
  }

  /// Reports a time scheme for an explicit method.
  void scheme() const {
    const Method method = scene_.simulation.integrator.method;
    if (!is_explicit(method) || find_path(document_, "integrator.scheme") == nullptr) return;
    add("integrator", "scheme",
        fmt::format("scheme: it applies to implicit methods, and {} is a scheme of its own: omit it, or use method = "
                    "\"implicit\", \"liu13\" or \"quasi-newton\"",
                    method_name(method)));
  }

  void camera() const {
    const Camera& camera = scene_.camera;
    if (camera.up.isZero(0)) add("camera", "up", "up: expected a direction, found [0, 0, 0]");
    for (const auto& [key, given] : {std::pair("position", camera.position), std::pair("target", camera.target)}) {
      if (camera.follow && given)
        add("camera", "follow", std::string("follow: a camera with a ") + key + " cannot follow");
    }
    if (camera.position && camera.position == camera.target) {
      add("camera", "target", "target: the camera's position and target are the same point");
    }
  }

  void samples() const {
    if (scene_.look.samples == 3) add("look", "samples", "samples must be 1, 2 or 4, found 3");
  }

  void compared_frames() const {
    const std::vector<int>& frames = scene_.check.frames;
    if (std::adjacent_find(frames.begin(), frames.end(), std::greater_equal<>()) != frames.end()) {
      add("check", "frames", "frames: expected numbers in ascending order, each once");
    }
  }

  /// Reports compared frames beyond the film's end, unless an unrelated override has shortened the film.
  void compared_frames_exist() const {
    const double last = scene_.video.last_frame(static_cast<double>(scene_.step_count()) * scene_.simulation.step);
    const auto& frames = scene_.check.frames;
    const auto beyond = std::find_if(frames.begin(), frames.end(), [&](int frame) { return frame > last; });
    if (beyond == frames.end()) return;
    const TomlValue* value = find_path(document_, "check.frames");
    const bool given_with_them = value != nullptr && value->place.override_number > 0;
    if (!given_with_them && length_is_overridden()) return;
    const TomlArray* numbers = value == nullptr ? nullptr : value->as<TomlArray>();
    const auto index = static_cast<std::size_t>(beyond - frames.begin());
    problems_.add(numbers == nullptr ? document_.place : numbers->at(index).place,
                  fmt::format("frames: the film ends with frame {}, found {}", last, *beyond));
  }

  /// Reports ignored frames or areas outside the film, unless an unrelated override has made it shorter or smaller.
  void ignored_exists() const {
    const double last = scene_.video.last_frame(static_cast<double>(scene_.step_count()) * scene_.simulation.step);
    const std::vector<int>& frames = scene_.check.ignore_frames;
    const auto beyond = std::find_if(frames.begin(), frames.end(), [&](int frame) { return frame > last; });
    if (beyond != frames.end() && !length_is_overridden()) {
      add("check", "ignore_frames", fmt::format("ignore_frames: the film ends with frame {}, found {}", last, *beyond));
    }
    const Eigen::Vector2i size = scene_.check.size.value_or(scene_.video.size);
    const auto outside = [&](const PixelRectangle& r) { return r[0] >= size.x() || r[1] >= size.y(); };
    const auto& rectangles = scene_.check.ignore;
    const auto found = std::find_if(rectangles.begin(), rectangles.end(), outside);
    if (found == rectangles.end() || is_overridden({"video.size", "check.size"})) return;
    add("check", "ignore",
        fmt::format("ignore: [{}] is outside of the picture, which has {}x{} pixels", fmt::join(*found, ", "), size.x(),
                    size.y()));
  }

  void texture() const {
    if (!scene_.look.texture.empty() && scene_.uvs.empty()) {
      add("look", "texture", "texture: the mesh has no texture coordinates");
    }
  }

 private:
  [[nodiscard]] bool length_is_overridden() const {
    return is_overridden({"time.duration", "time.step", "video.fps", "video.speed"});
  }

  [[nodiscard]] bool is_overridden(std::initializer_list<const char*> keys) const {
    return std::any_of(keys.begin(), keys.end(), [&](const char* key) {
      const TomlValue* value = find_path(document_, key);
      return value != nullptr && value->place.override_number > 0;
    });
  }

  void add(const char* table, const char* key, std::string message) const {
    const TomlValue* value = find_path(document_, table);
    problems_.add(value == nullptr ? document_.place : place_of(*value, key), std::move(message));
  }

  const Scene& scene_;
  const TomlValue& document_;
  Problems& problems_;
};

/// Chooses a method and writes its name to the scene and the document, so that a recorded motion names it.
void name_method(Scene& scene, TomlValue& document, Problems& problems) {
  SimulationSettings& settings = scene.simulation;
  scene.choice = choose_method(settings);
  scene.choice->apply(settings);
  const IntegratorSettings& integrator = settings.integrator;
  if (settings.accuracy && !is_explicit(integrator.method)) settings.integrator.scheme = TimeScheme::sdirk2;
  std::vector<std::string> names{"integrator.method=" + method_name(integrator.method)};
  if (integrator.substeps) names.push_back(fmt::format("integrator.substeps={}", *integrator.substeps));
  apply_overrides(document, names, problems);
}

}  // namespace

std::int64_t Scene::step_count() const { return static_cast<std::int64_t>(std::llround(duration / simulation.step)); }

Scene load_scene(const std::filesystem::path& file, const std::vector<std::string>& overrides, Cells cells) {
  Scene scene = make_scene(read_document(file), file, overrides, cells);
  scene.inputs.push_back(file);
  return scene;
}

Scene make_scene(TomlValue document, const std::filesystem::path& file, const std::vector<std::string>& overrides,
                 Cells cells) {
  std::erase_if(document.as<TomlTable>()->entries, [](const TomlEntry& entry) { return entry.name == "sweep"; });
  Problems problems(file, overrides);
  apply_overrides(document, overrides, problems);
  if (const TomlValue* motion = find_path(document, "cloth.motion")) {
    problems.add(motion->place,
                 "motion: this scene plays a motion that is read, and a scene that is simulated is needed here; drape "
                 "render, compare, check, bless and audit take it");
    problems.throw_if_any();
  }
  const bool draft = cells == Cells::of_quality ? says_draft(document) : cells == Cells::of_draft;
  if (draft) coarsen_grid(document);

  Scene scene;
  scene.file = file;
  scene.name = file.stem().string();
  const std::filesystem::path folder = file.parent_path();

  ClothTable cloth_table;
  TableReader reader(folder, problems);
  reader.read_all(document, scene_tables(cloth_table, scene));
  bool cloth_good = false;
  SelectableMesh mesh;
  std::vector<std::filesystem::path> cloth_inputs;
  if (const TomlValue* value = find_path(document, "cloth")) {
    if (auto cloth = read_cloth(cloth_table, *value, folder, problems)) {
      scene.simulation.cloth = std::move(cloth->cloth);
      scene.uvs = std::move(cloth->uvs);
      mesh = std::move(cloth->mesh);
      cloth_inputs = std::move(cloth->inputs);
      for (const std::string& doubt : cloth->warnings) {
        scene.warnings.push_back(problems.text(place_of(*value, "mesh")) + ": mesh: " + doubt);
      }
      reader.set_mesh(&mesh);
      cloth_good = reader.good("cloth") && reader.good("cloth.transform");
    }
  }
  const std::vector<ReadEffect> effects = read_effects(document, reader, problems);
  scene.inputs = reader.files();
  scene.inputs.insert(scene.inputs.end(), cloth_inputs.begin(), cloth_inputs.end());
  if (const TomlValue* look = find_path(document, "look")) {
    scene.texture_location = problems.text(place_of(*look, "texture"));
    if (!scene.look.texture.empty() && find_path(*look, "color") != nullptr) {
      scene.warnings.push_back(problems.text(place_of(*look, "color")) +
                               ": color: it is not seen, because the texture covers the cloth: omit one of the two");
    }
  }

  for (const ReadEffect& read : effects) scene.simulation.effects.add(read.effect);
  apply_quality(scene, [&](const char* key) {
    const TomlValue* value = find_path(document, key);
    return value != nullptr && value->place.override_number > 0;
  });

  scene.fields = scene_fields(scene.name, scene_tables(cloth_table, scene), effects, document);
  if (const TomlValue* caption = find_path(document, "caption")) {
    const Place place = place_of(*caption, "text");
    scene.caption.filled = fill_caption(scene.caption.text, scene.fields, place, problems);
    scene.caption_place = problems.text(place);
  }

  const bool keys_good = problems.count() == 0;
  // Check a rule only if all of its tables were read well; otherwise defaults replace wrong values.
  const Checks checks(scene, document, problems);
  if (reader.good("time") && reader.good("video")) checks.length();
  if (reader.good("integrator")) {
    checks.scheme();
    checks.stopping_rule();
    if (reader.good("time")) checks.accuracy();
    // An accuracy needs second-order schemes, see SubstepScheme.
    IntegratorSettings& integrator = scene.simulation.integrator;
    if (integrator.method == Method::automatic) {
      const bool solved = find_path(document, "integrator.scheme") != nullptr;
      integrator.method = implied_method(integrator).value_or(solved ? Method::quasi_newton : Method::automatic);
    }
    const bool implicit = !is_explicit(integrator.method) && integrator.method != Method::automatic;
    if (scene.simulation.accuracy && implicit) integrator.scheme = TimeScheme::sdirk2;
  }
  if (reader.good("camera")) checks.camera();
  if (reader.good("look")) checks.samples();
  if (reader.good("look") && cloth_good) checks.texture();
  if (reader.good("time") && reader.good("integrator") && cloth_good) {
    check_effects(effects, scene.simulation, problems);
  }
  if (cloth_table.material != nullptr && find_path(document, "effects.bending") == nullptr) {
    scene.simulation.effects.add(Bending{.rigidity = cloth_table.material->rigidity});
  }
  if (reader.good("check")) checks.compared_frames();
  if (reader.good("check") && reader.good("time") && reader.good("video")) {
    checks.compared_frames_exist();
    checks.ignored_exists();
  }
  if (keys_good) problems.throw_if_any<SceneConflict>();
  problems.throw_if_any();
  scene.digest = digest(document, {"check", "caption", "overlay"});
  if (scene.simulation.integrator.method == Method::automatic) {
    name_method(scene, document, problems);
    scene.fields = scene_fields(scene.name, scene_tables(cloth_table, scene), effects, document);
    if (const TomlValue* caption = find_path(document, "caption")) {
      scene.caption.filled = fill_caption(scene.caption.text, scene.fields, place_of(*caption, "text"), problems);
    }
  }
  scene.tables = physics_of_tables(scene_tables(cloth_table, scene), effects, folder);
  scene.portable = make_portable(document, folder, scene.inputs);
  checks.stability();
  problems.throw_if_any<SceneConflict>();
  return scene;
}

}  // namespace drape
