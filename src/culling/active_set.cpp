// Exact measures are taken in the order of their upper bounds, and only until no bound can change the choice.
#include "culling/active_set.h"

#include <algorithm>
#include <cmath>

#include "core/check.h"
#include "scene/transform.h"

namespace jalousie::culling {
namespace {

/// The faces of a solid as polygons.
std::vector<ConvexSolid> facesOf(const ConvexSolid& solid) {
  std::vector<ConvexSolid> polygons;
  for (const std::vector<std::uint32_t>& corners : solid.faces) {
    ConvexSolid polygon;
    polygon.faces.emplace_back();
    for (const std::uint32_t corner : corners) {
      polygon.faces[0].push_back(static_cast<std::uint32_t>(polygon.vertices.size()));
      polygon.vertices.push_back(solid.vertices[corner]);
    }
    polygons.push_back(std::move(polygon));
  }
  return polygons;
}

/// Upper bound of how much a matrix stretches lengths: the Frobenius norm.
double largestStretch(const glm::dmat4& matrix) {
  double sum = 0.0;
  for (int axis = 0; axis < 3; ++axis)
    sum += glm::dot(glm::dvec3(matrix[axis]), glm::dvec3(matrix[axis]));
  return std::sqrt(sum);
}

bool isInView(const QueryView& view, const PlacedOccluder& occluder) {
  for (std::uint32_t plane = 0; plane < kPlanes; ++plane)
    if (view.frustum.sideOf(occluder.center, occluder.radius, plane) == Frustum::Side::kOutside) return false;
  return true;
}

}  // namespace

glm::dmat4 matrixOf(const gpu::Transform& transform) {
  return {scene::worldFromObject(transform)};
}

Viewpoint viewpointOf(const QueryView& view) {
  return {glm::dvec3(view.eyeWorld), glm::dvec3(view.forwardWorld), view.orthographic};
}

OccluderTable::OccluderTable(const scene::SceneData& scene, OccluderUse use) {
  auto first = scene.objects.begin();
  for (const scene::ChainOccluder& occluder : scene.occluders) {
    const std::size_t firstShape = shapes_.size();
    const auto add = [&](ConvexSolid solid, bool isSurface) {
      Shape shape{OccluderShape(std::move(solid)), occluder.everyLevel, isSurface};
      const Aabb box = boundsOf(shape.convex.solid);
      shape.center = 0.5 * (glm::dvec3(box.min) + glm::dvec3(box.max));
      for (const glm::vec3& v : shape.convex.solid.vertices)
        shape.radius = std::max(shape.radius, glm::length(glm::dvec3(v) - shape.center));
      shapes_.push_back(std::move(shape));
    };
    if (use == OccluderUse::kSolids || occluder.solid.isPolygon())
      add(occluder.solid, occluder.solid.isPolygon());
    else
      for (ConvexSolid& face : facesOf(occluder.solid))
        add(std::move(face), /*isSurface=*/false);
    first = std::find_if(first, scene.objects.end(), [&](const gpu::Object& o) { return o.chain >= occluder.chain; });
    for (auto object = first; object != scene.objects.end() && object->chain == occluder.chain; ++object)
      for (std::size_t shape = firstShape; shape < shapes_.size(); ++shape)
        placed_.push_back(
            {static_cast<std::uint32_t>(shape), static_cast<std::uint32_t>(object - scene.objects.begin())});
  }
  follow(scene.objects, scene.transforms);
}

void OccluderTable::follow(std::span<const gpu::Object> objects, std::span<const gpu::Transform> transforms) {
  for (PlacedOccluder& placed : placed_) {
    const Shape& shape = shapes_[placed.shape];
    const glm::dmat4 matrix = matrixOf(transforms[objects[placed.object].transform]);
    placed.center = glm::dvec3(matrix * glm::dvec4(shape.center, 1.0));
    placed.radius = largestStretch(matrix) * shape.radius;
  }
}

ActiveSet::ActiveSet(std::size_t most) {
  bounds_.reserve(most);
  chosen_.reserve(kMostActive + 1);
  planes_.reserve(kMostShadowPlanes);
  shadows_.resize(kMostActive);
  for (CastShadow& shadow : shadows_)
    shadow.planes.reserve(kMostShadowPlanes);
}

bool ActiveSet::isUsable(std::uint32_t occluder, const QueryView& view, const OccluderScene& scene) {
  const PlacedOccluder& placed = scene.table.placed()[occluder];
  if (scene.everyLevel && !scene.table.holdsForEveryLevel(placed)) return false;
  const bool alone = scene.table.isSurface(placed);
  if (!alone && view.reachesNear(scene.boundsWorld[placed.object])) return false;
  scratch_.place(scene.table.shapeOf(placed), matrixOf(scene.transforms[scene.objects[placed.object].transform]));
  return !alone || !view.reachesNear(scratch_.boundsWorld());
}

void ActiveSet::choose(const QueryView& view, const OccluderOptions& options, const OccluderScene& scene) {
  const Viewpoint eye = viewpointOf(view);
  const bool paper = options.rank == Rank::kPaper;
  const std::vector<PlacedOccluder>& placed = scene.table.placed();
  bounds_.clear();
  chosen_.clear();
  if (options.active == 0) return;
  for (std::uint32_t i = 0; i < placed.size(); ++i)
    if (isInView(view, placed[i])) bounds_.push_back({solidAngleBound(placed[i].center, placed[i].radius, eye), i});
  const auto lower = [](const Ranked& a, const Ranked& b) { return b < a; };
  std::make_heap(bounds_.begin(), bounds_.end(), lower);
  while (!bounds_.empty()) {
    const Ranked next = bounds_.front();
    if (!paper && chosen_.size() == options.active && !(next.measure > chosen_.back().measure)) break;
    std::pop_heap(bounds_.begin(), bounds_.end(), lower);
    bounds_.pop_back();
    if (!isUsable(next.occluder, view, scene)) continue;
    const double measure = paper ? paperRank(scratch_, eye) : solidAngle(scratch_, eye);
    if (!(measure > 0.0)) continue;
    const Ranked ranked{measure, next.occluder};
    chosen_.insert(std::upper_bound(chosen_.begin(), chosen_.end(), ranked), ranked);
    if (chosen_.size() > options.active) chosen_.pop_back();
  }
}

std::span<const CastShadow> ActiveSet::cast(const QueryView& view, const OccluderOptions& options,
                                            const OccluderScene& scene) {
  JAL_CHECK(options.active <= kMostActive);
  if (age_ == 0) {
    choose(view, options, scene);
    age_ = std::max(options.rankEvery, 1U);
  }
  --age_;
  const Viewpoint eye = viewpointOf(view);
  std::size_t count = 0;
  for (const Ranked& ranked : chosen_) {
    if (count == options.active) break;
    CastShadow& shadow = shadows_[count];
    if (!isUsable(ranked.occluder, view, scene) || !castShadow(scratch_, eye, options.cap, shadow.planes)) continue;
    shadow.occluder = ranked.occluder;
    ++count;
  }
  return std::span(shadows_).first(count);
}

}  // namespace jalousie::culling
