// Small procedural scenes for tests.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

#include "asset/face_groups.h"
#include "asset/scene_file.h"
#include "core/random.h"

namespace jalousie::test {

/// Closed UV sphere of radius 1 with 2 * segments * (rings - 1) triangles, outward counter-clockwise.
asset::Primitive sphere(std::uint32_t segments, std::uint32_t rings, std::uint32_t material = 0);

/// Closed box [-halfExtent, halfExtent] with flat normals, 12 triangles.
asset::Primitive box(const glm::vec3& halfExtent, std::uint32_t material = 0);

/// Wall in the plane z = 0, [-1, 1]^2, facing +z, whose cells (cells x cells) are open with the given share (seeded).
asset::Primitive perforatedWall(std::uint32_t cells, float openShare, Random& random, std::uint32_t material = 0);

/// Puts the triangles of a primitive in the order of groups of back faces, as the baker does without cells.
void groupFaces(asset::Primitive& primitive, asset::FaceGrouping grouping);

/// The same for all meshes of a file.
void groupFaces(asset::SceneFile& file, asset::FaceGrouping grouping);

/// File with one default material and one chain of spheres, `levels` of them, each with a quarter of the triangles, its
/// error, and its least share of the screen.
asset::SceneFile sphereChain(std::uint32_t levels);

/// A sphere as ASCII PLY, without normals.
std::string spherePly(std::uint32_t segments, std::uint32_t rings);

/// Adds an instance with translation, uniform or other scale, and a rotation about an axis.
void addInstance(asset::SceneFile& file, std::uint32_t chain, const glm::vec3& translation, const glm::vec3& scale,
                 float angle = 0.0F, const glm::vec3& axis = {0.0F, 1.0F, 0.0F});

/// `count` spheres of random size and place in a cube of the given half side, some mirrored, some flattened.
asset::SceneFile randomSpheres(std::uint32_t count, float halfSide, std::uint64_t seed);

}  // namespace jalousie::test
