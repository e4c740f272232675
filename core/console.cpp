#include "core/console.hpp"

#include <fcntl.h>
#include <unistd.h>
#include <algorithm>
#include <atomic>
#include <cctype>
#include <cerrno>
#include <string_view>

#include "core/text.hpp"

namespace drape {
namespace {

std::atomic<int> first_error = 0;  // first error number of standard output; 0: none

}  // namespace

void open_standard_streams() {
  for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    // open() returns the lowest free descriptor, and all lower ones are open by now.
    if (::fcntl(descriptor, F_GETFD) < 0 && errno == EBADF) static_cast<void>(::open("/dev/null", O_RDWR));
  }
}

void print_text(std::FILE* stream, std::string_view text) { print_unescaped(stream, escape_controls(text)); }

bool print_unescaped(std::FILE* stream, std::string_view text) {
  const std::scoped_lock lock(console_mutex());
  errno = 0;
  const bool printed = std::fwrite(text.data(), 1, text.size(), stream) == text.size() && std::fflush(stream) == 0;
  int none = 0;
  if (!printed && stream == stdout) first_error.compare_exchange_strong(none, errno == 0 ? EIO : errno);
  return printed;
}

std::mutex& console_mutex() {
  static std::mutex mutex;
  return mutex;
}

int lost_output() {
  print_text(stdout, {});
  const int error_number = first_error;
  return error_number == EPIPE ? 0 : error_number;
}

std::string shell_word(const std::string& word) {
  constexpr std::string_view harmless = "%+,-./:=@_";
  const bool plain = !word.empty() && std::all_of(word.begin(), word.end(), [&](unsigned char c) {
    return std::isalnum(c) != 0 || harmless.find(static_cast<char>(c)) != std::string_view::npos;
  });
  if (plain) return word;
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

std::string shell_file(const std::string& file) { return shell_word(file.starts_with('-') ? "./" + file : file); }

}  // namespace drape
