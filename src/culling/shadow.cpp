// In double precision: products of coordinates lose nothing that a pixel could show.
#include "culling/shadow.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <utility>

namespace jalousie::culling {
namespace {

constexpr double kPi = std::numbers::pi;
/// Share of lengths below which a direction or a distance is taken for rounding.
constexpr double kTiny = 1e-12;

/// Of the triangle at three points as seen from the origin, Van Oosterom and Strackee 1983.
double solidAngleOf(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  const double la = glm::length(a);
  const double lb = glm::length(b);
  const double lc = glm::length(c);
  const double volume = std::abs(glm::dot(a, glm::cross(b, c)));
  return 2.0 * std::atan2(volume, la * lb * lc + glm::dot(a, b) * lc + glm::dot(a, c) * lb + glm::dot(b, c) * la);
}

/// Twice the area long.
glm::dvec3 normalOf(const std::vector<glm::dvec3>& vertices, const std::vector<std::uint32_t>& corners) {
  glm::dvec3 normal(0.0);
  for (std::size_t i = 1; i + 1 < corners.size(); ++i)
    normal += glm::cross(vertices[corners[i]] - vertices[corners[0]], vertices[corners[i + 1]] - vertices[corners[0]]);
  return normal;
}

/// Rounded outwards to floats.
Aabb boundsOfPoints(const std::vector<glm::dvec3>& points) {
  Aabb box;
  for (const glm::dvec3& p : points)
    box.add(glm::vec3(p));
  for (int axis = 0; axis < 3; ++axis) {
    box.min[axis] = std::nextafter(box.min[axis], -std::numeric_limits<float>::infinity());
    box.max[axis] = std::nextafter(box.max[axis], std::numeric_limits<float>::infinity());
  }
  return box;
}

/// The plane through an edge and the eye, with a point inside. @return  whether there is one
bool addSilhouettePlane(const glm::dvec3& edge, const glm::dvec3& toEye, const std::pair<glm::dvec3, glm::dvec3>& onIn,
                        std::vector<ShadowPlane>& planes) {
  const glm::dvec3 normal = glm::cross(edge, toEye);
  const double length = glm::length(normal);
  if (!(length > kTiny * glm::length(edge) * glm::length(toEye))) return false;
  ShadowPlane plane{normal / length, glm::dot(normal / length, onIn.first)};
  const double inside = plane.distanceTo(onIn.second);
  if (!(std::abs(inside) > kTiny * glm::length(edge))) return false;
  if (inside > 0.0) plane = {-plane.normal, -plane.offset};
  planes.push_back(plane);
  return true;
}

}  // namespace

OccluderShape::OccluderShape(ConvexSolid convex) : solid(std::move(convex)) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> faceOf;
  for (std::uint32_t face = 0; face < solid.faces.size(); ++face) {
    const std::vector<std::uint32_t>& corners = solid.faces[face];
    for (std::size_t i = 0; i < corners.size(); ++i)
      faceOf[{corners[i], corners[(i + 1) % corners.size()]}] = face;
  }
  for (const auto& [ends, left] : faceOf) {
    const auto back = faceOf.find({ends.second, ends.first});
    if (back == faceOf.end()) edges.push_back({ends.first, ends.second, left, left});
    if (back != faceOf.end() && ends.first < ends.second)
      edges.push_back({ends.first, ends.second, left, back->second});
  }
}

WorldOccluder::WorldOccluder() {
  vertices_.reserve(ConvexSolid::kMostVertices);
  faces_.reserve(ConvexSolid::kMostFaces);
}

bool WorldOccluder::placeFace(const std::vector<std::uint32_t>& corners, bool mirrors) {
  const glm::dvec3 normal = (mirrors ? -1.0 : 1.0) * normalOf(vertices_, corners);
  const double length = glm::length(normal);
  if (!(length > kTiny * radius_ * radius_) || !std::isfinite(length)) return false;
  Face face;
  for (const std::uint32_t corner : corners)
    face.center += vertices_[corner] / static_cast<double>(corners.size());
  face.plane = {normal / length, glm::dot(normal / length, face.center)};
  face.area = 0.5 * length;
  faces_.push_back(face);
  return true;
}

void WorldOccluder::place(const OccluderShape& shape, const glm::dmat4& worldFromObject) {
  const auto count = static_cast<double>(shape.solid.vertices.size());
  shape_ = &shape;
  vertices_.clear();
  faces_.clear();
  center_ = glm::dvec3(0.0);
  radius_ = 0.0;
  for (const glm::vec3& v : shape.solid.vertices) {
    vertices_.emplace_back(worldFromObject * glm::dvec4(glm::dvec3(v), 1.0));
    center_ += vertices_.back() / count;
  }
  for (const glm::dvec3& v : vertices_)
    radius_ = std::max(radius_, glm::length(v - center_));
  boundsWorld_ = boundsOfPoints(vertices_);
  const bool mirrors = glm::determinant(glm::dmat3(worldFromObject)) < 0.0;
  for (const std::vector<std::uint32_t>& corners : shape.solid.faces) {
    if (placeFace(corners, mirrors)) continue;
    faces_.clear();
    return;
  }
}

bool WorldOccluder::isFront(const Face& face, const Viewpoint& view) const {
  return glm::dot(face.plane.normal, view.toEye(face.center)) > kTiny * radius_;
}

bool WorldOccluder::isSilhouette(const OccluderShape::Edge& edge, const Viewpoint& view) const {
  return edge.left == edge.right || isFront(faces_[edge.left], view) != isFront(faces_[edge.right], view);
}

void WorldOccluder::addFrontPlanes(const Viewpoint& view, std::vector<ShadowPlane>& planes) const {
  const bool bothSides = isPolygon() && shape_->solid.bothSides;
  for (const Face& face : faces_) {
    const double facing = glm::dot(face.plane.normal, view.toEye(face.center));
    if (facing > kTiny * radius_)
      planes.push_back(face.plane);
    else if (bothSides && facing < -kTiny * radius_)
      planes.push_back({-face.plane.normal, -face.plane.offset});
  }
}

bool WorldOccluder::addSilhouettePlanes(const Viewpoint& view, std::vector<ShadowPlane>& planes) const {
  for (const OccluderShape::Edge& edge : shape_->edges) {
    if (!isSilhouette(edge, view)) continue;
    const glm::dvec3& from = vertices_[edge.from];
    if (!addSilhouettePlane(vertices_[edge.to] - from, view.toEye(from), {from, center_}, planes)) return false;
  }
  return true;
}

ShadowPlane WorldOccluder::paperCap(const Viewpoint& view) const {
  glm::dvec3 sum(0.0);
  for (const OccluderShape::Edge& edge : shape_->edges)
    if (isSilhouette(edge, view)) sum += view.toEye(vertices_[edge.from]) + view.toEye(vertices_[edge.to]);
  ShadowPlane plane{glm::normalize(sum), std::numeric_limits<double>::infinity()};
  for (const OccluderShape::Edge& edge : shape_->edges)
    if (isSilhouette(edge, view))
      plane.offset = std::min(
          {plane.offset, glm::dot(plane.normal, vertices_[edge.from]), glm::dot(plane.normal, vertices_[edge.to])});
  return plane;
}

bool castShadow(const WorldOccluder& occluder, const Viewpoint& view, Cap cap, std::vector<ShadowPlane>& planes) {
  planes.clear();
  occluder.addFrontPlanes(view, planes);
  if (planes.empty()) return false;
  if (cap == Cap::kPaper && !occluder.isPolygon()) planes.assign(1, occluder.paperCap(view));
  return occluder.addSilhouettePlanes(view, planes);
}

Shaded shadedBy(std::span<const ShadowPlane> planes, const Aabb& box, std::uint64_t& tests) {
  const glm::dvec3 low(box.min);
  const glm::dvec3 high(box.max);
  Shaded result = Shaded::kFully;
  for (const ShadowPlane& plane : planes) {
    ++tests;
    double outermost = -plane.offset;
    double innermost = -plane.offset;
    for (int axis = 0; axis < 3; ++axis) {
      const double a = plane.normal[axis] * low[axis];
      const double b = plane.normal[axis] * high[axis];
      outermost += std::max(a, b);
      innermost += std::min(a, b);
    }
    if (innermost >= 0.0) return Shaded::kNot;
    // Not the negation of "<": sums that are no number hide nothing.
    if (!(outermost < 0.0)) result = Shaded::kPartly;
  }
  return result;
}

double solidAngle(const WorldOccluder& occluder, const Viewpoint& view) {
  double sum = 0.0;
  for (std::size_t f = 0; f < occluder.faces_.size(); ++f) {
    const WorldOccluder::Face& face = occluder.faces_[f];
    const bool seen = occluder.isFront(face, view) || (occluder.isPolygon() && occluder.shape_->solid.bothSides);
    if (!seen) continue;
    if (view.parallel) {
      sum += face.area * std::abs(glm::dot(face.plane.normal, view.direction));
      continue;
    }
    const std::vector<std::uint32_t>& corners = occluder.shape_->solid.faces[f];
    const glm::dvec3 first = occluder.vertices_[corners[0]] - view.point;
    for (std::size_t i = 1; i + 1 < corners.size(); ++i)
      sum += solidAngleOf(first, occluder.vertices_[corners[i]] - view.point,
                          occluder.vertices_[corners[i + 1]] - view.point);
  }
  return sum;
}

double solidAngleBound(const glm::dvec3& center, double radius, const Viewpoint& view) {
  if (view.parallel) return kPi * radius * radius;
  const double share = radius / glm::length(center - view.point);
  if (!(share < 1.0)) return 4.0 * kPi;
  return 2.0 * kPi * (1.0 - std::sqrt(1.0 - share * share));
}

double paperRank(const WorldOccluder& occluder, const Viewpoint& view) {
  if (occluder.faces_.empty()) return 0.0;
  if (occluder.isPolygon()) {
    const WorldOccluder::Face& face = occluder.faces_[0];
    const glm::dvec3 toEye = view.toEye(face.center);
    const double facing = face.area * glm::dot(face.plane.normal, toEye) / glm::dot(toEye, toEye);
    return occluder.shape_->solid.bothSides ? std::abs(facing) : facing;
  }
  double volume = 0.0;
  for (const WorldOccluder::Face& face : occluder.faces_)
    volume += face.area * -face.plane.distanceTo(occluder.center_) / 3.0;
  const double distance = glm::length(view.toEye(occluder.center_));
  return volume / (distance * distance * distance);
}

}  // namespace jalousie::culling
