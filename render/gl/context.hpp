#pragma once

#include <memory>
#include <string>
#include <vector>

#include "drape/render/settings.hpp"

namespace drape {

/// An OpenGL 3.3 core context without a window. Draw into framebuffer objects: its own framebuffer is unusable.
class GlContext {
 public:
  using Function = void (*)();

  GlContext() = default;
  GlContext(const GlContext&) = delete;
  GlContext& operator=(const GlContext&) = delete;
  virtual ~GlContext() = default;

  /// Directs the GL calls of the calling thread to this context.
  /// @throws OutputError if the library refuses
  virtual void make_current() = 0;
  /// Detaches the context, which must be current, from this thread, so that another thread may use it.
  virtual void release() = 0;

  /// Returns a GL function by its full name ("glClear"), or null.
  [[nodiscard]] virtual Function get_proc_address(const char* name) const = 0;
};

/// Makes a context of the backend. Its libraries are loaded at run time, so that their absence gives a clear message
/// instead of a loader error, and stay loaded until the process ends.
/// @throws OutputError with the packages to install, if there is none
std::unique_ptr<GlContext> make_gl_context(GlBackend backend);

/// Return the file names of a library, in search order.
std::vector<std::string> osmesa_library_names();
std::vector<std::string> egl_library_names();

/// Makes a context of OSMesa, Mesa's renderer into memory.
/// @throws OutputError if no library of these names can be loaded, or it cannot make the context
std::unique_ptr<GlContext> make_osmesa_context(const std::vector<std::string>& library_names = osmesa_library_names());

/// Makes a context of EGL on the surfaceless platform, drawn by Mesa in software: a GPU would give other bytes.
/// @throws OutputError if no library of these names can be loaded, or it cannot make the context
std::unique_ptr<GlContext> make_egl_context(const std::vector<std::string>& library_names = egl_library_names());

/// Returns the Debian packages of a backend, separated by spaces.
const char* debian_packages(GlBackend backend);

/// Identity and limits of a GL backend on this machine.
struct GlFacts {
  std::string renderer, vendor, version, shading_language;  ///< as reported by OpenGL
  int max_samples = 0;                                      ///< per pixel
  int max_texture_size = 0;                                 ///< [pixels]
  int max_picture_size = 0;                                 ///< width and height of a renderbuffer [pixels]
};

/// Makes a context of the backend and queries it.
/// @throws OutputError as make_gl_context()
GlFacts inspect_backend(GlBackend backend);

/// Limits llvmpipe, Mesa's software renderer, to vectors of 256 bits: with 512 it crashes when multisampling. Sets the
/// environment variable LP_NATIVE_VECTOR_WIDTH, which llvmpipe reads when it is loaded; a valid value set before stays.
/// @throws UsageError if it is set to more than 256, or to no number
void limit_llvmpipe_vector_width();

/// Sets the environment so that llvmpipe draws the same bytes everywhere. Calls limit_llvmpipe_vector_width(), makes
/// Mesa draw in software even with a GPU, and silences EGL on the terminal; variables already set stay. Call it before
/// a GL library is loaded.
/// @throws UsageError as limit_llvmpipe_vector_width()
/// @throws OutputError if GALLIUM_DRIVER names another renderer: Mesa crashes on an unknown one
void prepare_llvmpipe();

}  // namespace drape
