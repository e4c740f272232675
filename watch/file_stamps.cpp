#include "watch/file_stamps.hpp"

#include <system_error>
#include <utility>

namespace drape {

FileStamps::FileStamps(const std::vector<std::filesystem::path>& files) {
  for (const std::filesystem::path& file : files) {
    Stamp& stamp = stamps_[file];
    std::error_code error;
    stamp.written = std::filesystem::last_write_time(file, error);
    if (!error) stamp.size = std::filesystem::file_size(file, error);
    stamp.there = !error;
    if (!stamp.there) stamp = {};
  }
}

void FileStamps::follow(const std::vector<std::filesystem::path>& files) {
  FileStamps next(files);
  for (auto& [file, stamp] : next.stamps_) {
    if (const auto known = stamps_.find(file); known != stamps_.end()) stamp = known->second;
  }
  *this = std::move(next);
}

}  // namespace drape
