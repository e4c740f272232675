#include "sim/effects/bending.hpp"

#include <optional>

#include "sim/bending/bending_energy.hpp"
#include "sim/bending/hinges.hpp"

namespace drape {
namespace {

class Bending final : public Effect {
 public:
  void describe(Keys& keys) override {
    keys.add("rigidity", &rigidity_, "N·m",
             "Bending rigidity D of the cloth: rolled to the radius R, an area A holds ½·D·A/R².")
        .above(0);
    keys.add(
            "cross_stiffness", &cross_stiffness_, "N/m",
            "Of \"cross\" springs between the vertices opposite to each inner edge, as long as they are apart at rest.")
        .above(0);
  }

  void check(const SimulationSettings&, const ProblemSink& problem) const override {
    if (!rigidity_ && !cross_stiffness_) {
      problem("", "expected 'rigidity', 'cross_stiffness', or both; without one of them nothing resists bending");
    }
  }

  void install(System& system) const override {
    if (cross_stiffness_) {
      const std::vector<Spring> springs = cross_springs(system.cloth, *cross_stiffness_);
      system.springs.insert(system.springs.end(), springs.begin(), springs.end());
    }
    if (rigidity_) {
      const auto elements = curvature_elements(system.cloth, *rigidity_);
      if (!elements.empty())
        system.coupled_energies.push_back(std::make_unique<BendingEnergy>(elements, system.cloth.vertex_count()));
    }
  }

 private:
  std::optional<double> rigidity_, cross_stiffness_;
};

}  // namespace

std::unique_ptr<Effect> make_bending() { return std::make_unique<Bending>(); }

}  // namespace drape
