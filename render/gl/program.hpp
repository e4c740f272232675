#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "render/gl/functions.hpp"

namespace drape {

/// A linked pair of shaders.
class Program {
 public:
  /// Compiles shaders/NAME.vert and shaders/NAME.frag of the data folder.
  /// @param defines preprocessor definitions ("SPHERES 1") for both
  /// A line `#include "file.glsl"` in a shader inserts that file of the same folder.
  /// @throws UsageError if a file cannot be read
  /// @throws OutputError with file, line and the compiler's message if one does not compile
  Program(const GlFunctions& gl, const std::filesystem::path& data_folder, const std::string& name,
          const std::vector<std::string>& defines = {});
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;
  ~Program();

  void use() const;

  /// Sets a uniform of this program, which must be in use. Ignores a uniform that the compiler removed as unused.
  void set(const char* uniform, int value) const;
  void set(const char* uniform, float value) const;
  void set(const char* uniform, const Eigen::Vector3f& value) const;
  void set(const char* uniform, const Eigen::Matrix4f& value) const;
  void set(const char* uniform, std::span<const Eigen::Vector4f> values) const;

 private:
  const GlFunctions& gl_;
  GLuint id_ = 0;
};

}  // namespace drape
