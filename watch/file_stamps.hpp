#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <vector>

namespace drape {

/// Modification times and sizes of some files. Two are equal if no file changed in between. A missing file differs from
/// every existing one.
class FileStamps {
 public:
  FileStamps() = default;
  explicit FileStamps(const std::vector<std::filesystem::path>& files);

  /// Changes the set of files: known files keep their stamps, new ones get current stamps.
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
