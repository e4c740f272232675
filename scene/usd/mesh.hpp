#pragma once

#include "scene/mesh/source.hpp"
#include "sim/mesh.hpp"

namespace drape {

/// The mesh of an ASCII USD file, as Blender and others export it: its only Mesh prim, placed by its transform at the
/// file's startTimeCode, in metres with z up. A left-handed mesh, and one that its transform mirrors, is turned so that
/// its triangles are counterclockwise seen from the front. Of points that move the first sample is taken. Texture
/// coordinates come from primvars:st, else primvars:UVMap, else the first primvar of a texCoord2 type. A file that does
/// not say its unit or its up axis is in centimetres with y up, as USD has it.
/// @throws UsageError "file:line:column: message", also where there is more than one Mesh, or one that is not part of
///         the scene: below an `over` or a `class`, or in a variant set
Mesh read_usd_mesh(const SourceText& source);

}  // namespace drape
