// Exercises the readers with one file: reads it, uses the result and checks invariants. A jalousie::Error is a valid
// result; any other failure aborts.
#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace jalousie::test {

/// A GLB or glTF file through loading, the runtime's scene reader, and encoding; what was encoded must load again.
void exerciseGltf(std::span<const std::byte> bytes);
/// A GLB file put together from JSON and binary, split at the first zero byte, so that lengths are right.
void exerciseAssembledGlb(std::span<const std::byte> bytes);
/// A picture through its three doors, which must agree; what was decoded must survive encoding.
void exerciseImage(std::span<const std::byte> bytes);
void exercisePly(std::span<const std::byte> bytes);
/// An STL file, binary or ASCII.
void exerciseStl(std::span<const std::byte> bytes);
/// An OBJ file; what follows a line "%%" is the material file, whatever its name.
void exerciseObj(std::span<const std::byte> bytes);
/// The whole bake. The first byte picks the kind of mesh (PLY, OBJ, assembled GLB, or triangles made of the bytes
/// themselves), the next two the options.
void exerciseBake(std::span<const std::byte> bytes);

/// The whole bake of a file, if it is small, with quick options. @param name  decides which reader it gets
void exerciseWholeBake(std::span<const std::byte> bytes, const std::string& name);

}  // namespace jalousie::test
