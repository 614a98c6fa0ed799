// What it costs to remove a loose part as a whole.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "bake/mesh/loose_parts.h"
#include "bake/mesh/triangle_bvh.h"
#include "bake/mesh/wedge_mesh.h"
#include "bake/simplify/part_classes.h"

namespace jalousie::bake {

/// A part costs its squared distance from surfaces that can stand for it: triangles of other parts, of the same
/// primitive, that face the same side. A part that is one of many similar ones costs what PartClasses says until it has
/// collapsed to the triangles of a box: leaves that are still leaves do not thin out, although no distance tells.
class PartRemoval {
 public:
  /// @param scale  the object-space length that is 1 in the unit frame
  PartRemoval(const WedgeMesh& mesh, const LooseParts& parts, const PartClasses& classes, double scale);

  static constexpr std::uint32_t kBox = 12;  ///< triangles
  /// Squared distance times area, unit frame, for each two triangles that are left of the part: a collapsed edge takes
  /// two. Never more than what PartClasses says. Grows as other parts go.
  /// @param aliveOfPart  [parts] faces that are left of each
  double cost(std::uint32_t part, std::span<const std::uint32_t> aliveOfPart) const;

 private:
  struct Sample {
    glm::vec3 point;
    std::uint32_t face;
    double area;  ///< that it stands for, object space
  };
  bool standsFor(std::uint32_t face, std::uint32_t other) const;

  /// What copies share.
  struct Shared {
    TriangleBvh surface;
    std::vector<std::uint32_t> partOfFace;
    std::vector<std::uint32_t> primitiveOfFace;
    std::vector<std::uint32_t> firstSample;  ///< [parts + 1]
    std::vector<Sample> samples;
  };
  double scale_;
  std::vector<double> costs_;  ///< [parts] PartClasses::costs
  std::vector<std::uint8_t> isOneOfMany_;
  std::vector<double> radii_;             ///< [parts] object space
  std::shared_ptr<const Shared> shared_;  ///< null if no part needs it
};

}  // namespace jalousie::bake
