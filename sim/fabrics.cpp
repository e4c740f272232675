#include "sim/fabrics.hpp"

namespace drape {

std::span<const Fabric> fabrics() {
  static constexpr Fabric all[] = {
      {"denim", "11oz Black Denim", 0.324, 913, 77.0e-6},       {"dots", "White Dots on Black", 0.128, 4030, 41.1e-6},
      {"interlock", "Gray Interlock", 0.187, 47.8, 21.7e-6},    {"jet-set", "Tango Red Jet Set", 0.113, 172, 19.6e-6},
      {"ponte-roma", "Camel Ponte Roma", 0.284, 74.1, 34.9e-6}, {"rib-knit", "Ivory Rib Knit", 0.276, 106, 34.6e-6},
      {"ribbon", "Pink Ribbon Brown", 0.228, 385, 88.0e-6},     {"sweat", "Navy Sparkle Sweat", 0.224, 12.8, 46.3e-6},
      {"swim", "White Swim Solid", 0.204, 142, 57.2e-6},        {"target", "Royal Target", 0.220, 4050, 116.7e-6},
  };
  return all;
}

}  // namespace drape
