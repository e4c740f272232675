#include "core/temporary_folder.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <ctime>
#include <system_error>

#include "core/error.hpp"
#include "core/text.hpp"

namespace drape {
namespace fs = std::filesystem;
namespace {

/// Time within which a new folder gets its lock [s].
constexpr std::time_t unlocked = 60;

int open_folder(const fs::path& folder) {
  return ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
}

/// Removes a folder of this user that no process has locked any more.
void clear_folder(const fs::path& folder) {
  const int descriptor = open_folder(folder);
  if (descriptor < 0) return;
  struct stat status {};
  const bool old = ::fstat(descriptor, &status) == 0 && status.st_uid == ::geteuid() &&
                   std::time(nullptr) - status.st_mtime >= unlocked;
  std::error_code ignored;
  if (old && ::flock(descriptor, LOCK_EX | LOCK_NB) == 0) fs::remove_all(folder, ignored);
  ::close(descriptor);
}

void clear_away_all(const fs::path& place, const std::string& prefix) {
  std::error_code error;
  fs::directory_iterator entry(place, error);
  while (!error && entry != fs::directory_iterator()) {
    if (entry->path().filename().native().starts_with(prefix)) clear_folder(entry->path());
    entry.increment(error);
  }
}

}  // namespace

TemporaryFolder::TemporaryFolder(const std::string& kind) {
  std::error_code error;
  const fs::path place = fs::temp_directory_path(error);
  if (!error) clear_away_all(place, kind + "-");
  std::string name = (place / (kind + "-XXXXXX")).string();
  if (error || ::mkdtemp(name.data()) == nullptr) {
    const std::string reason = error ? error.message() : std::generic_category().message(errno);
    throw OutputError(fmt::format("cannot make a temporary folder in {}: {}", shown(place), reason));
  }
  path_ = name;
  descriptor_ = open_folder(path_);
  static_cast<void>(
      ::flock(descriptor_, LOCK_EX | LOCK_NB));  // on file systems without locks no folder is cleared away
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
  if (descriptor_ >= 0) ::close(descriptor_);
}

}  // namespace drape
