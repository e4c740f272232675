#pragma once

#include <benchmark/benchmark.h>

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace drape {

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
