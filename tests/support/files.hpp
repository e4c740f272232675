#pragma once

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace drape::test {

/// Returns the bytes of a file; empty if it cannot be read.
inline std::string content(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

}  // namespace drape::test
