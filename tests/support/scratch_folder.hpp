#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>

namespace drape::test {

/// An empty folder of the running test, removed by the destructor.
class ScratchFolder {
 public:
  /// @param suffix  distinguishes several folders of one test
  explicit ScratchFolder(const std::string& suffix = "") {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    std::string name =
        std::string(test->test_suite_name()) + "-" + test->name() + "-" + std::to_string(::getpid()) + suffix;
    std::replace(name.begin(), name.end(), '/', '-');  // in names of parametrised tests
    folder_ = std::filesystem::temp_directory_path() / ("drape-" + name);
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  ~ScratchFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return folder_; }
  [[nodiscard]] std::string path(const std::string& name) const { return (folder_ / name).string(); }

  /// Writes a file and makes its folder. Returns the file.
  static std::filesystem::path put(const std::filesystem::path& file, const std::string& bytes) {
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file, std::ios::binary) << bytes;
    return file;
  }

  /// Counts all files, including hidden ones.
  [[nodiscard]] std::size_t file_count() const {
    std::size_t count = 0;
    for ([[maybe_unused]] const auto& entry : std::filesystem::recursive_directory_iterator(folder_)) {
      count += entry.is_directory() ? 0 : 1;
    }
    return count;
  }

 protected:
  std::filesystem::path folder_;
};

/// A test with a scratch folder.
class InScratchFolder : public ::testing::Test, protected ScratchFolder {};

}  // namespace drape::test
