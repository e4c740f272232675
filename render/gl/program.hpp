#pragma once

#include <GL/glcorearb.h>
#include <Eigen/Core>
#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace drape {

// All GL functions that the renderer calls: type, name without "gl". All belong to OpenGL 3.3 core.
#define DRAPE_GL_FUNCTIONS(ENTRY)                                                \
  ENTRY(PFNGLACTIVETEXTUREPROC, ActiveTexture)                                   \
  ENTRY(PFNGLATTACHSHADERPROC, AttachShader)                                     \
  ENTRY(PFNGLBINDBUFFERPROC, BindBuffer)                                         \
  ENTRY(PFNGLBINDFRAMEBUFFERPROC, BindFramebuffer)                               \
  ENTRY(PFNGLBINDRENDERBUFFERPROC, BindRenderbuffer)                             \
  ENTRY(PFNGLBINDTEXTUREPROC, BindTexture)                                       \
  ENTRY(PFNGLBINDVERTEXARRAYPROC, BindVertexArray)                               \
  ENTRY(PFNGLBLITFRAMEBUFFERPROC, BlitFramebuffer)                               \
  ENTRY(PFNGLBUFFERDATAPROC, BufferData)                                         \
  ENTRY(PFNGLBUFFERSUBDATAPROC, BufferSubData)                                   \
  ENTRY(PFNGLCHECKFRAMEBUFFERSTATUSPROC, CheckFramebufferStatus)                 \
  ENTRY(PFNGLCLEARPROC, Clear)                                                   \
  ENTRY(PFNGLCLEARCOLORPROC, ClearColor)                                         \
  ENTRY(PFNGLCOMPILESHADERPROC, CompileShader)                                   \
  ENTRY(PFNGLCREATEPROGRAMPROC, CreateProgram)                                   \
  ENTRY(PFNGLCREATESHADERPROC, CreateShader)                                     \
  ENTRY(PFNGLDELETEBUFFERSPROC, DeleteBuffers)                                   \
  ENTRY(PFNGLDELETEFRAMEBUFFERSPROC, DeleteFramebuffers)                         \
  ENTRY(PFNGLDELETEPROGRAMPROC, DeleteProgram)                                   \
  ENTRY(PFNGLDELETERENDERBUFFERSPROC, DeleteRenderbuffers)                       \
  ENTRY(PFNGLDELETESHADERPROC, DeleteShader)                                     \
  ENTRY(PFNGLDELETETEXTURESPROC, DeleteTextures)                                 \
  ENTRY(PFNGLDELETEVERTEXARRAYSPROC, DeleteVertexArrays)                         \
  ENTRY(PFNGLDISABLEPROC, Disable)                                               \
  ENTRY(PFNGLDRAWARRAYSPROC, DrawArrays)                                         \
  ENTRY(PFNGLDRAWBUFFERPROC, DrawBuffer)                                         \
  ENTRY(PFNGLDRAWELEMENTSPROC, DrawElements)                                     \
  ENTRY(PFNGLENABLEPROC, Enable)                                                 \
  ENTRY(PFNGLENABLEVERTEXATTRIBARRAYPROC, EnableVertexAttribArray)               \
  ENTRY(PFNGLFINISHPROC, Finish)                                                 \
  ENTRY(PFNGLFLUSHPROC, Flush)                                                   \
  ENTRY(PFNGLFRAMEBUFFERRENDERBUFFERPROC, FramebufferRenderbuffer)               \
  ENTRY(PFNGLFRAMEBUFFERTEXTURE2DPROC, FramebufferTexture2D)                     \
  ENTRY(PFNGLGENBUFFERSPROC, GenBuffers)                                         \
  ENTRY(PFNGLGENFRAMEBUFFERSPROC, GenFramebuffers)                               \
  ENTRY(PFNGLGENRENDERBUFFERSPROC, GenRenderbuffers)                             \
  ENTRY(PFNGLGENTEXTURESPROC, GenTextures)                                       \
  ENTRY(PFNGLGENVERTEXARRAYSPROC, GenVertexArrays)                               \
  ENTRY(PFNGLGETERRORPROC, GetError)                                             \
  ENTRY(PFNGLGETINTEGERVPROC, GetIntegerv)                                       \
  ENTRY(PFNGLGETPROGRAMINFOLOGPROC, GetProgramInfoLog)                           \
  ENTRY(PFNGLGETPROGRAMIVPROC, GetProgramiv)                                     \
  ENTRY(PFNGLGETSHADERINFOLOGPROC, GetShaderInfoLog)                             \
  ENTRY(PFNGLGETSHADERIVPROC, GetShaderiv)                                       \
  ENTRY(PFNGLGETSTRINGPROC, GetString)                                           \
  ENTRY(PFNGLGETUNIFORMLOCATIONPROC, GetUniformLocation)                         \
  ENTRY(PFNGLLINKPROGRAMPROC, LinkProgram)                                       \
  ENTRY(PFNGLPIXELSTOREIPROC, PixelStorei)                                       \
  ENTRY(PFNGLREADBUFFERPROC, ReadBuffer)                                         \
  ENTRY(PFNGLREADPIXELSPROC, ReadPixels)                                         \
  ENTRY(PFNGLRENDERBUFFERSTORAGEMULTISAMPLEPROC, RenderbufferStorageMultisample) \
  ENTRY(PFNGLSCISSORPROC, Scissor)                                               \
  ENTRY(PFNGLSHADERSOURCEPROC, ShaderSource)                                     \
  ENTRY(PFNGLTEXIMAGE2DPROC, TexImage2D)                                         \
  ENTRY(PFNGLTEXPARAMETERFVPROC, TexParameterfv)                                 \
  ENTRY(PFNGLTEXPARAMETERIPROC, TexParameteri)                                   \
  ENTRY(PFNGLTEXSUBIMAGE2DPROC, TexSubImage2D)                                   \
  ENTRY(PFNGLUNIFORM1FPROC, Uniform1f)                                           \
  ENTRY(PFNGLUNIFORM1IPROC, Uniform1i)                                           \
  ENTRY(PFNGLUNIFORM3FVPROC, Uniform3fv)                                         \
  ENTRY(PFNGLUNIFORM4FVPROC, Uniform4fv)                                         \
  ENTRY(PFNGLUNIFORMMATRIX4FVPROC, UniformMatrix4fv)                             \
  ENTRY(PFNGLUSEPROGRAMPROC, UseProgram)                                         \
  ENTRY(PFNGLVERTEXATTRIBPOINTERPROC, VertexAttribPointer)                       \
  ENTRY(PFNGLVIEWPORTPROC, Viewport)

class GlContext;

/// The table of GL functions of one context. They act on the context that is current on the calling thread.
struct GlFunctions {
#define DRAPE_GL_MEMBER(type, name) type name = nullptr;
  DRAPE_GL_FUNCTIONS(DRAPE_GL_MEMBER)
#undef DRAPE_GL_MEMBER

  /// Fetches every function from the context, which must be current.
  /// @throws OutputError naming the first one that the context lacks
  explicit GlFunctions(const GlContext& context);
};

/// Owner of one GL object. Its context must be current during construction and destruction.
template <auto Generate, auto Delete>
class GlObject {
 public:
  explicit GlObject(const GlFunctions& gl) : gl_(&gl) { (gl.*Generate)(1, &id_); }
  GlObject(GlObject&& other) noexcept : gl_(other.gl_), id_(std::exchange(other.id_, 0)) {}
  GlObject& operator=(GlObject&& other) noexcept {
    std::swap(gl_, other.gl_);
    std::swap(id_, other.id_);
    return *this;
  }
  ~GlObject() {
    if (id_ != 0) (gl_->*Delete)(1, &id_);
  }

  [[nodiscard]] GLuint id() const { return id_; }

 private:
  const GlFunctions* gl_;
  GLuint id_ = 0;
};

using Buffer = GlObject<&GlFunctions::GenBuffers, &GlFunctions::DeleteBuffers>;
using VertexArray = GlObject<&GlFunctions::GenVertexArrays, &GlFunctions::DeleteVertexArrays>;
using Texture = GlObject<&GlFunctions::GenTextures, &GlFunctions::DeleteTextures>;
using Framebuffer = GlObject<&GlFunctions::GenFramebuffers, &GlFunctions::DeleteFramebuffers>;
using Renderbuffer = GlObject<&GlFunctions::GenRenderbuffers, &GlFunctions::DeleteRenderbuffers>;

/// Converts an offset into the bound buffer [bytes] to the pointer that OpenGL expects.
inline const void* buffer_offset(std::size_t bytes) {
  return reinterpret_cast<const void*>(bytes);  // NOLINT(performance-no-int-to-ptr): so the interface is
}

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
