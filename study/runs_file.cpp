#include "study/runs_file.hpp"

#include <fmt/format.h>
#include <algorithm>

#include "core/console.hpp"
#include "core/text.hpp"
#include "reports/result_table.hpp"

namespace drape {
namespace {

std::string arguments(const StudyCase& study_case) {
  std::string text = shell_file(study_case.scene);
  for (const std::string& value : study_case.overrides) text += " --set " + shell_word(value);
  return text + fmt::format(" --steps {}", study_case.steps);
}

}  // namespace

Scene StudyCase::load() const { return load_scene((folder.empty() ? data_folder() : folder) / scene, overrides); }

std::string StudyCase::command() const { return "drape simulate " + arguments(*this); }

std::string StudyCase::film_command(const std::string& film) const {
  return "drape render " + arguments(*this) + " -o " + shell_word(film);
}

std::string plain_number(double value) { return fmt::format("{}", value); }

namespace {

const std::vector<std::string> heading{"scene", "kind", "method", "scheme", "setting", "run", "quantity", "value"};
constexpr const char* last_kind = "end";

[[noreturn]] void fail_at(const std::string& file, std::size_t line, const std::string& sentence) {
  throw UsageError(fmt::format("{}:{}: {}", file, line, sentence));
}

struct CsvRow {
  std::vector<std::string> cells;
  std::size_t line = 0;  // first line of the row
};

/// Reader of RFC 4180 rows: quoted cells may contain commas, line ends, and doubled quotes.
class CsvRows {
 public:
  CsvRows(const std::string& text, std::string file) : text_(text), file_(std::move(file)) {}

  std::optional<CsvRow> next() {
    if (at_ == text_.size()) return std::nullopt;
    CsvRow row;
    row.line = line_;
    do {
      row.cells.push_back(csv_text(cell()));
    } while (take(','));
    take('\r');
    if (!take('\n')) {
      fail_at(file_, line_,
              at_ == text_.size() ? "the file is cut: it ends within a line" : "a cell goes on after its quotes");
    }
    ++line_;
    return row;
  }

 private:
  bool take(char c) {
    const bool there = at_ < text_.size() && text_[at_] == c;
    at_ += there ? 1 : 0;
    return there;
  }

  std::string cell() {
    if (!take('"')) {
      const std::size_t end = std::min(text_.find_first_of(",\r\n", at_), text_.size());
      const std::size_t begin = std::exchange(at_, end);
      return text_.substr(begin, end - begin);
    }
    std::string value;
    for (const std::size_t begin = line_; at_ < text_.size();) {
      const char c = text_[at_++];
      if (c == '"' && !take('"')) return value;
      line_ += c == '\n' ? 1 : 0;
      value += c;
      if (at_ == text_.size()) fail_at(file_, begin, "the file is cut: the quotes that begin here do not end");
    }
    fail_at(file_, line_, "the file is cut: the quotes that begin here do not end");
  }

  const std::string& text_;
  std::string file_;
  std::size_t at_ = 0, line_ = 1;
};

}  // namespace

RunsWriter::RunsWriter() : text_(csv_line(heading)) {}

void RunsWriter::put(const char* quantity, const std::string& run, const std::string& value) {
  text_ += csv_line({key_.scene, key_.kind, key_.method, key_.scheme, key_.setting, run, quantity, value});
  ++rows_;
}

std::string RunsWriter::finish() {
  begin({{}, last_kind, {}, {}, {}});
  put("rows", {}, std::to_string(rows_));
  return std::move(text_);
}

void RunsRecord::fail(std::size_t line, const std::string& sentence) const { fail_at(file_, line, sentence); }

void RunsRecord::expect_number(const RunsCell& cell) const {
  fail(cell.line, fmt::format("expected a number, found '{}'", cell.value));
}

RunsCell RunsRecord::one(const char* quantity) {
  asked_.emplace_back(quantity);
  const auto found = cells_.find(quantity);
  if (found == cells_.end()) {
    const std::string about =
        key.method.empty() ? key.kind : fmt::format("{} {} {}", key.kind, key.method, key.setting);
    fail(line_, fmt::format("'{}' is missing of what begins here: {}", quantity, about));
  }
  if (found->second.size() != 1) {
    fail(found->second[1].line,
         fmt::format("'{}' is there a second time: first in line {}", quantity, found->second[0].line));
  }
  return found->second.front();
}

std::vector<RunsCell> RunsRecord::several(const char* quantity) {
  asked_.emplace_back(quantity);
  std::vector<RunsCell> cells = cells_[quantity];
  const auto number = [this](const RunsCell& cell) {
    std::size_t run = 0;
    read({cell.run, cell.run, cell.line}, run);
    return run;
  };
  std::ranges::stable_sort(cells, {}, number);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (number(cells[i]) == i + 1) continue;
    fail(cells[i].line, fmt::format("expected number {} of '{}', found {}", i + 1, quantity, cells[i].run));
  }
  return cells;
}

void RunsRecord::done() const {
  for (const auto& [quantity, cells] : cells_) {
    if (cells.empty() || std::ranges::find(asked_, quantity) != asked_.end()) continue;
    fail(cells.front().line,
         fmt::format("unknown quantity '{}'{}", quantity, did_you_mean(quantity, asked_, "the quantities are")));
  }
}

std::vector<RunsRecord> parse_runs(const std::string& text, const std::string& file) {
  CsvRows rows(text, file);
  const std::optional<CsvRow> first = text.starts_with(heading.front()) ? rows.next() : std::nullopt;
  if (!first || first->cells != heading) {
    const std::string line = csv_line(heading);
    fail_at(file, 1, fmt::format("expected the runs of a study, which begin with {}", line.substr(0, line.size() - 1)));
  }
  std::vector<RunsRecord> records;
  std::optional<std::string> announced;
  std::int64_t count = 0;
  std::size_t last = 1;
  while (const std::optional<CsvRow> row = rows.next()) {
    const std::vector<std::string>& cells = row->cells;
    last = row->line;
    if (cells.size() != heading.size()) {
      fail_at(file, last, fmt::format("expected {} cells, found {}", heading.size(), cells.size()));
    }
    if (announced) fail_at(file, last, "there are rows after the last, of kind 'end'");
    const RunsKey key{cells[0], cells[1], cells[2], cells[3], cells[4]};
    if (key.kind == last_kind) {
      announced = cells[7];
      continue;
    }
    ++count;
    // Rows of one subject are usually adjacent.
    auto found = std::find_if(records.rbegin(), records.rend(), [&](const RunsRecord& r) { return r.key == key; });
    if (found == records.rend()) {
      records.emplace_back(file, key, last);
      found = records.rbegin();
    }
    found->add(cells[6], {cells[5], cells[7], last});
  }
  if (!announced) fail_at(file, last, "the file is cut: it ends without its last row, of kind 'end'");
  if (*announced != std::to_string(count)) {
    fail_at(file, last, fmt::format("expected {} rows before this, as it says, found {}", *announced, count));
  }
  return records;
}

}  // namespace drape
