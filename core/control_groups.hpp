#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace drape {

/// A control group of this process, or a group around it.
struct ControlGroup {
  std::filesystem::path folder;  ///< folder of its files; need not exist
  int version;                   ///< 1 or 2; their files have different names
};

/// Returns the groups that limit this process's use of a resource. Inside a container the path of the group may not
/// exist; then the mount point is the container's own group.
/// @param controller "memory" or "cpu"
/// @param root       folder that holds /proc and /sys
std::vector<ControlGroup> control_groups(const std::string& controller, const std::filesystem::path& root);

}  // namespace drape
