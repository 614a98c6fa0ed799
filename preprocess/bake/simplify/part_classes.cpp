// Classes by primitive and area; the order of removal follows a space-filling curve by the van der Corput sequence.
#include "bake/simplify/part_classes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "bake/mesh/normals.h"
#include "core/aabb.h"

namespace jalousie::bake {
namespace {

/// The cost of removing a loose part is this factor times its area times its squared radius: unlike a collapsed edge, a
/// removed part leaves no surface nearby.
constexpr double kPartWeight = 16.0;
constexpr double kMostGrowth = 8.0;  ///< of a part's lengths
/// The last tenth of a class costs this much more if the class makes up a quarter of its primitive and a hundredth of
/// the mesh: a material that vanished would change the colour of the whole.
constexpr double kLastOfItsMaterial = 256.0;

/// Spreads the lowest ten bits three apart.
std::uint32_t spreadBits(std::uint32_t x) {
  std::uint32_t result = 0;
  for (std::uint32_t bit = 0; bit < 10; ++bit)
    result |= (x >> bit & 1U) << (3 * bit);
  return result;
}

std::uint32_t mortonCode(const glm::vec3& p, const Aabb& box) {
  const glm::vec3 extent = glm::max(box.extent(), glm::vec3(1e-30F));
  std::uint32_t code = 0;
  for (int k = 0; k < 3; ++k) {
    const float share = std::clamp((p[k] - box.min[k]) / extent[k], 0.0F, 1.0F);
    code |= spreadBits(static_cast<std::uint32_t>(share * 1023.0F)) << k;
  }
  return code;
}

std::uint32_t reversedBits(std::uint32_t x) {
  std::uint32_t result = 0;
  for (std::uint32_t bit = 0; bit < 32; ++bit)
    result |= (x >> bit & 1U) << (31 - bit);
  return result;
}

std::uint32_t primitiveOfPart(const WedgeMesh& mesh, const LooseParts& parts, std::uint32_t part) {
  return mesh.primitiveOf[mesh.corners[3 * std::size_t{parts.faces[parts.parts[part].firstFace]}]];
}

/// Puts the members of a class into the order of removal. Those that stay longest are evenly spread along the curve.
/// @return  the diagonal of their box
double orderMembers(const WedgeMesh& mesh, const LooseParts& parts, std::vector<std::uint32_t>& members) {
  Aabb box;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> alongCurve;
  const auto placeOf = [&](std::uint32_t part) {
    return mesh.positions[mesh.vertexAt(3 * std::size_t{parts.faces[parts.parts[part].firstFace]})];
  };
  for (const std::uint32_t part : members)
    box.add(placeOf(part));
  alongCurve.reserve(members.size());
  for (const std::uint32_t part : members)
    alongCurve.emplace_back(mortonCode(placeOf(part), box), part);
  std::sort(alongCurve.begin(), alongCurve.end());
  std::vector<std::pair<std::uint32_t, std::uint32_t>> keyed;
  keyed.reserve(members.size());
  for (std::uint32_t i = 0; i < alongCurve.size(); ++i)
    keyed.emplace_back(reversedBits(i), alongCurve[i].second);
  std::sort(keyed.rbegin(), keyed.rend());
  for (std::size_t i = 0; i < keyed.size(); ++i)
    members[i] = keyed[i].second;
  return box.diagonal();
}

/// Whether a material would be missed if a class with this area went.
bool isMainPart(double area, double areaOfPrimitive, double areaOfMesh) {
  return area > 0.25 * areaOfPrimitive && area > 0.01 * areaOfMesh;
}

std::vector<std::uint32_t> findPartOfVertex(const WedgeMesh& mesh, const LooseParts& parts) {
  std::vector<std::uint32_t> partOf(mesh.positions.size(), PartClasses::kNone);
  for (std::uint32_t p = 0; p < parts.parts.size(); ++p)
    for (std::uint32_t f = 0; f < parts.parts[p].faceCount; ++f)
      for (std::size_t k = 0; k < 3; ++k)
        partOf[mesh.vertexAt(3 * std::size_t{parts.faces[parts.parts[p].firstFace + f]} + k)] = p;
  return partOf;
}

/// Largest distance of a vertex from the mean of the part's vertices: unlike that of a box, it does not depend on the
/// direction of the part.
std::vector<double> radiiOf(const WedgeMesh& mesh, const std::vector<std::uint32_t>& partOf, std::size_t parts) {
  std::vector<glm::dvec3> centers(parts, glm::dvec3(0.0));
  std::vector<double> counts(parts, 0.0);
  std::vector<double> radii(parts, 0.0);
  for (std::size_t v = 0; v < partOf.size(); ++v) {
    centers[partOf[v]] += glm::dvec3(mesh.positions[v]);
    counts[partOf[v]] += 1.0;
  }
  for (std::size_t v = 0; v < partOf.size(); ++v)
    radii[partOf[v]] = std::max(radii[partOf[v]],
                                glm::distance(centers[partOf[v]] / counts[partOf[v]], glm::dvec3(mesh.positions[v])));
  return radii;
}

/// Of a part that stands alone, unit frame.
double removalCost(const LoosePart& part, double scale) {
  const double radius = part.radius / scale;
  return kPartWeight * part.area / (scale * scale) * radius * radius;
}

/// Parts by primitive, area and radius.
using PartGroups = std::map<std::array<int, 3>, std::vector<std::uint32_t>>;

void markMany(const PartGroups& groups, std::vector<std::uint8_t>& isOneOfMany) {
  for (const auto& [key, members] : groups)
    for (const std::uint32_t p : members)
      isOneOfMany[p] = members.size() >= PartClasses::kLeastInClass ? 1 : 0;
}

std::vector<bool> findOpenParts(const EdgeTable& edges, const std::vector<std::uint32_t>& partOf, std::size_t parts) {
  std::vector<bool> isOpen(parts, false);
  for (const MeshEdge& edge : edges.edges)
    if (edge.kind == EdgeKind::kBorder) isOpen[partOf[edge.a]] = true;
  return isOpen;
}

}  // namespace

PartClasses classifyParts(const WedgeMesh& mesh, const EdgeTable& edges, const LooseParts& parts, double scale) {
  PartClasses classes;
  classes.partOfVertex = findPartOfVertex(mesh, parts);
  const std::vector<bool> isOpen = findOpenParts(edges, classes.partOfVertex, parts.parts.size());
  classes.classOf.assign(parts.parts.size(), PartClasses::kNone);
  const std::vector<double> radii = radiiOf(mesh, classes.partOfVertex, parts.parts.size());
  PartGroups groups;  // of open parts
  PartGroups closed;
  classes.isOneOfMany.assign(parts.parts.size(), 0);
  std::map<std::uint32_t, double> areaOfPrimitive;
  double areaOfMesh = 0.0;
  for (std::uint32_t p = 0; p < parts.parts.size(); ++p) {
    const LoosePart& part = parts.parts[p];
    classes.costs.push_back(removalCost(part, scale));
    if (!(part.area > 0.0)) continue;
    const int size = static_cast<int>(std::floor(0.5 * std::log2(part.area / (scale * scale))));
    const int length = static_cast<int>(std::floor(std::log2(radii[p] / scale)));
    (isOpen[p] ? groups : closed)[{static_cast<int>(primitiveOfPart(mesh, parts, p)), size, length}].push_back(p);
    if (!isOpen[p]) continue;
    areaOfPrimitive[primitiveOfPart(mesh, parts, p)] += part.area;
    areaOfMesh += part.area;
  }
  markMany(groups, classes.isOneOfMany);
  markMany(closed, classes.isOneOfMany);
  for (auto& [key, members] : groups) {
    if (members.size() < PartClasses::kLeastInClass) continue;
    const auto number = static_cast<std::uint32_t>(classes.areas.size());
    const auto count = static_cast<double>(members.size());
    classes.extents.push_back(orderMembers(mesh, parts, members));
    double area = 0.0;
    double cost = 0.0;
    for (const std::uint32_t p : members) {
      area += parts.parts[p].area;
      cost += classes.costs[p] / count;
    }
    const bool isMain = isMainPart(area, areaOfPrimitive.at(static_cast<std::uint32_t>(key[0])), areaOfMesh);
    // The fewer are left, the further is each from the place of those that are gone.
    for (std::size_t i = 0; i < members.size(); ++i) {
      classes.classOf[members[i]] = number;
      classes.costs[members[i]] = cost * count / (count - static_cast<double>(i));
      if (isMain && 10 * (i + 1) > 9 * members.size()) classes.costs[members[i]] *= kLastOfItsMaterial;
    }
    classes.areas.push_back(area);
    classes.sizes.push_back(static_cast<std::uint32_t>(members.size()));
  }
  return classes;
}

std::vector<std::uint32_t> partsOfLevel(const PartClasses& classes, std::span<const std::uint32_t> vertexMap,
                                        const WedgeMesh& level) {
  std::vector<std::uint32_t> partOf(level.positions.size(), PartClasses::kNone);
  for (std::size_t v = 0; v < vertexMap.size(); ++v)
    if (vertexMap[v] != ~0U) partOf[vertexMap[v]] = classes.partOfVertex[v];
  return partOf;
}

namespace {

/// The classes of a level: parts that are left, and the area they have now.
struct ClassesNow {
  std::vector<double> areas;
  std::vector<std::uint32_t> left;
};

/// @param partOf  of each vertex of the level
ClassesNow classesNow(const PartClasses& classes, const std::vector<std::uint32_t>& partOf, const WedgeMesh& level) {
  ClassesNow now{std::vector<double>(classes.areas.size(), 0.0), std::vector<std::uint32_t>(classes.areas.size(), 0)};
  for (std::size_t c = 0; c < level.corners.size(); c += 3) {
    const std::uint32_t number = classes.classOf[partOf[level.vertexAt(c)]];
    if (number == PartClasses::kNone) continue;
    now.areas[number] += triangleArea(level.positions[level.vertexAt(c)], level.positions[level.vertexAt(c + 1)],
                                      level.positions[level.vertexAt(c + 2)]);
  }
  std::vector<bool> seen(classes.classOf.size(), false);
  for (const std::uint32_t part : partOf) {
    if (seen[part] || classes.classOf[part] == PartClasses::kNone) continue;
    seen[part] = true;
    ++now.left[classes.classOf[part]];
  }
  return now;
}

/// How the parts of a class are scaled.
struct Growth {
  double uniform = 1.0;  ///< of all lengths
  double across = 1.0;   ///< of lengths across the part's longest direction
  double most = 0.0;     ///< largest move of a vertex
};

/// Scales parts about their centres. @param growths  of each class
void scaleParts(const PartClasses& classes, const std::vector<std::uint32_t>& partOf,
                const std::vector<Growth>& growths, WedgeMesh& level) {
  const std::size_t parts = classes.classOf.size();
  std::vector<glm::dvec3> centers(parts, glm::dvec3(0.0));
  std::vector<double> counts(parts, 0.0);
  std::vector<glm::dvec3> longest(parts, glm::dvec3(0.0));
  for (std::size_t v = 0; v < partOf.size(); ++v) {
    centers[partOf[v]] += glm::dvec3(level.positions[v]);
    counts[partOf[v]] += 1.0;
  }
  for (std::size_t p = 0; p < parts; ++p)
    centers[p] /= std::max(counts[p], 1.0);
  for (std::size_t v = 0; v < partOf.size(); ++v) {
    const glm::dvec3 off = glm::dvec3(level.positions[v]) - centers[partOf[v]];
    if (glm::dot(off, off) > glm::dot(longest[partOf[v]], longest[partOf[v]])) longest[partOf[v]] = off;
  }
  std::vector<double> wide(parts, 0.0);  // largest distance of a vertex from the longest direction
  for (std::size_t v = 0; v < partOf.size(); ++v) {
    const glm::dvec3& axis = longest[partOf[v]];
    const glm::dvec3 off = glm::dvec3(level.positions[v]) - centers[partOf[v]];
    const double length2 = glm::dot(axis, axis);
    if (length2 > 0.0)
      wide[partOf[v]] = std::max(wide[partOf[v]], glm::length(off - glm::dot(off, axis) / length2 * axis));
  }
  for (std::size_t v = 0; v < partOf.size(); ++v) {
    const std::uint32_t number = classes.classOf[partOf[v]];
    const glm::dvec3& axis = longest[partOf[v]];
    const double length2 = glm::dot(axis, axis);
    if (number == PartClasses::kNone || !(length2 > 0.0)) continue;
    const glm::dvec3 off = glm::dvec3(level.positions[v]) - centers[partOf[v]];
    const glm::dvec3 along = glm::dot(off, axis) / length2 * axis;
    const Growth& growth = growths[number];
    const double uniform = std::min(growth.uniform, 1.0 + growth.most / std::sqrt(length2));
    const double across = growth.across * (growth.uniform / uniform) * (growth.uniform / uniform);
    const double width = wide[partOf[v]];
    const double limited = width > 0.0 ? std::min(across, 1.0 + growth.most / (uniform * width)) : across;
    level.positions[v] = glm::vec3(centers[partOf[v]] + uniform * (along + limited * (off - along)));
  }
}

}  // namespace

void growParts(const PartClasses& classes, std::span<const std::uint32_t> vertexMap, WedgeMesh& level) {
  if (classes.areas.empty()) return;
  const std::vector<std::uint32_t> partOf = partsOfLevel(classes, vertexMap, level);
  // The first round makes up for parts that are gone, the others for area that collapses took from the rest or added.
  for (int round = 0; round < 3; ++round) {
    const ClassesNow now = classesNow(classes, partOf, level);
    std::vector<Growth> growths(classes.areas.size());
    for (std::size_t i = 0; i < classes.areas.size(); ++i) {
      if (now.left[i] == 0 || !(now.areas[i] > 0.0)) continue;
      const double gone = static_cast<double>(classes.sizes[i]) / now.left[i];
      Growth& growth = growths[i];
      growth.most = 0.5 * classes.extents[i] / std::cbrt(static_cast<double>(now.left[i]));
      if (round == 0) growth.uniform = std::min(std::sqrt(gone), kMostGrowth);
      const double missing = classes.areas[i] / (now.areas[i] * growth.uniform * growth.uniform);
      if (std::abs(missing - 1.0) > 0.02) growth.across = std::clamp(missing, 1.0 / kMostGrowth, kMostGrowth);
    }
    scaleParts(classes, partOf, growths, level);
  }
}

}  // namespace jalousie::bake
