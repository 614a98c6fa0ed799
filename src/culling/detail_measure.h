// Detail culling: the area of an object's bounding sphere on the screen.
#pragma once

#include <glm/glm.hpp>

namespace jalousie::culling {

/// Area of the projection of a sphere, an ellipse: pi f^2 r^2 sqrt(D^2 - r^2) / (d^2 - r^2)^(3/2) pixels, with D the
/// distance of its centre and d its depth; infinite where the sphere reaches the plane of the eye (d <= r).
/// @param centerView  in the camera's frame, looking along -z; world units   @param focalPixels  scene::focalPixels
double sphereArea(const glm::dvec3& centerView, double radius, double focalPixels);

}  // namespace jalousie::culling
