#include "sim/fabrics.hpp"

namespace drape {

std::span<const Fabric> fabrics() {
  static constexpr Fabric all[] = {
      {"canvas", "cotton duck, 10 oz", 0.340, 9800, 150e-6, false},
      {"cotton", "shirting, plain weave", 0.120, 4900, 7e-6, false},
      {"denim", "11oz Black Denim", 0.324, 913, 77.0e-6},
      {"dots", "White Dots on Black", 0.128, 4030, 41.1e-6},
      {"interlock", "Gray Interlock", 0.187, 47.8, 21.7e-6},
      {"jet-set", "Tango Red Jet Set", 0.113, 172, 19.6e-6},
      {"paper", "printing paper, 0.11 mm", 0.080, 319000, 353e-6, false},
      {"ponte-roma", "Camel Ponte Roma", 0.284, 74.1, 34.9e-6},
      {"rib-knit", "Ivory Rib Knit", 0.276, 106, 34.6e-6},
      {"ribbon", "Pink Ribbon Brown", 0.228, 385, 88.0e-6},
      {"silk", "habotai, plain weave", 0.055, 3300, 2.5e-6, false},
      {"sweat", "Navy Sparkle Sweat", 0.224, 12.8, 46.3e-6},
      {"swim", "White Swim Solid", 0.204, 142, 57.2e-6},
      {"target", "Royal Target", 0.220, 4050, 116.7e-6},
      {"wool", "suiting, plain weave", 0.230, 2500, 10e-6, false},
  };
  return all;
}

}  // namespace drape
