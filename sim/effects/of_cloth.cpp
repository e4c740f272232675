#include "sim/effects/of_cloth.hpp"

#include <fmt/format.h>

#include "core/keys.hpp"
#include "core/text.hpp"

namespace drape {

void describe_cloth(Keys& keys, std::string& name) {
  keys.add("cloth", ClothName{&name}, "", "The name of the only cloth that it acts on. Default: all.");
}

void check_cloth(const std::string& name, const SimulationSettings& settings, const ProblemSink& problem) {
  if (name.empty() || find_piece(settings.cloth, name) != nullptr) return;
  std::vector<std::string> names;
  for (const ClothPiece& piece : settings.cloth.pieces) names.push_back(piece.name);
  problem("cloth", names.empty()
                       ? fmt::format("no cloth has a name, found '{}'", name)
                       : fmt::format("unknown cloth '{}'{}", name, did_you_mean(name, names, "the cloths are")));
}

void for_cloths(const Cloth& cloth, const std::string& name, const std::function<void(const Cloth&, int)>& use) {
  if (cloth.pieces.size() < 2) return use(cloth, -1);
  for (std::size_t k = 0; k < cloth.pieces.size(); ++k) {
    const ClothPiece& piece = cloth.pieces[k];
    if (name.empty() || piece.name == name) use(only_piece(cloth, piece), static_cast<int>(k));
  }
}

}  // namespace drape
