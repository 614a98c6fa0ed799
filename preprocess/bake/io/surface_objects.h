// Turns the polygons of a mesh file into triangles, by object and material.
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "bake/io/polygon_mesh.h"
#include "bake/mesh/triangle_mesh.h"

namespace jalousie::bake {

/// The triangles of one object with one material. Normals are empty if there are none.
struct SurfacePart {
  int material = -1;
  TriangleMesh mesh;
};

struct SurfaceObject {
  std::string name;
  glm::dvec3 offset{0.0};  ///< to add to all positions
  std::vector<SurfacePart> parts;
};

/// Triangulates the faces and collects them by object and material; objects without faces are left out. Objects that
/// are far from the origin for their size get an offset, so that single precision is exact enough for them.
/// @pre the indices are in range
std::vector<SurfaceObject> buildObjects(const PolygonMesh& mesh, NormalRule rule);

}  // namespace jalousie::bake
