#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace drape {

/// A control group that this process is in, or one around it.
struct ControlGroup {
  std::filesystem::path folder;  ///< of its files; it need not exist
  int version;                   ///< 1 or 2, whose files have other names
};

/// The groups that limit what the process may take of what a controller hands out. In a container it may be in a group
/// whose path means nothing there; what is mounted is then the container's own.
/// @param controller "memory" or "cpu"
/// @param root       where /proc and /sys are
std::vector<ControlGroup> control_groups(const std::string& controller, const std::filesystem::path& root);

}  // namespace drape
