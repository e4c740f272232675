#include "cli/terminal.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spdlog/sinks/base_sink.h>
#include <spdlog/spdlog.h>
#include <sys/ioctl.h>
#include <unistd.h>
#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <future>
#include <memory>
#include <mutex>
#include <string>
#include <system_error>
#include <thread>
#include <utility>

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

namespace {

constexpr int bar_width = 24;
constexpr std::chrono::seconds line_interval{5};  // initial interval
constexpr int lines_in_all = 10;                  // later: elapsed time divided by this number

std::string minutes(double seconds) {
  const auto whole = std::lround(std::min(seconds, 359999.0));
  return whole < 3600 ? fmt::format("{}:{:02}", whole / 60, whole % 60)
                      : fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
}

}  // namespace

ProgressDisplay::Style ProgressDisplay::fitting_style(bool quiet) {
  if (quiet) return Style::none;
  return isatty(STDERR_FILENO) != 0 ? Style::bar : Style::lines;
}

void ProgressDisplay::update() {
  const std::int64_t total = progress_.total, done = std::min<std::int64_t>(progress_.done, total);
  const char* stage = progress_.stage;
  if (style_ == Style::none || total <= 0) return;
  const auto now = Clock::now();
  if (stage != stage_) {
    stage_ = stage;
    stage_begin_ = now;
    done_before_ = done;
  }
  const auto interval = std::max<Clock::duration>(line_interval, (now - begin_) / lines_in_all);
  if (style_ == Style::lines && now - last_line_ < interval) return;

  const double seconds = std::chrono::duration<double>(now - stage_begin_).count();
  const double rate = seconds > 0 ? static_cast<double>(done - done_before_) / seconds : 0;
  std::string text = fmt::format("{} {}/{} {}", stage, done, total, progress_.unit.load());
  if (rate > 0) {
    text +=
        fmt::format("  {:.{}f}/s  {} left", rate, rate < 10 ? 1 : 0, minutes(static_cast<double>(total - done) / rate));
  }
  if (style_ == Style::lines) {
    last_line_ = now;
    print_unescaped(stderr, text + "\n");
    return;
  }
  const std::size_t width = terminal(stderr, ColorMode::never).width;
  const auto filled = static_cast<std::size_t>(bar_width * done / total);
  std::string line = fmt::format("[{}{}] {}", std::string(filled, '#'), std::string(bar_width - filled, ' '), text);
  if (line.size() >= width) line.resize(width - 1);  // a wrapped line could not be erased
  show_transient_line(line);
}

void ProgressDisplay::clear() {
  if (style_ == Style::bar) clear_passing_line();
}

namespace {

std::array<int, 2> signals{-1, -1};  // pipe from the signal handler to listen()

void handle(int) {
  const int before = errno;
  const char byte = 0;
  [[maybe_unused]] const ssize_t written = write(signals[1], &byte, 1);  // a full pipe has already woken the reader
  errno = before;
}

/// Waits for the first signal and requests a stop. If the pipe fails, the first signal is lost; the second one ends the
/// process by default.
void listen(std::stop_source source) {
  char byte = 0;
  ssize_t count = 0;
  do {
    count = read(signals[0], &byte, 1);
  } while (count < 0 && errno == EINTR);
  if (count == 1) source.request_stop();
}

std::stop_source install() {
  std::stop_source source;
  if (pipe2(signals.data(), O_CLOEXEC | O_NONBLOCK) != 0 || fcntl(signals[0], F_SETFL, 0) != 0) {
    throw std::system_error(errno, std::generic_category(), "cannot listen for signals");
  }
  std::thread(listen, source).detach();  // runs until the process ends
  struct sigaction action {};
  action.sa_handler = handle;
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction inherited {};
    sigaction(number, nullptr, &inherited);
    if (inherited.sa_handler != SIG_IGN) sigaction(number, &action, nullptr);  // nohup ignores SIGHUP
  }
  return source;
}

}  // namespace

std::stop_source& interruption() {
  static std::stop_source source = install();
  return source;
}

namespace {

constexpr std::chrono::milliseconds display_interval{100};

}  // namespace

BackgroundWork::BackgroundWork(const Work& work) {
  done_ = std::async(std::launch::async, [this, work] { work(interruption().get_token(), progress_); });
}

void BackgroundWork::watch_to_its_end(bool quiet) {
  ProgressDisplay display(progress_, ProgressDisplay::fitting_style(quiet));
  while (done_.wait_for(display_interval) != std::future_status::ready) display.update();
  display.clear();
  done_.get();
}

bool run_watched(bool quiet, const BackgroundWork::Work& work) {
  BackgroundWork(work).watch_to_its_end(quiet);
  return interruption().get_token().stop_requested();
}

}  // namespace drape
