#include "cli/terminal.hpp"

#include <spdlog/sinks/base_sink.h>
#include <spdlog/spdlog.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <charconv>
#include <cstdlib>
#include <memory>
#include <mutex>

#include "core/console.hpp"
#include "core/text.hpp"

namespace drape {
namespace {

std::string_view environment(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? std::string_view() : std::string_view(value);
}

/// Returns the smaller of COLUMNS and the terminal's width.
std::size_t width_of(int descriptor, bool is_terminal) {
  constexpr std::size_t usual_width = 80;  // for terminals of unknown width
  const std::string_view columns = environment("COLUMNS");
  std::size_t width = 0;
  const auto read = std::from_chars(columns.data(), columns.data() + columns.size(), width);
  if (read.ec != std::errc() || width == 0) width = unlimited_width;
  winsize size{};
  if (is_terminal && ::ioctl(descriptor, TIOCGWINSZ, &size) == 0 && size.ws_col > 0) {
    return std::min<std::size_t>(width, size.ws_col);
  }
  return is_terminal && width == unlimited_width ? usual_width : width;
}

/// True while standard error ends in a line that will be erased.
std::atomic<bool> passing_line_shown = false;

/// Log sink for standard error: each message starts a line and is wrapped to the width.
class TerminalSink : public spdlog::sinks::base_sink<std::mutex> {
 public:
  explicit TerminalSink(const Terminal& where) : where_(where) {}

 protected:
  void sink_it_(const spdlog::details::log_msg& message) override {
    constexpr std::string_view prefix = "drape:";
    const std::string_view payload(message.payload.data(), message.payload.size());
    const std::string text = wrapped(std::string(prefix) + " " + escape_controls(payload), where_.width, 2);
    std::string head(prefix);
    if (message.level >= spdlog::level::err) head = inked(prefix, Ink::red, where_);
    if (message.level == spdlog::level::warn) head = inked(prefix, Ink::yellow, where_);
    const std::string cleared = passing_line_shown.exchange(false) ? "\r\x1b[K" : "";
    print_unescaped(stderr, cleared + head + text.substr(prefix.size()) + "\n");
  }
  void flush_() override {}

 private:
  Terminal where_;
};

}  // namespace

Terminal terminal(std::FILE* stream, ColorMode mode) {
  const int descriptor = ::fileno(stream);
  const bool is_terminal = ::isatty(descriptor) != 0;
  const bool wanted = is_terminal && environment("NO_COLOR").empty() && environment("TERM") != "dumb";
  return {.width = width_of(descriptor, is_terminal),
          .color = mode == ColorMode::always || (mode == ColorMode::automatic && wanted)};
}

std::string inked(std::string_view text, Ink ink, const Terminal& where) {
  static constexpr std::array<std::string_view, 4> codes{"31", "33", "32", "1"};  // in the enumeration's order
  if (!where.color) return std::string(text);
  return std::string("\x1b[")
      .append(codes.at(static_cast<std::size_t>(ink)))
      .append("m")
      .append(text)
      .append("\x1b[0m");
}

void print_wrapped(std::FILE* stream, std::string_view lines) {
  print_unescaped(stream, wrapped(escape_controls(lines), terminal(stream, ColorMode::never).width, 2));
}

void show_transient_line(std::string_view line) {
  passing_line_shown = true;
  print_unescaped(stderr, "\r\x1b[K" + escape_controls(line));
}

void clear_passing_line() {
  if (passing_line_shown.exchange(false)) print_unescaped(stderr, "\r\x1b[K");
}

void log_to_terminal(ColorMode mode) {
  auto sink = std::make_shared<TerminalSink>(terminal(stderr, mode));
  spdlog::set_default_logger(std::make_shared<spdlog::logger>("drape", std::move(sink)));
}

}  // namespace drape
