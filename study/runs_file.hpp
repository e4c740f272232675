#pragma once

#include <charconv>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "drape/core/error.hpp"
#include "drape/scene/scene.hpp"

namespace drape {

/// A scene with a few overrides and a number of steps: the unit of measurement of a study.
struct StudyCase {
  std::string label;                   ///< heading in tables and charts: "liu13, ε = 0.001"
  std::string scene;                   ///< a file, relative to `folder`: "scenes/homework/3.toml"
  std::vector<std::string> overrides;  ///< overrides as for --set
  std::int64_t steps = 0;
  std::int64_t watched_steps = 0;     ///< steps of the untimed run, if more than `steps`
  std::filesystem::path folder = {};  ///< empty: the data folder
  /// Computing time limit for `steps` [s]; absent: no limit, and a divergence is an error.
  std::optional<double> patience = {};

  /// @throws UsageError
  [[nodiscard]] Scene load() const;

  /// Returns the command that runs this case.
  [[nodiscard]] std::string command() const;
  /// Returns the command that makes a film of this case.
  /// @param film name of the film
  [[nodiscard]] std::string film_command(const std::string& film) const;
};

/// Formats a number for a command line: the shortest text that reads back exactly.
std::string plain_number(double value);

/// The subject of a row in a file of runs.
struct RunsKey {
  std::string scene, kind, method, scheme, setting;
  bool operator==(const RunsKey&) const = default;
};

/// Writer of a study's measurements as one table in long form, one value per row, RFC 4180:
///    scene,kind,method,scheme,setting,run,quantity,value
/// `run` numbers the values of a list from 1: runs, steps, times. Numbers are the shortest that read back exactly.
/// Absent values have no row. The last row has the number of rows before it.
class RunsWriter {
 public:
  RunsWriter();
  /// Sets the subject of the following values.
  void begin(RunsKey key) { key_ = std::move(key); }

  template <class T>
  void operator()(const char* quantity, const T& value) {
    put(quantity, {}, text(value));
  }
  template <class T>
  void operator()(const char* quantity, const std::optional<T>& value) {
    if (value) put(quantity, {}, text(*value));
  }
  template <class T>
  void operator()(const char* quantity, const std::vector<T>& values) {
    for (std::size_t i = 0; i < values.size(); ++i) put(quantity, std::to_string(i + 1), text(values[i]));
  }

  /// Returns the whole file.
  std::string finish();

 private:
  static const std::string& text(const std::string& value) { return value; }
  static std::string text(double value) { return plain_number(value); }
  static std::string text(std::int64_t value) { return std::to_string(value); }
  static std::string text(std::size_t value) { return std::to_string(value); }
  static std::string text(int value) { return std::to_string(value); }
  static std::string text(bool value) { return value ? "1" : "0"; }
  void put(const char* quantity, const std::string& run, const std::string& value);

  RunsKey key_;
  std::int64_t rows_ = 0;
  std::string text_;
};

/// A value in a file of runs, and its line.
struct RunsCell {
  std::string run, value;
  std::size_t line = 0;
};

/// The values of one subject in a file of runs. Each must be requested once, see done().
class RunsRecord {
 public:
  RunsRecord(std::string file, RunsKey key, std::size_t line)
      : key(std::move(key)), file_(std::move(file)), line_(line) {}

  template <class T>
  void operator()(const char* quantity, T& value) {
    read(one(quantity), value);
  }
  template <class T>
  void operator()(const char* quantity, std::optional<T>& value) {
    if (cells_.contains(quantity)) read(one(quantity), value.emplace());
  }
  template <class T>
  void operator()(const char* quantity, std::vector<T>& values) {
    for (const RunsCell& cell : several(quantity)) read(cell, values.emplace_back());
  }

  void add(const std::string& quantity, RunsCell cell) { cells_[quantity].push_back(std::move(cell)); }
  /// Checks that every value was requested. @throws UsageError otherwise
  void done() const;
  /// @throws UsageError "file:line: sentence"
  [[noreturn]] void fail(std::size_t line, const std::string& sentence) const;
  [[nodiscard]] std::size_t line() const { return line_; }

  const RunsKey key;

 private:
  RunsCell one(const char* quantity);
  /// Returns the values in order.
  std::vector<RunsCell> several(const char* quantity);
  static void read(const RunsCell& cell, std::string& value) { value = cell.value; }
  template <class T>
  void read(const RunsCell& cell, T& value) const {
    const char* const end = cell.value.data() + cell.value.size();
    std::from_chars_result result{};
    if constexpr (std::is_same_v<T, bool>) {
      int number = 0;
      result = std::from_chars(cell.value.data(), end, number);
      value = number != 0;
    } else {
      result = std::from_chars(cell.value.data(), end, value);
    }
    if (result.ec != std::errc() || result.ptr != end || cell.value.empty()) expect_number(cell);
  }
  [[noreturn]] void expect_number(const RunsCell& cell) const;

  std::string file_;
  std::size_t line_;
  std::map<std::string, std::vector<RunsCell>> cells_;
  std::vector<std::string> asked_;
};

/// Parses a file of runs into records, in the order of first appearance.
/// @param file name for messages
/// @throws UsageError "file:line: message" if it is of another kind or truncated
std::vector<RunsRecord> parse_runs(const std::string& text, const std::string& file);

}  // namespace drape
