// Reads what was baked before it is written.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

namespace jalousie::bake {

/// Reads an encoded document as inspect and the renderer do, with their limits; images are not decoded.
/// @param file  the document's name. Errors: those of the readers. They mean that the input is broken in a way that no
/// earlier check found.
void requireReadable(std::span<const std::byte> glb, const std::filesystem::path& file);

}  // namespace jalousie::bake
