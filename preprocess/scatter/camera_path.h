// The camera path: around the cube, towards it, a circle inside it (thesis 4.2.1), or around a single object.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <vector>

namespace jalousie::scatter {

inline constexpr float kFovY = 0.78539816F;  ///< 45 degrees, radians
inline constexpr std::uint32_t kFramesPerSecond = 30;
inline constexpr std::uint32_t kApproachFrame = 900;  ///< first frame of the approach
inline constexpr std::uint32_t kInsideFrame = 1200;   ///< first frame of the circle inside
inline constexpr std::uint32_t kFrameCount = 1800;    ///< frames 0 to 1799

/// The objects that the path goes around. World units; the objects are centred on the origin.
struct PathSubject {
  float halfSide = 0.0F;      ///< of the cube of the objects' centres; 0 for a single object
  float objectRadius = 1.0F;  ///< of the largest object's bounding sphere
  bool occluder = false;      ///< there is an occluder before the objects, towards +z
};

/// Camera poses, looking along -z of their frame, y up. Successive rotations have the same sign.
struct CameraPath {
  std::vector<float> times;  ///< seconds, ascending from 0
  std::vector<glm::vec3> positions;
  std::vector<glm::quat> rotations;
};

/// Where a camera is and where it looks. The direction is a unit vector, and not vertical.
struct CameraPose {
  glm::dvec3 position;
  glm::dvec3 direction;
};

/// Keys every ten frames and at the last frame, to be interpolated linearly. @param poseAt  of a frame
CameraPath sampledPath(const std::function<CameraPose(double frame)>& poseAt);

/// Distance from the origin at which all objects are in view of a square image, from everywhere on the path outside.
float outsideDistance(const PathSubject& subject);

/// Positions of the frames during which an occluder stands between the camera and the objects.
std::vector<glm::vec3> eyesBehindOccluder(const PathSubject& subject);

/// The path around the objects and among them.
CameraPath makeCameraPath(const PathSubject& subject);

}  // namespace jalousie::scatter
