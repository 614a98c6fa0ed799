// Sorts by bin, stable; the GPU reaches the same order with counts and prefix sums.
#include "visibility/draw_lists_reference.h"

#include <algorithm>
#include <tuple>

#include "policy/traits.h"
#include "visibility/lod_policy.h"

namespace jalousie::visibility {
namespace {

struct Ranges {
  gpu::uint firstList = gpu::kListSolid;
  std::array<gpu::uint, gpu::kListsPerDetail> firstIndex{};
  std::array<gpu::uint, gpu::kListsPerDetail> count{};
  int baseVertex = 0;
};

/// Solid triangles of a mirrored object would be culled by their winding, so they go to the sheet list.
Ranges rangesOf(const scene::SceneData& scene, const gpu::Chain& chain, gpu::uint bin, gpu::uint traits) {
  const gpu::uint level = bin / 2;
  const bool mirrored = bin % 2 == 1;
  const bool patches = has(traits, gpu::kTraitPatches);
  const gpu::Lod& lod = scene.lods[patches ? chain.patchLod : chain.firstLod + level];
  Ranges ranges;
  ranges.firstList = patches && level > 0 ? gpu::kListSolidPatch : gpu::kListSolid;
  ranges.baseVertex = lod.baseVertex;
  ranges.firstIndex = {lod.firstIndex, lod.firstIndex + (mirrored ? 0 : lod.solidCount),
                       lod.firstIndex + lod.solidCount + lod.sheetCount};
  ranges.count = {mirrored ? 0 : lod.solidCount, lod.sheetCount + (mirrored ? lod.solidCount : 0), lod.blendCount};
  return ranges;
}

bool drawsOcclusionMap(const gpu::CullView& view, gpu::uint phase) {
  return phase == gpu::kMarkEarly && !has(view.traits, gpu::kTraitTwoPhases);
}

bool isFading(const gpu::CullView& view, gpu::uint marks, gpu::uint phase) {
  return fadeFrames(marks) > 0 && !has(view.traits, gpu::kTraitPatches) && !drawsOcclusionMap(view, phase);
}

/// What fades is drawn through the sheet list, where pixels can be left out.
gpu::uint binOf(const scene::SceneData& scene, const gpu::CullView& view, const gpu::ObjectState& state,
                const gpu::ScreenBox& box, gpu::uint marks, const gpu::Chain& chain, gpu::uint phase) {
  gpu::uint level = state.lod;
  if (has(view.traits, gpu::kTraitPatches)) {
    level = state.tessellation > 1 ? 1 : 0;
  } else if (drawsOcclusionMap(view, phase)) {
    level = pixelErrorLod(std::span(scene.lods).subspan(chain.firstLod, chain.lodCount), box.pixelsPerUnit,
                          view.occluderTau);
  }
  return 2 * level + ((marks & gpu::kMarkMirrored) != 0 || isFading(view, marks, phase) ? 1 : 0);
}

void addCommands(DrawLists& lists, const Ranges& ranges, gpu::uint first, gpu::uint instances, bool keepEmpty) {
  for (gpu::uint k = 0; k < gpu::kListsPerDetail; ++k) {
    if (ranges.count[k] == 0 && !keepEmpty) continue;
    lists.commands[ranges.firstList + k].push_back(
        {ranges.count[k], ranges.count[k] > 0 ? instances : 0, ranges.firstIndex[k], ranges.baseVertex, first});
  }
}

/// The commands of the other detail path's lists at this place.
void addNothing(DrawLists& lists, const Ranges& ranges, bool patches) {
  if (!patches) return;
  const gpu::uint other = ranges.firstList == gpu::kListSolid ? gpu::kListSolidPatch : gpu::kListSolid;
  for (gpu::uint k = 0; k < gpu::kListsPerDetail; ++k)
    lists.commands[other + k].push_back({});
}

}  // namespace

DrawLists buildDrawLists(const scene::SceneData& scene, const gpu::CullView& view,
                         std::span<const gpu::ObjectState> states, std::span<const gpu::ScreenBox> boxes,
                         std::span<const gpu::uint> marks, gpu::uint phase, Submission submission,
                         std::uint32_t capacity) {
  struct Entry {
    gpu::uint chain, bin, tile;
    bool goes;  ///< the level that fades out
    gpu::uint value;
  };
  std::vector<Entry> entries;
  for (gpu::uint t = 0; t < scene.binLayout.tiles.size(); ++t) {
    const gpu::Tile& tile = scene.binLayout.tiles[t];
    for (gpu::uint i = tile.firstObject; i < tile.firstObject + tile.objectCount; ++i) {
      if ((marks[i] & phase) == 0) continue;
      const bool fades = isFading(view, marks[i], phase);
      const gpu::uint bin = binOf(scene, view, states[i], boxes[i], marks[i], scene.chains[tile.chain], phase);
      entries.push_back({tile.chain, bin, t, false, fades ? i | gpu::kInstanceFadingIn : i});
      if (fades)
        entries.push_back(
            {tile.chain, 2 * fadingLod(states[i].lod, marks[i]) + 1, t, true, i | gpu::kInstanceFadingOut});
    }
  }
  std::stable_sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
    return std::tie(a.chain, a.bin, a.tile, a.goes) < std::tie(b.chain, b.bin, b.tile, b.goes);
  });
  DrawLists lists;
  const std::size_t kept = std::min<std::size_t>(entries.size(), capacity);
  lists.dropped = static_cast<std::uint32_t>(entries.size() - kept);
  entries.resize(kept);
  for (std::size_t i = 0; i < entries.size();) {
    const Entry& entry = entries[i];
    std::size_t end = i + 1;
    while (submission == Submission::kInstanced && end < entries.size() && entries[end].chain == entry.chain &&
           entries[end].bin == entry.bin)
      ++end;
    const Ranges ranges = rangesOf(scene, scene.chains[entry.chain], entry.bin, view.traits);
    const bool perObject = submission == Submission::kPerObject;
    addCommands(lists, ranges, static_cast<gpu::uint>(i), static_cast<gpu::uint>(end - i), perObject);
    if (perObject) addNothing(lists, ranges, has(view.traits, gpu::kTraitPatches));
    for (; i < end; ++i)
      lists.instances.push_back(entries[i].value);
  }
  return lists;
}

}  // namespace jalousie::visibility
