#pragma once

#include <GL/glcorearb.h>

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
  ENTRY(PFNGLGETSTRINGIPROC, GetStringi)                                         \
  ENTRY(PFNGLGETUNIFORMLOCATIONPROC, GetUniformLocation)                         \
  ENTRY(PFNGLLINKPROGRAMPROC, LinkProgram)                                       \
  ENTRY(PFNGLPIXELSTOREIPROC, PixelStorei)                                       \
  ENTRY(PFNGLREADBUFFERPROC, ReadBuffer)                                         \
  ENTRY(PFNGLREADPIXELSPROC, ReadPixels)                                         \
  ENTRY(PFNGLRENDERBUFFERSTORAGEMULTISAMPLEPROC, RenderbufferStorageMultisample) \
  ENTRY(PFNGLSCISSORPROC, Scissor)                                               \
  ENTRY(PFNGLSHADERSOURCEPROC, ShaderSource)                                     \
  ENTRY(PFNGLTEXIMAGE2DPROC, TexImage2D)                                         \
  ENTRY(PFNGLTEXPARAMETERFPROC, TexParameterf)                                   \
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

}  // namespace drape
