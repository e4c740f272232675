#include "drape/scene/scene.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cmath>
#include <functional>
#include <initializer_list>
#include <memory>
#include <numbers>
#include <optional>
#include <span>
#include <vector>

#include "drape/scene/document.hpp"
#include "drape/sim/effects/bending.hpp"
#include "drape/sim/simulation.hpp"
#include "scene/cloth_reader.hpp"
#include "scene/scene_values.hpp"
#include "scene/table_reader.hpp"
#include "scene/tables.hpp"
#include "sim/schemes/registry.hpp"
#include "sim/system.hpp"

namespace drape {
namespace {

constexpr double most_steps = 1e9;
constexpr double most_frames = 1e7;

double radians(double degrees) { return degrees * (std::numbers::pi / 180); }

/// Returns the effect with the direction of the warp of the cloths that it acts on, if it depends on that.
Effect along_warp(const ReadEffect& read, const ClothList& cloths, Problems& problems) {
  const Bending* bending = read.effect.as<Bending>();
  if (bending == nullptr || !bending->rigidity) return read.effect;
  std::vector<double> warps;  // [degrees]
  for (const ClothTable& table : cloths.tables) {
    if (bending->cloth.empty() || bending->cloth == table.name) warps.push_back(table.warp);
  }
  if (warps.empty()) return read.effect;  // an unknown cloth, which the effect reports
  if (!bending->rigidity->isotropic() && std::ranges::count(warps, warps.front()) != std::ssize(warps)) {
    problems.add(place_of(*read.table, "rigidity"),
                 "rigidity: the cloths have different warps: name one of them by 'cloth', and give the others a "
                 "[[effects.bending]] of their own");
  }
  Bending turned = *bending;
  turned.rigidity->angle = radians(warps.front());
  return turned;
}

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
    const TimeScheme scheme = scene_.simulation.integrator.scheme;
    if (given && scheme != TimeScheme::sdirk2) {
      add("integrator", "scheme",
          fmt::format("scheme: an accuracy in [time] is reached with \"sdirk2\": omit \"{}\", or the accuracy",
                      scheme_name(scheme)));
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
    for (std::size_t k = 0; k < scene_.look.cloths.size(); ++k) {
      const std::vector<ClothPiece>& pieces = scene_.simulation.cloth.pieces;
      const ClothLook& look = scene_.look.cloths[k];
      if (look.place.empty() || has_coordinates(pieces[k])) continue;
      const TomlValue* item = find_path(document_, "cloth." + pieces[k].name);
      problems_.add(item == nullptr ? document_.place : place_of(*item, "texture"),
                    "texture: the mesh has no texture coordinates");
    }
  }

 private:
  /// Returns true if any corner of a piece has texture coordinates other than zero.
  [[nodiscard]] bool has_coordinates(const ClothPiece& piece) const {
    if (scene_.uvs.empty()) return false;
    const auto corners = std::span(scene_.uvs)
                             .subspan(3 * static_cast<std::size_t>(piece.first_triangle),
                                      3 * static_cast<std::size_t>(piece.triangle_count));
    return std::ranges::any_of(corners, [](const std::array<float, 2>& uv) { return uv[0] != 0 || uv[1] != 0; });
  }

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

/// Adds the bending rigidity of a cloth's material, unless an effect acts on that cloth's bending.
void add_bending_of_materials(const ClothList& cloths, Effects& effects) {
  const std::size_t written = effects.size();
  std::vector<Bending> added;
  for (const ClothTable& table : cloths.tables) {
    if (table.material == nullptr) continue;
    bool bends = false;
    for (std::size_t k = 0; k < written; ++k) {
      const auto* bending = effects[k].as<Bending>();
      bends = bends || (bending != nullptr && (bending->cloth.empty() || bending->cloth == table.name));
    }
    const std::string only = cloths.tables.size() > 1 ? table.name : "";
    if (bends) continue;
    WarpWeft rigidity = table.material->rigidity;
    rigidity.angle = radians(table.warp);
    added.push_back({.rigidity = rigidity, .cloth = only});
  }
  for (const Bending& bending : added) effects.add(bending);
}

/// Returns the overrides that name a method where `choice` was made.
std::vector<std::string> method_overrides(const MethodChoice& choice, Method method) {
  std::vector<std::string> names{"integrator.method=" + method_name(method)};
  if (method == Method::verlet && !choice.adapts) {
    names.push_back(fmt::format("integrator.substeps={}", choice.substeps));
  }
  return names;
}

/// Chooses a method and writes its name to the scene and the document, so that a recorded motion names it.
void name_method(Scene& scene, TomlValue& document, Problems& problems) {
  SimulationSettings& settings = scene.simulation;
  scene.choice = choose_method(settings);
  scene.choice->apply(settings);
  const Method method = settings.integrator.method;
  if (settings.accuracy && !is_explicit(method)) settings.integrator.scheme = TimeScheme::sdirk2;
  apply_overrides(document, method_overrides(*scene.choice, method), problems);
}

}  // namespace

std::int64_t Scene::step_count() const { return static_cast<std::int64_t>(std::llround(duration / simulation.step)); }

std::vector<std::vector<std::string>> shared_method_overrides(const std::vector<std::optional<MethodChoice>>& choices) {
  std::vector<MethodChoice> made;
  for (const auto& choice : choices) {
    if (choice) made.push_back(*choice);
  }
  std::vector<std::vector<std::string>> overrides(choices.size());
  const std::optional<Method> shared = shared_method(made);
  if (!shared || std::ranges::all_of(made, [&](const MethodChoice& one) { return one.method == *shared; })) {
    return overrides;
  }
  for (std::size_t i = 0; i < choices.size(); ++i) {
    if (choices[i]) overrides[i] = method_overrides(*choices[i], *shared);
  }
  return overrides;
}

LoadedScene load_scene(const std::filesystem::path& file, const std::vector<std::string>& overrides, Cells cells,
                       const std::optional<std::filesystem::path>& override_folder) {
  LoadedScene scene = make_scene(read_document(file), file, overrides, cells, override_folder);
  scene.source.inputs.push_back(file);
  return scene;
}

LoadedScene make_scene(TomlValue document, const std::filesystem::path& file, const std::vector<std::string>& overrides,
                       Cells cells, const std::optional<std::filesystem::path>& override_folder) {
  std::erase_if(document.as<TomlTable>()->entries, [](const TomlEntry& entry) { return entry.name == "sweep"; });
  Problems problems(file, overrides, override_folder);
  apply_overrides(document, overrides, problems);
  const TomlValue* motion = find_path(document, "cloth.motion");
  if (motion != nullptr && motion->as<TomlTable>() == nullptr) {  // a table: the cloth with this name
    problems.add(
        motion->place,
        "motion: expected a scene that is simulated; this one plays a recorded motion, which drape render, compare, "
        "check, bless and audit take");
    problems.throw_if_any();
  }
  const bool draft = cells == Cells::of_quality ? says_draft(document) : cells == Cells::of_draft;
  if (draft) coarsen_grid(document);

  LoadedScene scene;
  SceneSource& source = scene.source;
  source.file = file;
  scene.name = file.stem().string();
  const std::filesystem::path folder = file.parent_path();

  TableReader reader(folder, problems);
  {
    ClothTable cloth;
    SeamTable seam;
    reader.read_all(document, scene_tables(cloth, seam, scene));
  }
  ClothList cloths = read_cloths(document, reader, folder, problems);
  const bool cloth_good = cloths.good && reader.good("cloth") && reader.good("cloth.transform");
  if (cloths.meshes.size() == cloths.tables.size()) {
    scene.simulation.cloth = std::move(cloths.cloth);
    scene.uvs = std::move(cloths.uvs);
    source.warnings = std::move(cloths.warnings);
    reader.set_meshes(cloths.meshes);
  }
  std::vector<ReadEffect> effects = read_effects(document, reader, problems);
  source.inputs = reader.files();
  source.inputs.insert(source.inputs.end(), cloths.inputs.begin(), cloths.inputs.end());
  if (const TomlValue* look = find_path(document, "look")) {
    source.texture_location = problems.text(place_of(*look, "texture"));
    if (!scene.look.texture.empty() && find_path(*look, "color") != nullptr) {
      source.warnings.push_back(problems.text(place_of(*look, "color")) +
                                ": color: it is not seen, because the texture covers the cloth: omit one of the two");
    }
  }

  scene.look.cloths = cloth_looks(cloths, scene.simulation.cloth, document, problems, scene.look);
  if (cloths.tables.size() == 1 && !cloths.tables.front().texture.empty()) {
    source.texture_location = problems.text(place_of(*find_path(document, "cloth"), "texture"));
  }

  for (const ReadEffect& read : effects) scene.simulation.effects.add(along_warp(read, cloths, problems));
  apply_quality(scene, [&](const char* key) {
    const TomlValue* value = find_path(document, key);
    return value != nullptr && value->place.override_number > 0;
  });

  const auto list_fields = [&] {
    source.fields = scene_fields(scene.name, written_tables(cloths, scene, effects, document));
    const TomlValue* caption = find_path(document, "caption");
    if (caption == nullptr) return;
    const Place place = place_of(*caption, "text");
    scene.caption.filled = fill_caption(scene.caption.text, source.fields, place, problems);
    source.caption_place = problems.text(place);
  };
  list_fields();

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
  add_bending_of_materials(cloths, scene.simulation.effects);
  if (reader.good("check")) checks.compared_frames();
  if (reader.good("check") && reader.good("time") && reader.good("video")) {
    checks.compared_frames_exist();
    checks.ignored_exists();
  }
  if (keys_good) problems.throw_if_any<SceneConflict>();
  problems.throw_if_any();
  source.digest = digest(document, tables_that_affect(TableType::Affects::nothing));
  if (scene.simulation.integrator.method == Method::automatic) {
    name_method(scene, document, problems);
    list_fields();
  }
  if (scene.simulation.accuracy && scene.simulation.integrator.method == Method::semi_implicit) {
    source.warnings.push_back(problems.text(place_of(*find_path(document, "integrator"), "method")) +
                              ": method: an accuracy in [time] is reached with \"verlet\", not with \"semi-implicit\"");
    scene.simulation.integrator.method = Method::verlet;
    list_fields();
  }
  source.tables = physics_of_tables(written_tables(cloths, scene, effects, document), folder);
  source.portable = make_portable(document, folder, source.inputs);
  checks.stability();
  problems.throw_if_any<SceneConflict>();
  return scene;
}

namespace {

using Given = std::function<bool(const char*)>;

/// Multiplies the size of the picture, and with it its lengths in pixels, by a positive fraction.
void scale_picture(Scene& scene, const Given& given, int numerator, int denominator) {
  constexpr int smallest_text = 6, largest_text = 512;  // limits of [caption] size
  constexpr double widest = 64;                         // limit of [look] line_width [pixels]
  if (given("video.size")) return;
  scene.video.size = scene.video.size * numerator / denominator;
  std::optional<int>& text = scene.caption.size;
  if (text && !given("caption.size")) {
    text = std::clamp(*text * numerator / denominator, smallest_text, largest_text);
  }
  double& width = scene.look.line_width;
  if (!given("look.line_width")) width = std::min(width * numerator / denominator, widest);
}

void make_draft(Scene& scene, const Given& given) {
  constexpr int smallest = 16;    // limit of [video] size
  constexpr double rate = 12.5;   // [1/s]
  constexpr double coarser = 10;  // factor of a tolerance
  const int side = scene.video.size.minCoeff();
  const bool half = side >= 2 * smallest;
  scale_picture(scene, given, half ? 1 : smallest, half ? 2 : side);
  if (!given("video.fps")) scene.video.fps = std::min(scene.video.fps, rate);
  if (!given("look.ambient_occlusion")) scene.look.ambient_occlusion = false;
  IntegratorSettings& integrator = scene.simulation.integrator;
  if (integrator.tolerance && !given("integrator.tolerance")) *integrator.tolerance *= coarser;
}

void make_print(Scene& scene, const Given& given) {
  constexpr int largest = 8192;  // limit of [video] size
  constexpr int samples = 4, anisotropy = 16;
  const int side = scene.video.size.maxCoeff();
  const bool twice = 2 * side <= largest;
  scale_picture(scene, given, twice ? 2 : largest, twice ? 1 : side);
  if (!given("look.samples")) scene.look.samples = samples;
  if (!given("look.anisotropy")) scene.look.anisotropy = anisotropy;
}

/// Returns true if every pin in a document is a corner, an edge or a border.
bool pins_by_name(const TomlValue& value) {
  const TomlTable* table = value.as<TomlTable>();
  const TomlArray* array = value.as<TomlArray>();
  if (array != nullptr) return std::ranges::all_of(*array, pins_by_name);
  const auto is_name = [](const TomlValue& pin) { return pin.as<std::string>() != nullptr; };
  return table == nullptr || std::ranges::all_of(table->entries, [&](const TomlEntry& entry) {
           const TomlArray* pins =
               entry.name == "pins" || entry.name == "along" ? entry.value.as<TomlArray>() : nullptr;
           return pins != nullptr ? std::ranges::all_of(*pins, is_name) : pins_by_name(entry.value);
         });
}

void coarsen_cloth(TomlValue& cloth) {
  constexpr std::int64_t enough = 400;  // cells
  TomlTable* of_cloth = cloth.as<TomlTable>();
  if (of_cloth == nullptr || of_cloth->find("rest") != nullptr) return;
  TomlValue* mesh = of_cloth->find("mesh");
  TomlTable* table = mesh == nullptr ? nullptr : mesh->as<TomlTable>();
  TomlValue* grid = table == nullptr ? nullptr : table->find("grid");
  TomlArray* counts = grid == nullptr || grid->place.override_number > 0 ? nullptr : grid->as<TomlArray>();
  if (counts == nullptr || counts->size() != 2) return;
  std::int64_t* const columns = (*counts)[0].as<std::int64_t>();
  std::int64_t* const rows = (*counts)[1].as<std::int64_t>();
  if (columns == nullptr || rows == nullptr || *columns <= 0 || *rows <= enough / *columns) return;
  for (std::int64_t* count : {columns, rows}) *count = (*count + 1) / 2;
}

}  // namespace

bool says_draft(const TomlValue& document) {
  const TomlValue* quality = find_path(document, "look.quality");
  const std::string* name = quality == nullptr ? nullptr : quality->as<std::string>();
  return name != nullptr && *name == "draft";
}

void coarsen_grid(TomlValue& document) {
  if (!pins_by_name(document)) return;
  TomlValue* cloth = document.as<TomlTable>()->find("cloth");
  if (cloth == nullptr) return;
  if (TomlArray* several = cloth->as<TomlArray>()) {
    for (TomlValue& one : *several) coarsen_cloth(one);
  } else {
    coarsen_cloth(*cloth);
  }
}

void apply_quality(Scene& scene, const std::function<bool(const char*)>& given) {
  if (scene.quality == Quality::draft) make_draft(scene, given);
  if (scene.quality == Quality::print) make_print(scene, given);
}

}  // namespace drape
