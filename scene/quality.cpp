#include "scene/quality.hpp"

#include <algorithm>

#include "scene/table_reader.hpp"

namespace drape {
namespace {

using Given = std::function<bool(const char*)>;

void make_draft(Scene& scene, const Given& given) {
  constexpr int smallest = 16;    // limit of [video] size
  constexpr double rate = 12.5;   // [1/s]
  constexpr double coarser = 10;  // factor of a tolerance
  if (!given("video.size")) scene.video.size = (scene.video.size / 2).cwiseMax(smallest);
  if (!given("video.fps")) scene.video.fps = std::min(scene.video.fps, rate);
  if (!given("look.samples")) scene.look.samples = 1;
  if (!given("look.ambient_occlusion")) scene.look.ambient_occlusion = false;
  IntegratorSettings& integrator = scene.simulation.integrator;
  if (integrator.tolerance && !given("integrator.tolerance")) *integrator.tolerance *= coarser;
}

void make_print(Scene& scene, const Given& given) {
  constexpr int largest = 8192;  // limit of [video] size
  constexpr int samples = 4, anisotropy = 16;
  if (!given("video.size")) scene.video.size = (scene.video.size * 2).cwiseMin(largest);
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
           const TomlArray* pins = entry.name == "pins" ? entry.value.as<TomlArray>() : nullptr;
           return pins != nullptr ? std::ranges::all_of(*pins, is_name) : pins_by_name(entry.value);
         });
}

}  // namespace

bool says_draft(const TomlValue& document) {
  const TomlValue* quality = find_path(document, "look.quality");
  const std::string* name = quality == nullptr ? nullptr : quality->as<std::string>();
  return name != nullptr && *name == "draft";
}

void coarsen_grid(TomlValue& document) {
  constexpr std::int64_t enough = 400;  // cells
  if (!pins_by_name(document)) return;
  TomlValue* cloth = document.as<TomlTable>()->find("cloth");
  TomlTable* of_cloth = cloth == nullptr ? nullptr : cloth->as<TomlTable>();
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

void apply_quality(Scene& scene, const std::function<bool(const char*)>& given) {
  if (scene.quality == Quality::draft) make_draft(scene, given);
  if (scene.quality == Quality::print) make_print(scene, given);
}

}  // namespace drape
