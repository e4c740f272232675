#pragma once

#include <deque>
#include <optional>

#include "drape/scene/document.hpp"
#include "drape/sim/cloth.hpp"
#include "scene/selection.hpp"
#include "scene/tables.hpp"

namespace drape {

/// Makes the seam that a [seam] table describes. The vertices of each side form an open path along the edges of its
/// cloth. Both are measured by their length in the rest shape, from 0 to 1. Each vertex of the side with more vertices
/// is tied to the point of the other side at the same share of the length. Side b runs in the direction that keeps the
/// ties shorter at the start, or the other with `reverse`.
/// @param value the table, for the places of problems
/// @param cloth all cloths, joined
/// @returns nothing if there were problems
std::optional<Seam> read_seam(const SeamTable& table, const TomlValue& value, const Cloth& cloth,
                              const std::deque<PlacedSelection>& meshes, Problems& problems);

}  // namespace drape
