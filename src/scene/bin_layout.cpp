// Lays out tiles and bins in one pass over the chains and their objects.
#include "scene/bin_layout.h"

#include <algorithm>
#include <limits>

#include "core/check.h"
#include "core/error.h"

namespace jalousie::scene {
namespace {

/// Entries are numbered with 32 bits; the kernels round their number up to a whole block.
constexpr std::uint64_t kMaxEntries = std::numeric_limits<gpu::uint>::max() - gpu::kScanBlock;

/// Cuts a chain's run of objects into tiles.
void addTiles(BinLayout& layout, gpu::Chain& chain, gpu::uint chainIndex, gpu::uint first, gpu::uint end) {
  chain.tileCount = 0;
  for (gpu::uint object = first; object < end; object += gpu::kObjectGroupSize)
    layout.tiles.push_back({object, std::min(gpu::kObjectGroupSize, end - object), chainIndex, chain.tileCount++});
}

}  // namespace

BinLayout layoutBins(std::span<gpu::Chain> chains, std::span<const gpu::Object> objects, std::span<const gpu::Lod> lods,
                     bool patches) {
  BinLayout layout;
  std::uint64_t entries = 0;
  gpu::uint first = 0;
  for (gpu::uint c = 0; c < chains.size(); ++c) {
    gpu::Chain& chain = chains[c];
    gpu::uint end = first;
    while (end < objects.size() && objects[end].chain == c)
      ++end;
    addTiles(layout, chain, c, first, end);
    first = end;
    chain.binCount = 2 * std::max<gpu::uint>(chain.lodCount, patches ? 2 : 1);
    chain.firstEntry = static_cast<gpu::uint>(entries);
    entries += std::uint64_t{chain.binCount} * chain.tileCount;
    if (entries > kMaxEntries)
      throw Error(ErrorCode::kLimit,
                  "the scene has more combinations of chain, level and tile of objects than 32-bit indices reach");
    if (chain.tileCount == 0) continue;  // nothing uses the chain: no command can come from it
    for (gpu::uint bin = 0; bin < chain.binCount; ++bin)
      if (patches || lods[chain.firstLod + bin / 2].triangleCount > 0) layout.bins.push_back({c, bin});
  }
  JAL_CHECK(first == objects.size());
  layout.entryCount = static_cast<std::uint32_t>(entries) + 1;
  return layout;
}

}  // namespace jalousie::scene
