// Builds the lists with a stable sort by bin; the GPU reaches the same order with counts and prefix sums.
#include "visibility/draw_lists_reference.h"

#include <algorithm>
#include <tuple>

#include "policy/traits.h"
#include "scene/scene_data.h"
#include "visibility/lod_policy.h"

namespace jalousie::visibility {
namespace {

struct Ranges {
  gpu::uint firstList = gpu::kListSolid;
  std::array<gpu::uint, gpu::kListsPerDetail> firstIndex{};
  std::array<gpu::uint, gpu::kListsPerDetail> count{};
  int baseVertex = 0;
};

/// Solid triangles of a mirrored object go to the sheet list: the solid one would cull them by their winding.
Ranges rangesOf(const scene::DrawTables& scene, const gpu::Chain& chain, gpu::uint bin, bool patches) {
  const gpu::uint level = bin / 2;
  const bool mirrored = bin % 2 == 1;
  const gpu::Lod& lod = scene.lods[patches ? chain.patchLod : chain.firstLod + level];
  Ranges ranges;
  ranges.firstList = patches && level > 0 ? gpu::kListSolidPatch : gpu::kListSolid;
  ranges.baseVertex = lod.baseVertex;
  ranges.firstIndex = {lod.firstIndex, lod.firstIndex + (mirrored ? 0 : lod.solidCount),
                       lod.firstIndex + lod.solidCount + lod.sheetCount};
  ranges.count = {mirrored ? 0 : lod.solidCount, lod.sheetCount + (mirrored ? lod.solidCount : 0), lod.blendCount};
  return ranges;
}

/// One list of a frame.
struct List {
  const scene::DrawTables& scene;
  const gpu::CullView& view;
  gpu::uint phase;
  bool patches;
};

/// The occlusion pass has its own budget; with two phases the first one draws into the frame itself.
bool drawsOcclusionMap(const List& list) {
  return list.phase == gpu::kMarkEarly && !has(list.view.traits, gpu::kTraitTwoPhases);
}

/// An object in a cross-fade is drawn through the sheet list, which can leave out pixels.
bool isFading(const List& list, gpu::uint marks) {
  return fadeFrames(marks) > 0 && !list.patches && !drawsOcclusionMap(list);
}

gpu::uint binOf(const List& list, const ObjectDecision& object) {
  gpu::uint level = object.state.lod;
  if (list.patches) {
    level = object.state.tessellation > 1 ? 1 : 0;
  } else if (drawsOcclusionMap(list)) {
    level = (object.marks & gpu::kMarkMapLodMask) >> gpu::kMarkMapLodShift;
  }
  return 2 * level + ((object.marks & gpu::kMarkMirrored) != 0 || isFading(list, object.marks) ? 1 : 0);
}

/// One instance of the list.
struct Entry {
  gpu::uint chain, bin, tile;
  bool fadesOut;    ///< the second instance of an object in a cross-fade
  gpu::uint value;  ///< of the instance list
};

/// All instances in the order of the list: by chain, bin and tile, and in a tile by object.
std::vector<Entry> sortedEntries(const List& list, const ObjectDecisions& objects) {
  std::vector<Entry> entries;
  for (gpu::uint t = 0; t < list.scene.binLayout.tiles.size(); ++t) {
    const gpu::Tile& tile = list.scene.binLayout.tiles[t];
    for (gpu::uint i = tile.firstObject; i < tile.firstObject + tile.objectCount; ++i) {
      const ObjectDecision object = objects[i];
      if ((object.marks & list.phase) == 0) continue;
      const bool fades = isFading(list, object.marks);
      const gpu::uint bin = binOf(list, object);
      entries.push_back({tile.chain, bin, t, false, fades ? i | gpu::kInstanceFadingIn : i});
      if (!fades) continue;
      const gpu::uint fadingBin = 2 * fadingLod(object.state.lod, object.marks) + 1;
      entries.push_back({tile.chain, fadingBin, t, true, i | gpu::kInstanceFadingOut});
    }
  }
  std::stable_sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
    return std::tie(a.chain, a.bin, a.tile, a.fadesOut) < std::tie(b.chain, b.bin, b.tile, b.fadesOut);
  });
  return entries;
}

void addCommands(DrawLists& lists, const Ranges& ranges, gpu::uint first, gpu::uint instances, bool keepEmpty) {
  for (gpu::uint k = 0; k < gpu::kListsPerDetail; ++k) {
    if (ranges.count[k] == 0 && !keepEmpty) continue;
    lists.commands[ranges.firstList + k].push_back(
        {ranges.count[k], ranges.count[k] > 0 ? instances : 0, ranges.firstIndex[k], ranges.baseVertex, first});
  }
}

/// Empty commands at the same place of the other detail path's lists.
void addNothing(DrawLists& lists, const Ranges& ranges, bool patches) {
  if (!patches) return;
  const gpu::uint other = ranges.firstList == gpu::kListSolid ? gpu::kListSolidPatch : gpu::kListSolid;
  for (gpu::uint k = 0; k < gpu::kListsPerDetail; ++k)
    lists.commands[other + k].push_back({});
}

}  // namespace

DrawLists buildDrawLists(const scene::DrawTables& scene, const gpu::CullView& view, const ObjectDecisions& objects,
                         gpu::uint phase, const DrawListOptions& options) {
  const List list{scene, view, phase, has(view.traits, gpu::kTraitPatches)};
  std::vector<Entry> entries = sortedEntries(list, objects);
  DrawLists lists;
  const std::size_t kept = std::min<std::size_t>(entries.size(), options.capacity);
  entries.resize(kept);
  lists.placed.resize(scene.objects.size());
  for (const Entry& entry : entries)
    lists.placed[entry.value & gpu::kInstanceObject] |= entry.fadesOut ? kPlacedFadingOut : kPlacedOwn;
  const bool perObject = options.submission == Submission::kPerObject;
  for (std::size_t i = 0; i < entries.size();) {
    const Entry& entry = entries[i];
    std::size_t end = i + 1;
    while (!perObject && end < entries.size() && entries[end].chain == entry.chain && entries[end].bin == entry.bin)
      ++end;
    const Ranges ranges = rangesOf(scene, scene.chains[entry.chain], entry.bin, list.patches);
    addCommands(lists, ranges, static_cast<gpu::uint>(i), static_cast<gpu::uint>(end - i), perObject);
    if (perObject) addNothing(lists, ranges, list.patches);
    for (; i < end; ++i)
      lists.instances.push_back(entries[i].value);
  }
  return lists;
}

SliceLists buildSlices(const scene::DrawTables& scene, const gpu::CullView& view, const ObjectDecisions& objects,
                       std::span<const gpu::uint> order, gpu::uint listCount) {
  const List list{scene, view, gpu::kMarkLate, has(view.traits, gpu::kTraitPatches)};
  const std::size_t capacity = 2 * order.size();
  SliceLists slices{std::vector<gpu::uint>(capacity), std::vector<gpu::DrawCommand>(listCount * capacity)};
  const auto write = [&](std::size_t place, const gpu::Chain& chain, gpu::uint bin, gpu::uint instance) {
    const Ranges ranges = rangesOf(scene, chain, bin, list.patches);
    slices.instances[place] = instance;
    for (gpu::uint k = 0; k < gpu::kListsPerDetail; ++k) {
      slices.commands[(ranges.firstList + k) * capacity + place] = {ranges.count[k], ranges.count[k] > 0 ? 1U : 0U,
                                                                    ranges.firstIndex[k], ranges.baseVertex,
                                                                    static_cast<gpu::uint>(place)};
    }
  };
  for (std::size_t place = 0; place < order.size(); ++place) {
    const ObjectDecision object = objects[order[place]];
    if ((object.marks & gpu::kMarkLate) == 0) continue;
    const gpu::Chain& chain = scene.chains[scene.objects[order[place]].chain];
    const bool fades = isFading(list, object.marks);
    write(place, chain, binOf(list, object), fades ? order[place] | gpu::kInstanceFadingIn : order[place]);
    if (!fades) continue;
    write(place + order.size(), chain, 2 * fadingLod(object.state.lod, object.marks) + 1,
          order[place] | gpu::kInstanceFadingOut);
  }
  return slices;
}

}  // namespace jalousie::visibility
