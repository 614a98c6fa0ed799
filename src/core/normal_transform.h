// Normals under linear maps.
#pragma once

#include <cmath>
#include <glm/glm.hpp>

namespace jalousie {

/// Maps normals by the cofactors of a matrix, which are its inverse transpose up to a factor and exist for flat ones.
/// Normals keep their facing if the matrix mirrors.
class NormalTransform {
 public:
  explicit NormalTransform(const glm::dmat3& linear)
      : cofactors_(glm::cross(linear[1], linear[2]), glm::cross(linear[2], linear[0]),
                   glm::cross(linear[0], linear[1])),
        mirrors_(glm::determinant(linear) < 0.0) {
    if (mirrors_) cofactors_ = -cofactors_;
  }

  bool mirrors() const { return mirrors_; }
  /// The normal itself where the transform leaves nothing of it.
  glm::vec3 operator()(const glm::vec3& normal) const {
    const glm::dvec3 mapped = cofactors_ * glm::dvec3(normal);
    const double length = glm::length(mapped);
    return length > 0.0 && std::isfinite(length) ? glm::vec3(mapped / length) : normal;
  }

 private:
  glm::dmat3 cofactors_;
  bool mirrors_;
};

}  // namespace jalousie
