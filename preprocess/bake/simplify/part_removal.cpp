// Samples lie in the middles of faces, spread over the part by area.
#include "bake/simplify/part_removal.h"

#include <algorithm>
#include <cmath>

#include "bake/mesh/normals.h"
#include "bake/mesh/wedges.h"

namespace jalousie::bake {
namespace {

constexpr std::size_t kMostSamples = 1U << 16U;  // of a mesh
constexpr std::size_t kMostOfPart = 6;
/// A part of more faces is not measured: a search that starts on it passes all of them.
constexpr std::uint32_t kMostFaces = 256;
/// Of a squared distance: a surface that is gone is missed more than one that has moved.
constexpr double kWeight = 2.0;
/// How far a surface may be, over the part's radius: beyond, PartClasses has the smaller cost.
constexpr double kNear = 2.83;

}  // namespace

PartRemoval::PartRemoval(const WedgeMesh& mesh, const LooseParts& parts, const PartClasses& classes, double scale)
    : scale_(scale), costs_(classes.costs), isOneOfMany_(classes.isOneOfMany) {
  for (const LoosePart& part : parts.parts)
    radii_.push_back(part.radius);
  const bool anyAlone = parts.parts.size() > 1 && std::find(classes.classOf.begin(), classes.classOf.end(),
                                                            PartClasses::kNone) != classes.classOf.end();
  if (!anyAlone) return;
  const std::vector<std::uint32_t> indices = vertexIndices(mesh);
  Shared shared{TriangleBvh(mesh.positions, indices), {}, {}, {}, {}};
  shared.partOfFace.resize(indices.size() / 3);
  for (std::size_t c = 0; c < mesh.corners.size(); c += 3)
    shared.primitiveOfFace.push_back(mesh.primitiveOf[mesh.corners[c]]);
  const std::size_t each = std::clamp<std::size_t>(kMostSamples / parts.parts.size(), 1, kMostOfPart);
  for (std::uint32_t p = 0; p < parts.parts.size(); ++p) {
    const LoosePart& part = parts.parts[p];
    shared.firstSample.push_back(static_cast<std::uint32_t>(shared.samples.size()));
    const auto faces = std::span(parts.faces).subspan(part.firstFace, part.faceCount);
    for (const std::uint32_t face : faces)
      shared.partOfFace[face] = p;
    const bool isPlain = classes.isOneOfMany[p] != 0 && part.faceCount <= kBox;
    if (classes.classOf[p] != PartClasses::kNone || isPlain || !(part.area > 0.0) || part.faceCount > kMostFaces)
      continue;
    const double step = part.area / static_cast<double>(each);
    double next = 0.5 * step;
    double sum = 0.0;
    for (const std::uint32_t face : faces) {
      const TriangleBvh::Corners& t = shared.surface.corners(face);
      sum += triangleArea(t.a, t.b, t.c);
      if (!(sum > next)) continue;
      double area = 0.0;
      for (; sum > next; next += step)
        area += step;
      shared.samples.push_back({(t.a + t.b + t.c) / 3.0F, face, area});
    }
  }
  shared.firstSample.push_back(static_cast<std::uint32_t>(shared.samples.size()));
  shared_ = std::make_shared<const Shared>(std::move(shared));
}

bool PartRemoval::standsFor(std::uint32_t face, std::uint32_t other) const {
  if (shared_->primitiveOfFace[face] != shared_->primitiveOfFace[other]) return false;
  const auto crossOf = [&](std::uint32_t f) {
    const TriangleBvh::Corners& t = shared_->surface.corners(f);
    return glm::cross(glm::dvec3(t.b) - glm::dvec3(t.a), glm::dvec3(t.c) - glm::dvec3(t.a));
  };
  return glm::dot(crossOf(face), crossOf(other)) > 0.0;
}

double PartRemoval::cost(std::uint32_t part, std::span<const std::uint32_t> aliveOfPart) const {
  const double alone = costs_[part];
  if (!shared_ || shared_->firstSample[part] == shared_->firstSample[part + 1]) return alone;
  if (isOneOfMany_[part] != 0 && aliveOfPart[part] > kBox) return alone;
  const double reach = kNear * radii_[part];
  double sum = 0.0;
  double area = 0.0;
  for (std::uint32_t s = shared_->firstSample[part]; s < shared_->firstSample[part + 1]; ++s) {
    const Sample& sample = shared_->samples[s];
    const NearestPoint found = shared_->surface.nearestWhere(sample.point, 2.0 * reach, [&](std::uint32_t face) {
      const std::uint32_t other = shared_->partOfFace[face];
      return other != part && aliveOfPart[other] > 0 && standsFor(sample.face, face);
    });
    sum += sample.area * found.distance2;
    area += sample.area;
  }
  if (!(sum <= area * reach * reach)) return alone;
  const double pairs = std::max(0.5 * aliveOfPart[part], 1.0);
  return std::min(kWeight * sum / (scale_ * scale_ * scale_ * scale_) / pairs, alone);
}

}  // namespace jalousie::bake
