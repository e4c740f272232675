#include "sim/schemes/sdirk2_guard.hpp"

namespace drape {

Sdirk2Guard::Sdirk2Guard(const System& system) : condition_(system) {
  constexpr int interval = 16;  // a check costs about as much as an iteration
  const bool forces_only = system.pin_motions.empty() && system.filters.empty() && system.contacts.empty();
  if (forces_only) watch_.emplace(system, limit, interval);
}

void Sdirk2Guard::begin(const State& state, const EnergyNow& energy) {
  if (watch_) watch_->begin(state, energy());
}

std::optional<double> Sdirk2Guard::look(const State& state, const Vertices& push, bool constant,
                                        const EnergyNow& energy) {
  return watch_ ? watch_->look(state, push, constant, energy) : std::nullopt;
}

std::optional<BlowUpWatch::EnergyHistory> Sdirk2Guard::books() const {
  return watch_ ? std::optional(watch_->books()) : std::nullopt;
}

void Sdirk2Guard::go_on(const BlowUpWatch::EnergyHistory& books) {
  if (watch_) watch_->go_on(books);
}

std::string Sdirk2Guard::remedy() const {
  return "; sdirk2 can gain energy where steps are solved loosely or the cloth is crumpled: use a smaller tolerance "
         "and more max_iterations, a shorter [time] step, or scheme = \"backward-euler\", which cannot";
}

}  // namespace drape
