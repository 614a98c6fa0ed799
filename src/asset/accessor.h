// Checked reading of glTF accessors into plain vectors, and appending of vectors as accessors.
#pragma once

#include <tiny_gltf.h>

#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <span>
#include <vector>

namespace jalousie::asset {

// Readers. Any component type that glTF 2.0 or KHR_mesh_quantization allows; normalised integers become floats; sparse
// blocks are applied; accessors without a view are zeros. Every address is checked against the buffer before it is
// read. Errors: kMalformed (range, type), kLimit (more than maxElements elements).

std::vector<float> readScalars(const tinygltf::Model& model, int accessor, std::uint64_t maxElements);
std::vector<glm::vec2> readVec2(const tinygltf::Model& model, int accessor, std::uint64_t maxElements);
std::vector<glm::vec3> readVec3(const tinygltf::Model& model, int accessor, std::uint64_t maxElements);
/// VEC4, or VEC3 with 1 as the fourth component (COLOR_0 may be either).
std::vector<glm::vec4> readVec4(const tinygltf::Model& model, int accessor, std::uint64_t maxElements);
/// Rotations as (x, y, z, w), each normalised; a zero quaternion is kMalformed.
std::vector<glm::quat> readQuaternions(const tinygltf::Model& model, int accessor, std::uint64_t maxElements);
/// Calls a function for every component that the file holds of an accessor of any type: those of its view, then those
/// that replace some of them. Padding of small matrices is left out, and so are zeros that no byte stands for.
/// Allocates nothing.
void visitComponents(const tinygltf::Model& model, int accessor, const std::function<void(float)>& visit);
/// visitComponents for whether all are finite.
bool holdsFiniteNumbers(const tinygltf::Model& model, int accessor);
/// Unsigned indices, each below vertexCount (checked).
std::vector<std::uint32_t> readIndices(const tinygltf::Model& model, int accessor, std::uint32_t vertexCount,
                                       std::uint64_t maxElements);

/// A model with one accessor, number 0: some elements of another one, of the same type, without a sparse block. Costs
/// follow the number of elements, except for sparse accessors. Errors: kMalformed (an element out of range), kLimit.
tinygltf::Model extractElements(const tinygltf::Model& model, int accessor, std::span<const std::uint32_t> elements,
                                std::uint64_t maxElements);

// Writers. Data goes to the end of buffer 0 (made if absent), four-byte aligned, one buffer view per accessor.
// @param target  bufferView.target: TINYGLTF_TARGET_ARRAY_BUFFER, TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER or 0 (none)
// @return        the new accessor's index

/// Appends bytes as they are, at a multiple of four. @param stride  bufferView.byteStride; 0: none
/// @return  the new buffer view's index
int appendView(tinygltf::Model& model, std::span<const std::byte> bytes, int target, std::size_t stride = 0);
int appendScalars(tinygltf::Model& model, std::span<const float> values, int target);
int appendVec2(tinygltf::Model& model, std::span<const glm::vec2> values, int target);
/// With min and max, which glTF requires for POSITION.
int appendVec3(tinygltf::Model& model, std::span<const glm::vec3> values, int target);
int appendVec4(tinygltf::Model& model, std::span<const glm::vec4> values, int target);
int appendQuaternions(tinygltf::Model& model, std::span<const glm::quat> values, int target);
/// 16 bits if every value is below 65535 (glTF forbids the restart index), else 32.
int appendIndices(tinygltf::Model& model, std::span<const std::uint32_t> values);

}  // namespace jalousie::asset
