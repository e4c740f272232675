#pragma once

#include <benchmark/benchmark.h>

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace drape {

/// Prints one Markdown row for each case that was measured by drape and by the textbook: the medians over the
/// repetitions and their ratio. Reads benchmarks named "CASE/drape" and "CASE/textbook" whose unit is the microsecond.
class RatioTable final : public benchmark::BenchmarkReporter {
 public:
  /// @param cases in the order of the rows; those that were not measured are left out
  explicit RatioTable(std::vector<std::string> cases) : cases_(std::move(cases)) {}

  bool ReportContext(const Context& context) override;
  void ReportRuns(const std::vector<Run>& runs) override;
  void Finalize() override;

 private:
  using Samples = std::vector<double>;  ///< [µs]
  std::vector<std::string> cases_;
  std::map<std::string, std::map<std::string, Samples>> samples_;  ///< of a case, by who ran it
};

}  // namespace drape
