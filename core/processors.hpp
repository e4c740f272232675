#pragma once

#include <filesystem>

namespace drape {

/// How many threads of this process can run at once, at least one: on the processors that it may use (taskset, a
/// cluster's share), and within the time of them that its control groups have (a container's --cpus), rounded up.
/// @param root where /proc and /sys are
int processors_left(const std::filesystem::path& root = "/");

}  // namespace drape
