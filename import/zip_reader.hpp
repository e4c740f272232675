#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

namespace drape {

/// A ZIP archive whose members are read as streams.
class ZipReader {
 public:
  struct Member {
    std::string name;
    std::uint64_t offset = 0;            // offset of its local header
    std::uint64_t packed = 0, size = 0;  // [bytes]
    bool deflated = false;
  };

  /// @throws UsageError "file: message" unless it is a complete archive
  explicit ZipReader(std::filesystem::path file);

  [[nodiscard]] const std::vector<Member>& members() const { return members_; }
  [[nodiscard]] const std::filesystem::path& file() const { return file_; }

 private:
  std::filesystem::path file_;
  std::vector<Member> members_;
};

/// Sequential reader of an archive member.
class ZipStream {
 public:
  /// @throws UsageError "file: message"
  ZipStream(const ZipReader& zip, const ZipReader::Member& member);
  ~ZipStream();
  ZipStream(const ZipStream&) = delete;
  ZipStream& operator=(const ZipStream&) = delete;

  /// Reads the next bytes. @throws UsageError if there are fewer
  std::string read(std::size_t count);
  [[nodiscard]] std::uint64_t left() const { return left_; }

 private:
  struct Inflater;
  [[noreturn]] void fail_cut() const;

  std::string name_;
  std::ifstream stream_;
  std::uint64_t packed_left_, left_;
  std::unique_ptr<Inflater> inflater_;  // null for a stored member
};

}  // namespace drape
