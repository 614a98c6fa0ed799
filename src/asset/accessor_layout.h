// Sizes of accessor elements and the overflow-safe range checks that readers and the validator share.
#pragma once

#include <tiny_gltf.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace jalousie::asset::detail {

/// Bytes of one component; 0 for anything glTF 2.0 does not allow in an accessor (INT and DOUBLE included).
std::uint32_t componentBytes(int componentType);
/// Components of one element: 1 to 16; 0 for an unknown type.
std::uint32_t componentCount(int type);
/// Bytes of one element, with the padding glTF puts behind the columns of small matrices; 0 if either is unknown.
std::uint32_t elementBytes(int type, int componentType);

/// Where the elements of an accessor lie: element i starts at data + i * stride. `data` is null for an accessor without
/// a view, whose elements are zeros.
struct Elements {
  const std::byte* data = nullptr;
  std::uint64_t stride = 0;
  std::uint64_t count = 0;
};

/// The bytes of a buffer view. Errors: kMalformed (index or range).
std::span<const std::byte> viewBytes(const tinygltf::Model& model, int view);
/// Whether count elements of elementSize bytes, stride apart, starting at offset, lie within `available` bytes.
bool fits(std::uint64_t available, std::uint64_t offset, std::uint64_t stride, std::uint64_t elementSize,
          std::uint64_t count);

/// Elements of an accessor without its sparse block. Errors: kMalformed, kLimit (more than maxElements).
Elements baseElements(const tinygltf::Model& model, int accessor, std::uint64_t maxElements);
/// Indices and values of an accessor's sparse block, checked against their views. Errors: kMalformed.
struct SparseElements {
  Elements indices;
  Elements values;
};
SparseElements sparseElements(const tinygltf::Model& model, int accessor);

/// Throws kMalformed unless 0 <= index < size. @param what  "node 3: mesh", for the message
void requireIndex(int index, std::size_t size, const std::string& what);

}  // namespace jalousie::asset::detail
