// Ownership of one OpenGL object name.
#pragma once

#include <epoxy/gl.h>

#include <utility>

namespace jalousie::gl {

/// Owns a name and deletes it with Traits::destroy. Moved-from and default-constructed handles hold 0.
/// A context must be current when a handle that holds a name is destroyed.
template <class Traits>
class Handle {
 public:
  Handle() = default;
  explicit Handle(GLuint id) : id_(id) {}
  ~Handle() { reset(); }
  Handle(Handle&& other) noexcept : id_(other.release()) {}
  Handle& operator=(Handle&& other) noexcept {
    if (this != &other) {
      reset();
      id_ = other.release();
    }
    return *this;
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;

  /// The name; the handle keeps it.
  GLuint id() const { return id_; }
  /// Returns the name and forgets it; the caller deletes it.
  GLuint release() { return std::exchange(id_, 0); }

 private:
  void reset() {
    if (id_ != 0) Traits::destroy(std::exchange(id_, 0));
  }
  GLuint id_ = 0;
};

struct BufferTraits {
  static void destroy(GLuint id) { glDeleteBuffers(1, &id); }
};
struct TextureTraits {
  static void destroy(GLuint id) { glDeleteTextures(1, &id); }
};
struct FramebufferTraits {
  static void destroy(GLuint id) { glDeleteFramebuffers(1, &id); }
};
struct VertexArrayTraits {
  static void destroy(GLuint id) { glDeleteVertexArrays(1, &id); }
};
struct ProgramTraits {
  static void destroy(GLuint id) { glDeleteProgram(id); }
};
struct ShaderTraits {
  static void destroy(GLuint id) { glDeleteShader(id); }
};
struct SamplerTraits {
  static void destroy(GLuint id) { glDeleteSamplers(1, &id); }
};
struct QueryTraits {
  static void destroy(GLuint id) { glDeleteQueries(1, &id); }
};

/// Gives an object a name that debuggers and the debug log show: glObjectLabel.
inline void label(GLenum kind, GLuint id, const char* name) {
  glObjectLabel(kind, id, -1, name);
}

}  // namespace jalousie::gl
