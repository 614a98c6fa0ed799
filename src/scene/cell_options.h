// How the chains of a scene are divided into cells.
#pragma once

#include <cstdint>
#include <string>

namespace jalousie::scene {

/// Triangles per cell that kAutomatic divides by.
inline constexpr std::uint32_t kDefaultCellTriangles = 256;
/// kAutomatic makes cells larger where a scene had more than this many.
inline constexpr std::uint64_t kMostAutomaticCells = 65536;
/// Most cells of any scene.
inline constexpr std::uint64_t kMostCells = 1ULL << 22U;

/// A choice of --cells.
struct CellOptions {
  enum class Kind : std::uint32_t {
    kOff,        ///< objects are culled and drawn whole
    kAutomatic,  ///< the cells of the file; else those of large chains. Joined where a scene had too many
    kCount,      ///< all chains anew, at most trianglesPerCell in a cell
  };
  Kind kind = Kind::kOff;
  std::uint32_t trianglesPerCell = kDefaultCellTriangles;

  friend bool operator==(const CellOptions&, const CellOptions&) = default;
};

}  // namespace jalousie::scene
