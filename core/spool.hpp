#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "core/atomic_file.hpp"

namespace drape {

/// Bytes kept on disk until they can be written to their destination. The file has no name, so that nothing remains of
/// it even if the process is killed.
class Spool {
 public:
  /// @param output destination of the bytes: the spool lies in its folder, and messages name it
  /// @param kept   name of the bytes: "its frames"
  /// @throws OutputError
  Spool(const PartialFile& output, std::string kept);

  /// Keeps bytes without a destination in the system's folder for temporary files.
  /// @param kept name of the bytes: "the motion"
  /// @throws OutputError
  explicit Spool(std::string kept);

  /// Appends bytes. @throws OutputError with the system's reason, such as a full disk
  void append(std::string_view bytes);

  [[nodiscard]] std::uint64_t size() const { return size_; }

  /// Returns to the first byte, any number of times. No append() may follow.
  void rewind();

  /// Reads the next bytes; `count` must not exceed the rest.
  void read(void* bytes, std::size_t count);

  /// Writes all bytes to a file.
  void copy_to(PartialFile& file);

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  [[noreturn]] void fail(int error_number) const;

  void open(const std::filesystem::path& folder);

  std::string problem_;  // beginning of a message, before the system's reason
  std::unique_ptr<std::FILE, Close> stream_;
  std::uint64_t size_ = 0;
};

}  // namespace drape
