#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "drape/sim/body_shape.hpp"
#include "drape/sim/mesh.hpp"
#include "scene/mesh/source.hpp"
#include "scene/usd/stage.hpp"

namespace drape {

/// Finds the Mesh prim of a name: the one at the path "/World/cloth", or the only one below it. An empty name means the
/// only Mesh of the scene. A scene without a Mesh may have one in the file under an `over`, a `class` or an unselected
/// variant.
/// @throws UsageError otherwise, with names and sizes of the meshes
UsdPath choose_usd_mesh(const UsdStage& stage, const std::string& prim);

/// Reads a Mesh prim of an ASCII USD file, as Blender and others export it: placed by its transform at the file's
/// startTimeCode, in metres with z up. Left-handed meshes and those mirrored by their transform are flipped, so that
/// triangles are counterclockwise seen from the front. Moving points use their first sample; skeletons are ignored.
/// Texture coordinates come from primvars:st, else primvars:UVMap, else the first primvar of a texCoord2 type. Missing
/// unit and up axis default to centimetres and y up, as in USD.
/// @param prim see choose_usd_mesh()
/// @throws UsageError "file:line:column: message"
Mesh read_usd_mesh(const UsdStage& stage, const std::string& prim = {});
Mesh read_usd_mesh(const SourceText& source, const std::string& prim = {});

/// Returns the points of the same mesh where a primvar is not 0, ascending.
/// @param stage   read with this primvar, see UsdReading
/// @param primvar without "primvars:": one number for each point
/// @throws UsageError if the mesh has no such primvar, or it has another shape
std::vector<int> read_usd_primvar(const UsdStage& stage, const std::string& prim, const std::string& primvar);

/// Reads the motion of the same mesh: by its transform and those of its ancestors, by samples of its points, or by its
/// skeleton (see UsdSkin). The times are those of all samples. Where something may rotate, every time code in between
/// is added, because MeshMotion interpolates linearly. The time of a sample is (time code −
/// startTimeCode)/timeCodesPerSecond [s].
/// @param stage read with all of its samples, see UsdReading
/// @throws UsageError also if the number of points changes
MeshMotion read_usd_mesh_motion(const UsdStage& stage, const std::string& prim = {});
MeshMotion read_usd_mesh_motion(const SourceText& source, const std::string& prim = {});

/// The same motion, one sample at a time in memory if the stage was read with located points.
class UsdMovingMesh {
 public:
  /// @param stage must outlive this @throws UsageError as read_usd_mesh_motion(), except for errors in later samples
  explicit UsdMovingMesh(const UsdStage& stage, const std::string& prim = {});
  ~UsdMovingMesh();

  /// Returns the mesh at the first sample.
  [[nodiscard]] const Mesh& mesh() const;
  /// Returns the times of the samples [s], increasing; empty for a static mesh.
  [[nodiscard]] const std::vector<double>& times() const;
  /// Returns the points at the i-th time, in the world [m].
  /// @throws UsageError if their number differs from the first sample's, or one is not finite
  [[nodiscard]] Vertices points(std::size_t i) const;
  /// Returns the whole motion. @throws UsageError also if it takes more than a gigabyte
  [[nodiscard]] MeshMotion read() const;

 private:
  class Reader;
  std::unique_ptr<Reader> reader_;
};

/// Returns the first value of an array attribute of a prim.
/// @param components see UsdAttribute
/// @throws UsageError if the prim has none, or it has another shape
const UsdValue& usd_array(const UsdPrim& prim, std::string_view name, std::size_t components);

/// Reads the mesh of a Mesh prim with the first sample of its points. Left-handed meshes and those mirrored by
/// `to_world` are flipped, so that triangles are counterclockwise seen from the front.
/// @throws UsageError "file:line:column: message"
Mesh read_mesh_prim(const UsdPrim& prim, const Eigen::Affine3d& to_world);

/// Returns the transform from prim coordinates to the world, in metres with z up: the xformOps of the prim and its
/// ancestors in xformOpOrder, then the layer's unit and up axis. A y-up scene is turned by 90° about x. Operations are
/// interpolated linearly between samples, quaternions along the shortest arc, and are constant outside.
/// @param time [time codes]
/// @throws UsageError for an unknown operation, one of the wrong type, or a matrix that is not affine
Eigen::Affine3d world_transform(const UsdStage& stage, const UsdPath& path, double time);

/// Converts a USD matrix, whose 16 numbers act on row vectors, p′ = p·M, by transposing it.
/// @throws UsageError at the place unless it is affine
Eigen::Affine3d usd_affine(const double* m, const SourcePlace& place);

/// Returns the sample times [time codes] of all operations on a prim and its ancestors, increasing.
std::vector<double> transform_times(const UsdPath& path);

}  // namespace drape
