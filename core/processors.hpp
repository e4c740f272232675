#pragma once

#include <filesystem>

namespace drape {

/// Returns how many threads of this process can run at once, at least one. It counts the processors of its affinity
/// (taskset, a cluster's share), limited by its control groups' processor time (a container's --cpus), rounded up.
/// @param root folder that holds /proc and /sys
int processors_left(const std::filesystem::path& root = "/");

}  // namespace drape
