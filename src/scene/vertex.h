// A vertex as the vertex buffers hold it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>

#include "shared/motion_structs.h"

namespace jalousie::scene {

/// One vertex of the scene's vertex buffer; attribute locations are kAttribute... of shared/limits.h.
struct Vertex {
  glm::vec3 position;    ///< object space
  std::uint32_t normal;  ///< unit, 10 bits a component, signed normalised (GL_INT_2_10_10_10_REV)
  glm::vec2 uv;
  std::uint32_t color;     ///< linear RGBA, 8 bits a component
  std::uint32_t material;  ///< index into SceneData::materials
};
static_assert(sizeof(Vertex) == gpu::kVertexWords * sizeof(gpu::uint));
static_assert(offsetof(Vertex, normal) == gpu::kVertexNormalWord * sizeof(gpu::uint));

/// Signed normalised 10-10-10-2 packing, x in the low bits.
std::uint32_t packNormal(const glm::vec3& normal);
/// Linear RGBA, clamped to 0..1, red in the low bits.
std::uint32_t packColor(const glm::vec4& color);

}  // namespace jalousie::scene
