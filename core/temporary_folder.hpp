#pragma once

#include <filesystem>
#include <string>

namespace drape {

/// A private folder among the system's temporary files; removed by the destructor.
///
/// It is locked (flock) while it is in use. An unlocked one is left over from a killed process; creating the next
/// folder of its kind removes it.
class TemporaryFolder {
 public:
  /// @param kind beginning of its name: "drape-scene"
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
