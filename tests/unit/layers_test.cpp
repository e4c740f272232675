#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/files.hpp"

// ARCHITECTURE.md's table of folders says which folder may include which. Every include is checked against it.

namespace drape::layers {
namespace {

namespace fs = std::filesystem;
using Layers = std::map<std::string, std::set<std::string>>;  // a folder, and those that it may include

const fs::path root = DRAPE_SOURCE_DIR;

/// Returns the folders in a cell of the table: `sim/`.
std::set<std::string> folders_in(const std::string& cell) {
  static const std::regex folder("`([a-z/]+)/`");
  std::set<std::string> names;
  for (std::sregex_iterator match(cell.begin(), cell.end(), folder), end; match != end; ++match) {
    names.insert((*match)[1]);
  }
  return names;
}

Layers table() {
  static const std::regex row(R"(^\|([^|]*)\|[^|]*\|([^|]*)\|$)");
  Layers layers;
  std::istringstream text(test::content(root / "ARCHITECTURE.md"));
  for (std::string line; std::getline(text, line);) {
    std::smatch cells;
    if (!std::regex_match(line, cells, row)) continue;
    if (cells[2].str().find("everything") != std::string::npos) continue;
    for (const std::string& folder : folders_in(cells[1])) layers[folder] = folders_in(cells[2]);
  }
  return layers;
}

/// Returns the table's folder of a file: the longest prefix of its path; none: "".
std::string layer_of(const std::string& file, const Layers& layers) {
  std::string longest;
  for (const auto& [folder, uses] : layers) {
    if (file.starts_with(folder + "/") && folder.size() > longest.size()) longest = folder;
  }
  return longest;
}

/// Returns the files below `folder` by their place in the tree. Public headers stand in the same folders under
/// include/drape/.
std::map<std::string, fs::path> sources_in(const std::string& folder) {
  std::map<std::string, fs::path> files;
  for (const fs::path& top : {root, root / "include" / "drape"}) {
    if (!fs::exists(top / folder)) continue;
    for (const auto& entry : fs::recursive_directory_iterator(top / folder)) {
      if (entry.path().extension() != ".cpp" && entry.path().extension() != ".hpp") continue;
      files[fs::relative(entry.path(), top).string()] = entry.path();
    }
  }
  return files;
}

/// Returns true if one folder depends on another, directly or indirectly.
bool reaches(const Layers& layers, const std::string& from, const std::string& to, std::set<std::string>& seen) {
  if (!seen.insert(from).second) return false;
  const auto uses = layers.find(from);
  if (uses == layers.end()) return false;
  for (const std::string& next : uses->second) {
    if (next == to || reaches(layers, next, to, seen)) return true;
  }
  return false;
}

TEST(Layers, AreAcyclic) {
  const Layers layers = table();
  ASSERT_GE(layers.size(), 10U) << "the table of ARCHITECTURE.md was not found";
  for (const auto& [folder, uses] : layers) {
    std::set<std::string> seen;
    EXPECT_FALSE(reaches(layers, folder, folder, seen)) << folder << "/ may include itself over others";
  }
}

TEST(Layers, HoldInEveryInclude) {
  const Layers layers = table();
  static const std::regex include(R"re(#include "(?:drape/)?([a-z_]+/[a-z_/]+\.hpp)")re");
  int found = 0;
  for (const auto& [folder, uses] : layers) {
    for (const auto& [name, file] : sources_in(folder)) {
      if (layer_of(name, layers) != folder) continue;  // belongs to a subfolder with its own row
      const std::string text = test::content(file);
      for (std::sregex_iterator match(text.begin(), text.end(), include), end; match != end; ++match, ++found) {
        const std::string used = layer_of((*match)[1], layers);
        EXPECT_TRUE(used == folder || uses.contains(used)) << name << " includes " << (*match)[1];
      }
    }
  }
  EXPECT_GT(found, 500);
}

}  // namespace
}  // namespace drape::layers
