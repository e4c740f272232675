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

// Cases of the tables. Each function registers some, and returns their names.

/// Registers a motion of the homework computed to a given error, by schemes of second and of first order.
std::vector<std::string> register_time_schemes();

/// Registers the motion of scene 3's cloth by the default method and by XPBD, whose steps are as many as its error
/// needs, as CASE/drape and CASE/xpbd.
std::vector<std::string> register_peers();

/// Registers the rows that compare a quasi-Newton step with a textbook Newton step of equal accuracy, on the homework's
/// 20×20 cloth with k = 180 and h = 0.02 s, with and without the sphere.
std::vector<std::string> register_equal_accuracy();

/// Registers the factorisation of the homework cloth's matrix, from its springs to the factor: CASE/fronts, by nested
/// dissection and dense fronts, and CASE/cholmod, its simplicial factor.
std::vector<std::string> register_factoring();

/// Registers the same beside CHOLMOD's supernodal factor, "fronts" and "supernodal".
std::vector<std::string> register_supernodal_factoring();

/// Registers a step of liu13 with and without each effect of the registry that takes time, as CASE/with and
/// CASE/without.
std::vector<std::string> register_effect_costs();

/// Registers the drawing of a frame with the default look, and without shadows, ambient occlusion and translucency, as
/// CASE/with and CASE/without.
std::vector<std::string> register_drawing();

/// Registers the encoding of a film's frame as a GIF: CASE/drape, from the picture to the verified file, and
/// CASE/ffmpeg, palettegen and paletteuse in memory.
std::vector<std::string> register_encoding();

}  // namespace drape
