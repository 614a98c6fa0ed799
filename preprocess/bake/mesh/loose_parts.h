// Finds the parts of a mesh that share no vertex.
#pragma once

#include <cstdint>
#include <vector>

#include "bake/mesh/wedge_mesh.h"

namespace jalousie::bake {

struct LoosePart {
  double area = 0.0;
  double radius = 0.0;  ///< half the diagonal of its box
  std::uint32_t firstFace = 0;
  std::uint32_t faceCount = 0;
};

/// Parts in the order of their first face; faces holds the faces of each part in a row.
struct LooseParts {
  std::vector<LoosePart> parts;
  std::vector<std::uint32_t> faces;
  std::uint32_t largest = 0;  ///< the part of the largest area
};

LooseParts findLooseParts(const WedgeMesh& mesh);

}  // namespace jalousie::bake
