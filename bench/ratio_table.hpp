#pragma once

#include <benchmark/benchmark.h>

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace drape {

/// Cases that are each measured by the same two, in the order of the rows.
struct RatioTable {
  std::string first, second;
  std::vector<std::string> cases;  ///< those that were not measured are left out
};

/// Prints tables in Markdown: for each case the medians over the repetitions of both, and their ratio. Reads benchmarks
/// named "CASE/FIRST" and "CASE/SECOND" whose unit is the microsecond.
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
  std::map<std::string, std::map<std::string, Samples>> samples_;  ///< of a case, by who ran it
};

}  // namespace drape
