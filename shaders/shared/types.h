// Lets the structs of this folder compile as C++20 and as GLSL 4.50. Only uint, int, float, vec2, vec4 and mat4 are
// used, with explicit reserved words, so that std430, std140 and C++ lay them out alike; a test compares them with the
// linked programs.
#ifndef JALOUSIE_SHARED_TYPES_H
#define JALOUSIE_SHARED_TYPES_H

#ifdef __cplusplus

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>

namespace jalousie::gpu {
using uint = std::uint32_t;
using vec2 = glm::vec2;
using vec4 = glm::vec4;
using mat4 = glm::mat4;
}  // namespace jalousie::gpu

#define JAL_SHARED_BEGIN namespace jalousie::gpu {
#define JAL_SHARED_END }
#define JAL_ASSERT_SIZE(type, bytes) \
  static_assert(sizeof(type) == (bytes), #type " must have the size the shaders expect");

#else

#define JAL_SHARED_BEGIN
#define JAL_SHARED_END
#define JAL_ASSERT_SIZE(type, bytes)

#endif
#endif
