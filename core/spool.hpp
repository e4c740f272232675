#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "core/atomic_file.hpp"

namespace drape {

/// Bytes that are kept on disk until they can be written where they belong. The file has no name, so nothing is left of
/// it whatever happens to the process.
class Spool {
 public:
  /// @param output what the bytes are for: the spool lies in its folder, and messages name it
  /// @param kept   what they are: "its frames"
  /// @throws OutputError
  Spool(const PartialFile& output, std::string kept);

  /// Bytes that belong nowhere: they lie in the system's folder for temporary files.
  /// @param kept what they are: "the motion"
  /// @throws OutputError
  explicit Spool(std::string kept);

  /// @throws OutputError naming the system's reason, a full disk above all
  void append(std::string_view bytes);

  [[nodiscard]] std::uint64_t size() const { return size_; }

  /// Goes back to the first byte. Nothing can be appended after that; it can be gone back to again.
  void rewind();

  /// The next bytes. Never ask for more than there are.
  void read(void* bytes, std::size_t count);

  /// Writes all of it to a file.
  void copy_to(PartialFile& file);

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  [[noreturn]] void fail(int error_number) const;

  void open(const std::filesystem::path& folder);

  std::string problem_;  // what is said before the system's reason
  std::unique_ptr<std::FILE, Close> stream_;
  std::uint64_t size_ = 0;
};

}  // namespace drape
