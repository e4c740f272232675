#include "check/golden_folder.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <stdio.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <stdexcept>
#include <string_view>
#include <system_error>

#include "check/manifest.hpp"
#include "check/motion_file.hpp"
#include "check/picture.hpp"
#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/hash.hpp"
#include "core/text.hpp"

namespace drape {
namespace fs = std::filesystem;
namespace {

[[noreturn]] void refuse(const fs::path& place, std::string_view what) {
  throw UsageError(fmt::format("{}: {}; drape will not replace it: move it away", shown(place), what));
}

/// Returns true for the file name of a golden picture, see golden_picture(): "0040.png".
bool names_picture(const fs::path& name) {
  const std::string stem = name.stem().string();
  return name.extension() == ".png" && stem.size() >= 4 &&
         std::all_of(stem.begin(), stem.end(), [](char c) { return c >= '0' && c <= '9'; });
}

/// Returns true if a file or folder within a golden's folder belongs to the golden.
/// @param place relative to the folder
bool is_own(const fs::path& place) {
  const bool in_frames = place.parent_path() == "frames";
  return in_frames ? names_picture(place.filename())
                   : place == "manifest.json" || place == "motion.bin" || place == "frames";
}

/// Returns true if the beginning of a file contains a text.
bool mentions(const fs::path& file, std::string_view words) {
  constexpr std::size_t looked_at = 4096;
  std::error_code ignored;
  if (!fs::is_regular_file(file, ignored)) return false;
  std::ifstream stream(file, std::ios::binary);
  std::string start(looked_at, '\0');
  stream.read(start.data(), looked_at);
  return start.find(words) != std::string::npos;
}

/// Returns true if a folder holds a golden; one of its two files suffices, so that a damaged one counts.
bool is_golden(const fs::path& folder) {
  return mentions(folder / "manifest.json", "\"scene_hash\"") || mentions(folder / "motion.bin", "drape motion ");
}

/// Checks that a golden's file or folder has the expected type, if it exists.
void require_type(const fs::path& place, fs::file_type type) {
  std::error_code ignored;
  const fs::file_type found = fs::symlink_status(place, ignored).type();
  if (found == type || found == fs::file_type::not_found) return;
  refuse(place, found == fs::file_type::symlink     ? "is a link"
                : found == fs::file_type::directory ? "is a folder"
                : type == fs::file_type::directory  ? "is not a folder"
                                                    : "is not a regular file");
}

void require_own_files(const fs::path& folder) {
  for (const char* name : {"manifest.json", "motion.bin"}) require_type(folder / name, fs::file_type::regular);
  require_type(folder / "frames", fs::file_type::directory);
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder / "frames", ignored)) {
    if (names_picture(entry.path().filename())) require_type(entry.path(), fs::file_type::regular);
  }
}

[[noreturn]] void fail_to_write(const fs::path& folder, const std::error_code& error) {
  throw OutputError(fmt::format("cannot write {}: {}", shown(folder), error.message()));
}

std::error_code last_error() { return {errno, std::generic_category()}; }

/// Copies a file, folder or link; regular files as hard links if the file system supports them.
void keep(const fs::path& from, const fs::path& to) {
  if (fs::is_directory(fs::symlink_status(from))) {
    fs::create_directory(to);
    for (const auto& entry : fs::directory_iterator(from)) keep(entry.path(), to / entry.path().filename());
    fs::permissions(to, fs::status(from).permissions());
    return;
  }
  std::error_code error;
  fs::create_hard_link(from, to, error);
  if (error) fs::copy(from, to, fs::copy_options::copy_symlinks);
}

/// Copies the foreign contents of a golden's folder.
void keep_foreign(const fs::path& from, const fs::path& to) {
  for (const auto& entry : fs::directory_iterator(from)) {
    const fs::path name = entry.path().filename();
    if (name != "manifest.json" && name != "motion.bin" && name != "frames") keep(entry.path(), to / name);
  }
  if (!fs::exists(from / "frames")) return;
  for (const auto& entry : fs::directory_iterator(from / "frames")) {
    const fs::path name = entry.path().filename();
    if (!names_picture(name)) keep(entry.path(), to / "frames" / name);
  }
}

/// Gives the files and folders of a new golden the permissions of those that they replace.
void keep_permissions(const fs::path& from, const fs::path& to) {
  std::vector<fs::path> names{".", "frames", "manifest.json", "motion.bin"};
  for (const auto& entry : fs::directory_iterator(to / "frames")) {
    if (names_picture(entry.path().filename())) names.push_back("frames" / entry.path().filename());
  }
  for (const fs::path& name : names) {
    const fs::path old = from / name;
    if (!fs::exists(old)) continue;
    if (::access(old.c_str(), W_OK) != 0) fail_to_write(old, last_error());
    fs::permissions(to / name, fs::status(old).permissions());
  }
}

/// Renames a complete folder; removal of an older one of that name comes last.
void give_name(const fs::path& complete, const fs::path& folder) {
  std::error_code error;
  if (!fs::exists(folder)) {
    fs::rename(complete, folder, error);
    if (error) fail_to_write(folder, error);
    return;
  }
  if (::renameat2(AT_FDCWD, complete.c_str(), AT_FDCWD, folder.c_str(), RENAME_EXCHANGE) != 0) {
    // Some file systems cannot exchange two names atomically.
    if (errno != EINVAL && errno != ENOSYS) fail_to_write(folder, last_error());
    const fs::path old = complete.string() + "-old";
    fs::rename(folder, old, error);
    if (error) fail_to_write(folder, error);
    fs::rename(complete, folder, error);
    std::error_code ignored;
    if (error) {
      fs::rename(old, folder, ignored);
      fail_to_write(folder, error);
    }
    fs::rename(old, complete, ignored);
  }
  fs::remove_all(complete, error);
}

std::uintmax_t write_files(const fs::path& folder, const Golden& golden, const std::vector<Png>& pictures) {
  const std::string motion = pack_motion(golden);
  Golden sealed = golden;
  std::uintmax_t size = write_file_atomically(folder / "motion.bin", motion);
  for (std::size_t i = 0; i < golden.frames.size(); ++i) {
    sealed.frames[i].pixels = pixel_hash(decode_png(pictures[i], golden.size));
    size += write_file_atomically(golden_picture(folder, golden.frames[i].frame), pictures[i]);
  }
  return size + write_file_atomically(folder / "manifest.json", manifest_text(sealed, checksum_of(motion)));
}

/// Returns a hidden folder beside another one, unique to this process.
fs::path partial_folder(const fs::path& folder) {
  constexpr std::size_t longest = 200;  // a name has at most 255 bytes
  return folder.parent_path() /
         fmt::format(".{}.partial-{}", folder.filename().string().substr(0, longest), ::getpid());
}

}  // namespace

bool has_golden(const fs::path& folder) {
  std::error_code error;
  const fs::file_type named = fs::symlink_status(folder, error).type();
  if (named == fs::file_type::not_found) return false;
  const fs::file_type type = fs::status(folder, error).type();
  if (type == fs::file_type::not_found) refuse(folder, "is a broken link, where the golden should be");
  if (error) throw UsageError(fmt::format("{}: cannot be read: {}", shown(folder), error.message()));
  if (type != fs::file_type::directory) refuse(folder, "is a file, where the golden should be a folder");
  const bool empty = fs::is_empty(folder, error);
  if (error) throw UsageError(fmt::format("{}: cannot be read: {}", shown(folder), error.message()));
  if (empty) return false;
  if (!is_golden(folder)) refuse(folder, "is not a golden: it contains other files");
  require_own_files(folder);
  return true;
}

void require_only_golden(const fs::path& folder) {
  std::error_code ignored;
  if (fs::is_symlink(fs::symlink_status(folder, ignored))) refuse(folder, "is a link");
  if (!has_golden(folder)) return;
  for (const fs::path& place : {folder, folder / "frames"}) {
    for (const auto& entry : fs::directory_iterator(place, ignored)) {
      if (!is_own(entry.path().lexically_relative(folder))) refuse(entry.path(), "is not a part of a golden");
    }
  }
}

void remove_golden(const fs::path& folder) {
  require_only_golden(folder);
  std::error_code ignored;
  fs::remove_all(folder, ignored);
}

std::uintmax_t write_golden(const fs::path& folder, const Golden& golden, const std::vector<Png>& pictures) {
  has_golden(folder);  // throws if foreign data are in its place
  std::error_code error;
  const bool exists = fs::exists(folder);
  const fs::path target = exists ? fs::canonical(folder) : folder;
  const fs::path partial = partial_folder(target);
  fs::remove_all(partial, error);  // left by a killed process with the same number
  try {
    fs::create_directories(partial / "frames");
    const std::uintmax_t size = write_files(partial, golden, pictures);
    if (exists) keep_foreign(target, partial);
    if (exists) keep_permissions(target, partial);
    give_name(partial, target);
    return size;
  } catch (const fs::filesystem_error& problem) {
    fs::remove_all(partial, error);
    fail_to_write(folder, problem.code());
  } catch (...) {
    fs::remove_all(partial, error);
    throw;
  }
}

}  // namespace drape
