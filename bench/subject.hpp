#pragma once

#include <functional>
#include <string>

namespace drape {

/// Something that can do a case's work again and again from the same state.
struct Subject {
  std::function<void()> restore;
  std::function<int()> run;  ///< returns how many steps or iterations it did
};

/// Registers NAME/WHO with Google Benchmark: the CPU time of one step or iteration of a subject, which is made when the
/// first repetition runs. CPU time, because other processes disturb it less than the wall clock; nothing that is
/// measured has a second thread.
/// @param expected what run() must return; another number is an error of the benchmark
void register_subject(const std::string& name, const std::string& who, int expected, std::function<Subject()> make);

}  // namespace drape
