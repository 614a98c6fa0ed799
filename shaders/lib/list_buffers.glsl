// Buffer blocks of the kernels that build a draw list.

layout(std140, binding = kBindingCullView) uniform CullViewBlock { CullView cullView; };
#include "lib/traits.glsl"
layout(std140, binding = kBindingListView) uniform ListViewBlock { ListView listView; };
layout(std430, binding = kBindingChains) readonly buffer ChainBlock { Chain chains[]; };
layout(std430, binding = kBindingLods) readonly buffer LodBlock { Lod lods[]; };
/// Counts per (chain, bin, tile) before the prefix sum, offsets inside their block of kScanBlock after it.
layout(std430, binding = kBindingEntries) buffer EntryBlock { uint entries[]; };

uint entryIndex(Chain chain, uint bin, uint tileOfChain) {
  return chain.firstEntry + bin * chain.tileCount + tileOfChain;
}
