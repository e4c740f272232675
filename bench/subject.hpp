#pragma once

#include <functional>
#include <string>

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

}  // namespace drape
