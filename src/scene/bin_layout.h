// How objects are grouped for instanced drawing: tiles of objects, bins of levels.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "shared/limits.h"
#include "shared/scene_structs.h"

namespace jalousie::scene {

/// Static tables of the kernels that build draw lists.
struct BinLayout {
  std::vector<gpu::Tile> tiles;  ///< in the order of the objects; a tile holds objects of one chain
  std::vector<gpu::Bin> bins;    ///< chain after chain, bin after bin: the order of the commands
  std::uint32_t entryCount = 1;  ///< counts of all (chain, bin, tile), and a zero behind them
};

/// Lays out bins and tiles and fills the chains' binCount, firstEntry and tileCount. @pre objects sorted by chain
/// (checked)
/// A level without triangles has no bins.
/// @param lods     by Chain::firstLod
/// @param patches  the chains have a patch base: at least four bins
/// Errors: kLimit if the counts exceed 32-bit indices. A driver may allow less: DrawListPass checks that.
BinLayout layoutBins(std::span<gpu::Chain> chains, std::span<const gpu::Object> objects, std::span<const gpu::Lod> lods,
                     bool patches);

}  // namespace jalousie::scene
