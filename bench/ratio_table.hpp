#pragma once

#include <benchmark/benchmark.h>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace drape {

/// A repeatable piece of work that always starts from the same state.
struct Subject {
  std::function<void()> restore;
  std::function<int()> run;  ///< returns the number of steps or iterations done
};

/// Registers NAME/WHO with Google Benchmark: the CPU time of one step or iteration of a subject, which is made at the
/// first repetition. Other processes disturb CPU time less than wall time, and all measured code has one thread.
/// @param expected required result of run(); another number is an error of the benchmark
void register_subject(const std::string& name, const std::string& who, int expected, std::function<Subject()> make);

/// A table of cases measured for the same two subjects, in the order of the rows.
struct RatioTable {
  std::string first, second;
  std::vector<std::string> cases;  ///< unmeasured ones are left out
};

/// Prints Markdown tables: for each case the medians over the repetitions of both subjects, and their ratio. Reads
/// benchmarks named "CASE/FIRST" and "CASE/SECOND" in microseconds.
class RatioReporter final : public benchmark::BenchmarkReporter {
 public:
  explicit RatioReporter(std::vector<RatioTable> tables) : tables_(std::move(tables)) {}

  bool ReportContext(const Context& context) override;
  void ReportRuns(const std::vector<Run>& runs) override;
  void Finalize() override;

 private:
  using Samples = std::vector<double>;  ///< [µs]
  void print(const RatioTable& table);

  std::vector<RatioTable> tables_;
  std::map<std::string, std::map<std::string, Samples>> samples_;  ///< by case and subject
};

}  // namespace drape
