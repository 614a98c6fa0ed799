// Computes the poses of the circles and of the approach, frame by frame.
#include "scatter/camera_path.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace jalousie::scatter {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr std::uint32_t kKeyStep = 10;
/// Height of the circle outside as an angle; with an occluder, which stands upright, the camera stays level.
constexpr double kElevation = 15.0 * kPi / 180.0;
/// Half the arc in front of a single object behind an occluder.
constexpr double kArc = 15.0 * kPi / 180.0;
/// Radius of the circle inside, as a share of half the cube's side.
constexpr double kInsideShare = 0.5;
/// Inside, the camera looks along its path, turned towards the middle by this angle.
constexpr double kInsideTurn = 30.0 * kPi / 180.0;
/// Margin around the objects. It also covers the parts of the circle that linear interpolation cuts off.
constexpr double kMargin = 1.03;

bool single(const PathSubject& subject) {
  return !(subject.halfSide > 0.0F);
}

double elevation(const PathSubject& subject) {
  return subject.occluder ? 0.0 : kElevation;
}

/// Towards a point of the circle outside; angle 0 is +z, a quarter turn is +x.
glm::dvec3 outward(double angle, double height) {
  return {std::sin(angle) * std::cos(height), std::sin(height), std::cos(angle) * std::cos(height)};
}

double smooth(double t) {
  const double x = std::clamp(t, 0.0, 1.0);
  return x * x * (3.0 - 2.0 * x);
}

/// Distance at which a cube's eight corners are inside a square frustum, seen from one direction.
double distanceForCube(double half, const glm::dvec3& direction) {
  const glm::dvec3 right = glm::normalize(glm::cross(glm::dvec3(0.0, 1.0, 0.0), direction));
  const glm::dvec3 up = glm::cross(direction, right);
  const double tangent = std::tan(0.5 * static_cast<double>(kFovY));
  double distance = 0.0;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec3 p(((corner & 1) != 0 ? half : -half), ((corner & 2) != 0 ? half : -half),
                       ((corner & 4) != 0 ? half : -half));
    const double across = std::max(std::abs(glm::dot(p, right)), std::abs(glm::dot(p, up)));
    distance = std::max(distance, glm::dot(p, direction) + across / tangent);
  }
  return distance;
}

/// Angle on the circle outside. With an occluder the path goes a quarter further, so that the approach misses it.
double outsideAngle(const PathSubject& subject, double frame) {
  if (!single(subject)) return (subject.occluder ? 2.5 : 2.0) * kPi * std::min(frame / kApproachFrame, 1.0);
  const double phase = 2.0 * kPi * frame / kApproachFrame;
  return subject.occluder ? kArc * std::sin(phase) : phase;
}

CameraPose outsidePose(const PathSubject& subject, double frame) {
  const glm::dvec3 direction = outward(outsideAngle(subject, frame), elevation(subject));
  return {static_cast<double>(outsideDistance(subject)) * direction, -direction};
}

CameraPose insidePose(const PathSubject& subject, double frame) {
  const double turn = (frame - kInsideFrame) / (kFrameCount - kInsideFrame);
  const double angle = outsideAngle(subject, kApproachFrame) + 2.0 * kPi * turn;
  const glm::dvec3 direction = outward(angle, 0.0);
  const glm::dvec3 along(std::cos(angle), 0.0, -std::sin(angle));
  return {kInsideShare * static_cast<double>(subject.halfSide) * direction,
          std::cos(kInsideTurn) * along - std::sin(kInsideTurn) * direction};
}

CameraPose poseAt(const PathSubject& subject, double frame) {
  if (single(subject) || frame < kApproachFrame) return outsidePose(subject, frame);
  if (frame >= kInsideFrame) return insidePose(subject, frame);
  const double weight = smooth((frame - kApproachFrame) / (kInsideFrame - kApproachFrame));
  const CameraPose from = outsidePose(subject, kApproachFrame);
  const CameraPose to = insidePose(subject, kInsideFrame);
  const glm::dvec3 position = glm::mix(from.position, to.position, weight);
  const glm::dvec3 direction = glm::mix(-glm::normalize(position), to.direction, weight);
  return {position, glm::normalize(direction)};
}

glm::quat rotationFor(const glm::dvec3& direction) {
  const glm::dvec3 right = glm::normalize(glm::cross(direction, glm::dvec3(0.0, 1.0, 0.0)));
  return glm::quat(glm::quat_cast(glm::dmat3(right, glm::cross(right, direction), -direction)));
}

}  // namespace

float outsideDistance(const PathSubject& subject) {
  if (single(subject))
    return static_cast<float>(kMargin * static_cast<double>(subject.objectRadius) /
                              std::sin(0.5 * static_cast<double>(kFovY)));
  constexpr int kDirections = 90;
  const double half = static_cast<double>(subject.halfSide) + static_cast<double>(subject.objectRadius);
  double distance = 0.0;
  for (int i = 0; i < kDirections; ++i)
    distance = std::max(distance, distanceForCube(half, outward(2.0 * kPi * i / kDirections, elevation(subject))));
  return static_cast<float>(kMargin * distance);
}

std::vector<glm::vec3> eyesBehindOccluder(const PathSubject& subject) {
  const double distance = static_cast<double>(outsideDistance(subject));
  if (!single(subject)) return {glm::vec3(distance * outward(0.0, 0.0))};
  return {glm::vec3(distance * outward(-kArc, 0.0)), glm::vec3(distance * outward(0.0, 0.0)),
          glm::vec3(distance * outward(kArc, 0.0))};
}

CameraPath sampledPath(const std::function<CameraPose(double frame)>& poseAt) {
  CameraPath path;
  for (std::uint32_t key = 0;; key += kKeyStep) {
    const std::uint32_t frame = std::min(key, kFrameCount - 1);
    const CameraPose pose = poseAt(frame);
    glm::quat rotation = rotationFor(pose.direction);
    if (!path.rotations.empty() && glm::dot(rotation, path.rotations.back()) < 0.0F) rotation = -rotation;
    path.times.push_back(static_cast<float>(frame) / static_cast<float>(kFramesPerSecond));
    path.positions.emplace_back(pose.position);
    path.rotations.push_back(rotation);
    if (frame == kFrameCount - 1) return path;
  }
}

CameraPath makeCameraPath(const PathSubject& subject) {
  return sampledPath([&](double frame) { return poseAt(subject, frame); });
}

}  // namespace jalousie::scatter
