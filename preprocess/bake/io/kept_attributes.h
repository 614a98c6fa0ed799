// Attributes whose values are names or numbers of things: levels take existing values and average none.
#pragma once

#include <tiny_gltf.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "bake/mesh/combined_mesh.h"

namespace jalousie::bake {

/// An attribute whose values must not be averaged.
struct KeptAttribute {
  std::string name;
  int accessor = -1;
};

/// Feature and batch IDs of any type, and all custom attributes of integers that are not normalised.
std::vector<KeptAttribute> keptAttributes(const tinygltf::Model& model, const tinygltf::Primitive& primitive);

/// The bytes of an accessor's elements without gaps. @param vertices  the elements; empty: all
/// Errors: kMalformed, kLimit.
struct PackedElements {
  std::vector<std::byte> bytes;
  std::size_t elementBytes = 0;  ///< a multiple of four: padded
};
PackedElements packedElements(const tinygltf::Model& model, int accessor, const std::vector<std::uint32_t>& vertices,
                              std::uint64_t limit);

/// Appends some elements of an accessor as an accessor of the same type. @return  its index
int appendElements(tinygltf::Model& model, int accessor, const std::vector<std::uint32_t>& elements);

/// Triangles of one primitive with the same values of the kept attributes, or all of them.
struct Region {
  PrimitiveData data;
  std::vector<std::uint32_t> indices;       ///< of its vertices
  std::vector<std::uint32_t> sourceVertex;  ///< [data.vertexCount]
};

/// Divides a primitive by the values of its first corners, so that no collapse crosses the border between two values.
/// If the values differ within many triangles, they are numbers of vertices and not of regions: one region.
/// @param keys   per vertex the number of its set of values   @param whole  the primitive
std::vector<Region> divideByValue(Region whole, const std::vector<std::uint32_t>& keys);

}  // namespace jalousie::bake
