#pragma once

#include <memory>
#include <string>
#include <vector>

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

  /// A GL function by its full name ("glClear"), or null.
  [[nodiscard]] virtual Function get_proc_address(const char* name) const = 0;
};

/// The file names under which OSMesa is looked for, in this order.
std::vector<std::string> osmesa_library_names();

/// A context of OSMesa, Mesa's renderer into memory. The library is loaded at run time, so that a machine without it
/// gets a message and not an error of the loader.
/// @throws OutputError if no library of these names can be loaded, or it cannot make the context
std::unique_ptr<GlContext> make_osmesa_context(const std::vector<std::string>& library_names = osmesa_library_names());

}  // namespace drape
