// Triangles of what the readers of OBJ, PLY and STL return.
#pragma once

#include <gtest/gtest.h>

#include "bake/io/surface_objects.h"
#include "bake/mesh/normals.h"

namespace jalousie::test {

/// The triangles of a mesh with one object and one material.
inline bake::TriangleMesh onlyPart(const bake::PolygonMesh& mesh, bake::NormalRule rule = bake::NormalRule::kNone) {
  const std::vector<bake::SurfaceObject> objects = bake::buildObjects(mesh, rule);
  EXPECT_EQ(objects.size(), 1U);
  if (objects.size() != 1) return {};
  EXPECT_EQ(objects[0].parts.size(), 1U);
  return objects[0].parts[0].mesh;
}

inline double areaOf(const bake::TriangleMesh& mesh) {
  double area = 0.0;
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3)
    area += bake::triangleArea(mesh.positions[mesh.indices[i]], mesh.positions[mesh.indices[i + 1]],
                               mesh.positions[mesh.indices[i + 2]]);
  return area;
}

}  // namespace jalousie::test
