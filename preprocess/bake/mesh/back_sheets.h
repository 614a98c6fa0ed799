// Separates faces that lie back to back on the same vertices.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace jalousie::bake {

/// Surfaces that are modelled from both sides have each triangle twice, in both windings. Welded, all their edges would
/// be non-manifold and their borders would look like folds. Where every triangle of a connected patch has such a twin,
/// the patch consists of two sheets.
/// @param vertices  welded, of each corner, in threes
/// @return  for each triangle 1 if it lies in the second sheet of a patch; empty if there is no such patch
std::vector<std::uint8_t> findBackSheets(std::span<const std::uint32_t> vertices);

}  // namespace jalousie::bake
