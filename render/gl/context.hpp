#pragma once

#include <memory>
#include <string>
#include <vector>

#include "render/backend.hpp"

namespace drape {

/// An OpenGL 3.3 core context without a window. It has no framebuffer worth drawing to: draw into framebuffer objects.
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
  /// Ends that, so that another thread may have the context, which must be current.
  virtual void release() = 0;

  /// A GL function by its full name ("glClear"), or null.
  [[nodiscard]] virtual Function get_proc_address(const char* name) const = 0;
};

/// A context of the backend. The libraries are loaded at run time, so that a machine without them gets a message and
/// not an error of the loader, and they stay loaded until the process ends.
/// @throws OutputError saying what to install, if there is none
std::unique_ptr<GlContext> make_gl_context(GlBackend backend);

/// The file names under which a library is looked for, in this order.
std::vector<std::string> osmesa_library_names();
std::vector<std::string> egl_library_names();

/// A context of OSMesa, Mesa's renderer into memory.
/// @throws OutputError if no library of these names can be loaded, or it cannot make the context
std::unique_ptr<GlContext> make_osmesa_context(const std::vector<std::string>& library_names = osmesa_library_names());

/// A context of EGL on the surfaceless platform, drawn by Mesa in software: a GPU would give other bytes.
/// @throws OutputError if no library of these names can be loaded, or it cannot make the context
std::unique_ptr<GlContext> make_egl_context(const std::vector<std::string>& library_names = egl_library_names());

/// The Debian packages that a backend needs, separated by spaces.
const char* debian_packages(GlBackend backend);

}  // namespace drape
