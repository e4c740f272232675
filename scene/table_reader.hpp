#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "scene/document.hpp"
#include "scene/problems.hpp"
#include "scene/selection.hpp"
#include "scene/tables.hpp"

namespace drape {

/// Reads tables of a document as their TableType says, and complains about everything in them that it does not mention.
class TableReader {
 public:
  /// @param folder   the scene's, where the files that it names are
  /// @param problems must outlive this object
  TableReader(std::filesystem::path folder, Problems& problems) : folder_(std::move(folder)), problems_(problems) {}

  /// Says what selections of vertices refer to. Until then, and with null, only their form is checked.
  void set_mesh(const SelectableMesh* mesh) { mesh_ = mesh; }

  /// Reads those of the tables that the document has. Required ones must be there, and below its root there may be
  /// nothing else but a table `effects`, which this does not read.
  void read_all(const TomlValue& document, const std::vector<TableType>& types);

  /// Reads one table. What it has under the names `subtables` is not read.
  void read(const TomlValue& value, const TableType& type, const std::vector<std::string>& subtables = {});

  /// Whether no table of this name had problems, nor the root: what it leaves out is then left out on purpose.
  [[nodiscard]] bool good(const std::string& table) const;

  /// The files that the tables name, but for those in forms of their own.
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
  const SelectableMesh* mesh_ = nullptr;
  Problems& problems_;
  std::vector<Home> homes_;  // every key of every table, to say where one belongs
  std::vector<std::filesystem::path> files_;
  std::vector<std::string> bad_;  // tables that had problems; "" is the root
};

/// Where `key` is written in a table, or where the table begins if it is not.
Place place_of(const TomlValue& table, std::string_view key);

/// The node with a dotted name, "cloth.transform", or null.
const TomlValue* find_path(const TomlValue& document, std::string_view path);

}  // namespace drape
