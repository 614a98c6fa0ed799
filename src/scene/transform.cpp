// Rows are the columns of the transposed matrix.
#include "scene/transform.h"

namespace jalousie::scene {

gpu::Transform makeTransform(const glm::mat4& worldFromObject) {
  const glm::mat4 rows = glm::transpose(worldFromObject);
  return {rows[0], rows[1], rows[2]};
}

glm::mat4 worldFromObject(const gpu::Transform& transform) {
  return glm::transpose(glm::mat4(transform.worldFromObject0, transform.worldFromObject1, transform.worldFromObject2,
                                  glm::vec4(0.0F, 0.0F, 0.0F, 1.0F)));
}

}  // namespace jalousie::scene
