#include "sim/system.hpp"

#include <algorithm>

#include "sim/parallel/vectors.hpp"

namespace drape {
namespace {

constexpr int most_turns = 4;  // of filters that undo each other's changes

}  // namespace

StiffnessBound System::stiffness_bound() const {
  StiffnessBound bound{.springs = springs, .vertices = Eigen::VectorXd::Zero(cloth.vertex_count())};
  for (const auto& energy : energies) energy->add_bound(bound);
  return bound;
}

std::vector<Collider> System::colliders_at(double at) const {
  std::vector<Collider> shapes;
  for (const auto& motion : colliders) shapes.push_back(motion->at(at));
  return shapes;
}

bool System::only_loses_energy() const {
  const bool rests = std::ranges::all_of(colliders, [](const auto& collider) { return collider->rests(); });
  if (!rests || !pin_motions.empty() || !fields.empty()) return false;
  const State at_rest{.x = cloth.positions, .v = Vertices::Zero(cloth.vertex_count(), 3), .step = 0};
  Vertices push = at_rest.v;
  for (const auto& force : forces) {
    if (force->of_contact()) continue;
    if (!force->constant()) return false;
    force->add(at_rest, 0, push);
  }
  return push.isApprox(cloth.masses * gravity.transpose());
}

void System::filter(State& state, Vertices& way) const {
  for (const auto& filter : filters) {
    filter->apply(state.x, time(state.step), step, way);
  }
  bool changed = filters.size() > 1;
  for (int turn = 0; changed && turn < most_turns; ++turn) {
    changed = false;
    for (const auto& filter : filters) changed = filter->adjust(state.x, time(state.step), step, way) || changed;
  }
  for (const auto& filter : filters) {
    filter->note(!changed);
    if (const Restraint* restraint = filter->restraint()) state.restraint = *restraint;
  }
}

void System::move(State& state, const Vertices* reached) const {
  if (filters.empty() && reached != nullptr) {
    copy(threads, *reached, state.x);
    return;
  }
  filter(state, state.v);
  add_multiple(threads, step, state.v, state.x);
  place_pins(time(state.step + 1), state.x);
  for (const auto& filter : filters) filter->finish(state.v);
}

void System::move(State& state, const Vertices& reached, Vertices& way) const {
  if (filters.empty()) {
    state.x = reached;
    return;
  }
  way = (reached - state.x) / step;
  state.v -= way;
  filter(state, way);
  state.v += way;
  add_multiple(threads, step, way, state.x);
  place_pins(time(state.step + 1), state.x);
  for (const auto& filter : filters) filter->finish(state.v);
}

}  // namespace drape
