#pragma once

#include <cstddef>
#include <utility>

#include "render/gl/functions.hpp"

namespace drape {

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

}  // namespace drape
