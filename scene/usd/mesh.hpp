#pragma once

#include <memory>
#include <string>
#include <vector>

#include "scene/mesh/source.hpp"
#include "scene/usd/stage.hpp"
#include "sim/mesh.hpp"
#include "sim/mesh_motion.hpp"

namespace drape {

/// The Mesh prim that a name means: that of the path "/World/cloth", or the only one below it; of an empty name the
/// only one of the scene or, where the scene has none, the only one in the file: under an `over` or a `class`, or in a
/// variant that nothing selects.
/// @throws UsageError otherwise, with the names and sizes of those that there are
UsdPath choose_usd_mesh(const UsdStage& stage, const std::string& prim);

/// A Mesh prim of an ASCII USD file, as Blender and others export it, placed by its transform at the file's
/// startTimeCode, in metres with z up. A left-handed mesh, and one that its transform mirrors, is turned so that its
/// triangles are counterclockwise seen from the front. Of points that move the first sample is taken, and a skeleton
/// does not move them. Texture coordinates come from primvars:st, else primvars:UVMap, else the first primvar of a
/// texCoord2 type. A file that does not say its unit or its up axis is in centimetres with y up, as USD has it.
/// @param prim see choose_usd_mesh()
/// @throws UsageError "file:line:column: message"
Mesh read_usd_mesh(const UsdStage& stage, const std::string& prim = {});
Mesh read_usd_mesh(const SourceText& source, const std::string& prim = {});

/// The points of the same mesh at which a primvar is not 0, ascending.
/// @param stage   read with this primvar, see UsdReading
/// @param primvar without "primvars:": one number for each point
/// @throws UsageError if the mesh has no such primvar, or it is of another shape
std::vector<int> read_usd_primvar(const UsdStage& stage, const std::string& prim, const std::string& primvar);

/// The same mesh as it moves: by its transform and those of its ancestors, by samples of its points, or by its
/// skeleton (see UsdSkin). Its samples are at every time at which one of these has one, and where something may turn
/// also at every time code in between: MeshMotion takes straight lines between them. The time of a sample is
/// (time code − startTimeCode)/timeCodesPerSecond [s].
/// @param stage read with all of its samples, see UsdReading
/// @throws UsageError also if the number of points changes
MeshMotion read_usd_mesh_motion(const UsdStage& stage, const std::string& prim = {});
MeshMotion read_usd_mesh_motion(const SourceText& source, const std::string& prim = {});

/// The same motion, of which one sample at a time is in memory if the stage was read with located points.
class UsdMovingMesh {
 public:
  /// @param stage outlives it @throws UsageError as read_usd_mesh_motion(), but for what is wrong with later samples
  explicit UsdMovingMesh(const UsdStage& stage, const std::string& prim = {});
  ~UsdMovingMesh();

  /// At the first sample.
  [[nodiscard]] const Mesh& mesh() const;
  /// The times of the samples [s], increasing; of a mesh that rests there are none.
  [[nodiscard]] const std::vector<double>& times() const;
  /// The points at the i-th of the times, in the world [m].
  /// @throws UsageError if their number is not the first sample's, or one is not finite
  [[nodiscard]] Vertices points(std::size_t i) const;
  /// All of it at once. @throws UsageError also if it takes more than a gigabyte
  [[nodiscard]] MeshMotion read() const;

 private:
  class Reader;
  std::unique_ptr<Reader> reader_;
};

}  // namespace drape
