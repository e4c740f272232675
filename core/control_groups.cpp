#include "core/control_groups.hpp"

#include <fstream>
#include <sstream>

namespace drape {
namespace {

namespace fs = std::filesystem;

/// Adds a group below a mount, and all groups around it.
void add_way_up(const fs::path& mount, fs::path group, int version, std::vector<ControlGroup>& groups) {
  for (group = group.relative_path();; group = group.parent_path()) {
    groups.push_back({mount / group, version});
    if (group.empty()) return;
  }
}

}  // namespace

std::vector<ControlGroup> control_groups(const std::string& controller, const fs::path& root) {
  // Lines are "number:controllers:path"; version 2 has no controllers.
  std::vector<ControlGroup> groups;
  std::ifstream stream(root / "proc/self/cgroup");
  for (std::string line; std::getline(stream, line);) {
    std::istringstream fields(line);
    std::string number, controllers, path;
    std::getline(fields, number, ':');
    std::getline(fields, controllers, ':');
    std::getline(fields, path);
    const fs::path mounts = root / "sys/fs/cgroup";
    if (controllers.empty()) {
      // Next to version 1, version 2 may be mounted in a folder of its own.
      for (const fs::path& mount : {mounts, mounts / "unified"}) add_way_up(mount, path, 2, groups);
    } else if (("," + controllers + ",").find("," + controller + ",") != std::string::npos) {
      add_way_up(mounts / controller, path, 1, groups);
    }
  }
  return groups;
}

}  // namespace drape
