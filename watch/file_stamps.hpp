#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <vector>

namespace drape {

/// When each of some files was last written, and how large it is. Two are equal if no file has changed in between; a
/// file that is not there counts as one that differs from every other.
class FileStamps {
 public:
  FileStamps() = default;
  explicit FileStamps(const std::vector<std::filesystem::path>& files);

  /// Goes on with other files: those that it has keep their stamps, and the others get those of now.
  void follow(const std::vector<std::filesystem::path>& files);

  bool operator==(const FileStamps&) const = default;

 private:
  struct Stamp {
    bool there = false;
    std::filesystem::file_time_type written = {};
    std::uintmax_t size = 0;
    bool operator==(const Stamp&) const = default;
  };
  std::map<std::filesystem::path, Stamp> stamps_;
};

}  // namespace drape
