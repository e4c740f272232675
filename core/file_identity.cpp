#include "core/file_identity.hpp"

#include <sys/stat.h>

#include <cerrno>
#include <system_error>

namespace drape {
namespace fs = std::filesystem;

fs::path link_target(const fs::path& file) {
  constexpr int most_links = 40;  // same limit as Linux
  fs::path target = fs::absolute(file);
  for (int i = 0; fs::is_symlink(fs::symlink_status(target)); ++i) {
    if (i == most_links) throw fs::filesystem_error("", file, std::error_code(ELOOP, std::generic_category()));
    target = target.parent_path() / fs::read_symlink(target);
  }
  return target;
}

std::string file_identity(const fs::path& file) {
  struct stat status {};
  if (::stat(file.c_str(), &status) == 0) {
    return "inode " + std::to_string(status.st_dev) + " " + std::to_string(status.st_ino);
  }
  try {
    const fs::path target = link_target(file);
    return (fs::weakly_canonical(target.parent_path()) / target.filename()).string();
  } catch (const fs::filesystem_error&) {
    std::error_code ignored;  // opening the file will report the problem
    return fs::absolute(file, ignored).lexically_normal().string();
  }
}

}  // namespace drape
