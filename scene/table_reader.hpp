#pragma once

#include <deque>
#include <filesystem>
#include <string>
#include <vector>

#include "core/keys.hpp"
#include "drape/scene/document.hpp"
#include "drape/scene/scene.hpp"
#include "drape/sim/effects/effect.hpp"
#include "scene/selection.hpp"
#include "scene/tables.hpp"

namespace drape {

/// Reader of a document's tables as their TableType describes them. Everything else in them is a problem.
class TableReader {
 public:
  /// @param folder   folder of the scene, which holds the files that it names
  /// @param problems must outlive this object
  TableReader(std::filesystem::path folder, Problems& problems) : folder_(std::move(folder)), problems_(problems) {}

  /// Sets the meshes of all cloths for selections of vertices. Before that only the form of a selection is checked.
  void set_meshes(const std::deque<PlacedSelection>& meshes) { meshes_ = &meshes; }

  /// Reads the tables that the document has, except repeatable ones. Required ones must exist. Below the root, only a
  /// table `effects` is allowed besides; it is not read here.
  void read_all(const TomlValue& document, const std::vector<TableType>& types);

  /// Reads one table, except its entries named in `subtables`.
  void read(const TomlValue& value, const TableType& type, const std::vector<std::string>& subtables = {});

  /// Returns true if neither this table nor the root had problems: then absent keys are absent on purpose.
  [[nodiscard]] bool good(const std::string& table) const;

  /// Returns the files that the tables name, except those in custom forms.
  [[nodiscard]] const std::vector<std::filesystem::path>& files() const { return files_; }

 private:
  struct Home {
    std::string key, table;
  };

  void read_entries(const TomlTable& table, const TableType& type, const std::vector<std::string>& subtables);
  void report_unknown_below_root(const TomlEntry& entry, const std::vector<std::string>& tables);
  void report_unknown(const TomlEntry& entry, const TableType& type, const std::vector<std::string>& subtables);
  [[nodiscard]] const Home* home_of(const std::string& key) const;

  std::filesystem::path folder_;
  const std::deque<PlacedSelection>* meshes_ = nullptr;
  Problems& problems_;
  std::vector<Home> homes_;  // every key of every table, to suggest the right table
  std::vector<std::filesystem::path> files_;
  std::vector<std::string> bad_;  // tables with problems; "" is the root
};

/// Returns the place of `key` in a table, or the start of the table if the key is absent.
Place place_of(const TomlValue& table, std::string_view key);

/// Returns an item of an array, by its number from 0 or by its own `name`, or null.
const TomlValue* find_item(const TomlArray& items, std::string_view name);

/// Returns the node with a dotted name, "cloth.transform", or null. In an array a number from 0 selects an item, and so
/// does the item's own `name`.
const TomlValue* find_path(const TomlValue& document, std::string_view path);

/// An effect and the table that describes it.
struct ReadEffect {
  Effect effect;
  const TomlValue* table;
  bool good;  ///< true if read without a problem
};

/// Reads the tables [effects.NAME] of a document, in the order of the registry; equal names keep their document order.
std::vector<ReadEffect> read_effects(const TomlValue& document, TableReader& reader, Problems& problems);

/// Returns the key path of each effect: effects.NAME. Several effects of one name get numbers: effects.sphere.0.
std::vector<std::string> effect_paths(const std::vector<ReadEffect>& effects);

/// Lets each effect check its values against all other settings.
/// @param settings settings that contain these effects
void check_effects(const std::vector<ReadEffect>& effects, const SimulationSettings& settings, Problems& problems);

}  // namespace drape
