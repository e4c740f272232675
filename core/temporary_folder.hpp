#pragma once

#include <filesystem>
#include <string>

namespace drape {

/// A folder of this user alone among the system's temporary files, which lives as long as this.
///
/// It is locked (flock) all the time. One that is not was left by a process that was killed: it goes when the next
/// folder of its kind is made.
class TemporaryFolder {
 public:
  /// @param kind what its name begins with: "drape-scene"
  /// @throws OutputError
  explicit TemporaryFolder(const std::string& kind);
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  int descriptor_ = -1;
};

}  // namespace drape
