#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <fmt/format.h>
#include <array>

#include "core/installation.hpp"
#include "drape/core/error.hpp"
#include "render/gl/context.hpp"

namespace drape {
namespace {

/// The functions of libEGL.
struct Egl {
  decltype(&eglGetPlatformDisplay) get_platform_display = nullptr;
  decltype(&eglInitialize) initialize = nullptr;
  decltype(&eglBindAPI) bind_api = nullptr;
  decltype(&eglCreateContext) create_context = nullptr;
  decltype(&eglDestroyContext) destroy_context = nullptr;
  decltype(&eglGetCurrentContext) current_context = nullptr;
  decltype(&eglMakeCurrent) make_current = nullptr;
  decltype(&eglGetProcAddress) get_proc_address = nullptr;
  decltype(&eglGetError) error = nullptr;

  explicit Egl(const std::vector<std::string>& library_names) {
    const SharedLibrary library("EGL", library_names, debian_packages(GlBackend::egl));
    library.fetch("eglGetPlatformDisplay", get_platform_display);
    library.fetch("eglInitialize", initialize);
    library.fetch("eglBindAPI", bind_api);
    library.fetch("eglCreateContext", create_context);
    library.fetch("eglDestroyContext", destroy_context);
    library.fetch("eglGetCurrentContext", current_context);
    library.fetch("eglMakeCurrent", make_current);
    library.fetch("eglGetProcAddress", get_proc_address);
    library.fetch("eglGetError", error);
  }

  [[noreturn]] void fail(const char* what) const {
    throw OutputError(fmt::format(
        "cannot draw: EGL cannot {} (error {:#x}); is Mesa's software renderer there? on Debian: apt-get install {}",
        what, static_cast<unsigned>(error()), debian_packages(GlBackend::egl)));
  }
};

/// A context that is current without a surface. The display belongs to the process and is never terminated: all
/// contexts on all threads share it.
class EglContext final : public GlContext {
 public:
  explicit EglContext(const std::vector<std::string>& library_names) : egl_(library_names) {
    display_ = egl_.get_platform_display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    if (display_ == EGL_NO_DISPLAY || egl_.initialize(display_, nullptr, nullptr) != EGL_TRUE) {
      egl_.fail("open its surfaceless display");
    }
    if (egl_.bind_api(EGL_OPENGL_API) != EGL_TRUE) egl_.fail("draw with OpenGL");
    constexpr std::array<EGLint, 7> attributes{
        EGL_CONTEXT_MAJOR_VERSION,           3,       EGL_CONTEXT_MINOR_VERSION, 3, EGL_CONTEXT_OPENGL_PROFILE_MASK,
        EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
    context_ = egl_.create_context(display_, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes.data());
    if (context_ == EGL_NO_CONTEXT) egl_.fail("make an OpenGL 3.3 core context");
  }

  ~EglContext() override {
    if (egl_.current_context() == context_) release();
    egl_.destroy_context(display_, context_);
  }

  void make_current() override {
    // Each thread has its own bound API.
    if (egl_.bind_api(EGL_OPENGL_API) != EGL_TRUE ||
        egl_.make_current(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) != EGL_TRUE) {
      egl_.fail("make its context current");
    }
  }

  // final, because the destructor calls it
  void release() final { egl_.make_current(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT); }

  [[nodiscard]] Function get_proc_address(const char* name) const override { return egl_.get_proc_address(name); }

 private:
  Egl egl_;
  EGLDisplay display_ = EGL_NO_DISPLAY;
  EGLContext context_ = EGL_NO_CONTEXT;
};

}  // namespace

std::vector<std::string> egl_library_names() { return {"libEGL.so.1", "libEGL.so"}; }

std::unique_ptr<GlContext> make_egl_context(const std::vector<std::string>& library_names) {
  prepare_llvmpipe();
  return std::make_unique<EglContext>(library_names);
}

}  // namespace drape
