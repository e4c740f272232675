#include "sim/timed_effects.hpp"

#include <chrono>
#include <utility>

#include "sim/dashpots.hpp"

namespace drape {
namespace {

/// Timer that adds its lifetime to a number of seconds.
class Stopwatch {
 public:
  explicit Stopwatch(double& seconds) : seconds_(seconds) {}
  ~Stopwatch() { seconds_ += std::chrono::duration<double>(Clock::now() - begin_).count(); }
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;

 private:
  using Clock = std::chrono::steady_clock;
  double& seconds_;
  Clock::time_point begin_ = Clock::now();
};

template <class Base>
struct Timed : Base {
  std::shared_ptr<Base> inner;
  double& seconds;
  Timed(std::shared_ptr<Base> i, double& s) : inner(std::move(i)), seconds(s) {}
};

struct TimedForce final : Timed<Force> {
  using Timed::Timed;
  [[nodiscard]] bool constant() const override { return inner->constant(); }
  [[nodiscard]] bool velocity_forces() const override { return inner->velocity_forces(); }
  [[nodiscard]] bool of_contact() const override { return inner->of_contact(); }
  void add(const State& state, double time, Vertices& force) const override {
    const Stopwatch watch(seconds);
    inner->add(state, time, force);
  }
  [[nodiscard]] double stiffness_bound() const override { return inner->stiffness_bound(); }
};

struct TimedHessian final : Timed<EnergyHessian> {
  using Timed::Timed;
  void linearise(const Vertices& x, double time, double concavity) override {
    const Stopwatch watch(seconds);
    inner->linearise(x, time, concavity);
  }
  void add_product(const Vertices& vector, Vertices& product) const override {
    const Stopwatch watch(seconds);
    inner->add_product(vector, product);
  }
  void add_blocks(HessianBlocks& blocks) const override {
    const Stopwatch watch(seconds);
    inner->add_blocks(blocks);
  }
};

struct TimedEnergy final : Timed<Energy> {
  TimedEnergy(std::shared_ptr<Energy> timed, double& total) : Timed(std::move(timed), total) { piece = inner->piece; }
  double add_gradient(const Vertices& x, double time, Vertices& gradient) const override {
    const Stopwatch watch(seconds);
    return inner->add_gradient(x, time, gradient);
  }
  void add_bound(StiffnessBound& bound) const override { inner->add_bound(bound); }
  [[nodiscard]] std::unique_ptr<EnergyHessian> make_hessian() const override {
    return std::make_unique<TimedHessian>(inner->make_hessian(), seconds);
  }
  [[nodiscard]] bool stored() const override { return inner->stored(); }
};

struct TimedDashpots final : Timed<Dashpots> {
  using Timed::Timed;
  void set_directions(const Vertices& x) override {
    const Stopwatch watch(seconds);
    inner->set_directions(x);
  }
  void add_product(const Vertices& v, Vertices& product) const override {
    const Stopwatch watch(seconds);
    inner->add_product(v, product);
  }
  void add_blocks(double factor, HessianBlocks& blocks) const override {
    const Stopwatch watch(seconds);
    inner->add_blocks(factor, blocks);
  }
  void add_bound(double factor, StiffnessBound& bound) const override { inner->add_bound(factor, bound); }
};

struct TimedCorrection final : Timed<Correction> {
  using Timed::Timed;
  void apply(State& state, double h) const override {
    const Stopwatch watch(seconds);
    inner->apply(state, h);
  }
};

struct TimedFilter final : Timed<MotionFilter> {
  using Timed::Timed;
  void begin(const State& state, double time) override {
    const Stopwatch watch(seconds);
    inner->begin(state, time);
  }
  void apply(const Vertices& x, double time, double h, Vertices& v) override {
    const Stopwatch watch(seconds);
    inner->apply(x, time, h, v);
  }
  bool adjust(const Vertices& x, double time, double h, Vertices& v) override {
    const Stopwatch watch(seconds);
    return inner->adjust(x, time, h, v);
  }
  void finish(Vertices& v) override {
    const Stopwatch watch(seconds);
    inner->finish(v);
  }
  [[nodiscard]] const Restraint* restraint() const override { return inner->restraint(); }
  [[nodiscard]] bool done() const override { return inner->done(); }
};

struct TimedContacts final : Timed<ContactSource> {
  using Timed::Timed;
  void begin(const Vertices& x, double start, double end) override {
    const Stopwatch watch(seconds);
    inner->begin(x, start, end);
  }
  void find(const Vertices& target, int source, const std::vector<ContactConstraint>& held,
            std::vector<ContactConstraint>& contacts) override {
    const Stopwatch watch(seconds);
    inner->find(target, source, held, contacts);
  }
};

template <class TimedKind, class List>
void wrap(List& list, std::size_t from, double& seconds) {
  for (std::size_t i = from; i < list.size(); ++i) list[i] = std::make_unique<TimedKind>(std::move(list[i]), seconds);
}

}  // namespace

void time_additions(System& system, const SystemSizes& before, double& seconds) {
  wrap<TimedForce>(system.forces, before.forces, seconds);
  wrap<TimedForce>(system.fields, before.fields, seconds);
  wrap<TimedEnergy>(system.energies, before.energies, seconds);
  wrap<TimedDashpots>(system.dashpots, before.dashpots, seconds);
  wrap<TimedCorrection>(system.corrections, before.corrections, seconds);
  wrap<TimedFilter>(system.filters, before.filters, seconds);
  wrap<TimedContacts>(system.contacts, before.contacts, seconds);
}

}  // namespace drape
