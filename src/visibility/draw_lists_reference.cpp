// Sorts by bin, stable; the GPU reaches the same order with counts and prefix sums.
#include "visibility/draw_lists_reference.h"

#include <algorithm>

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
Ranges rangesOf(const scene::SceneData& scene, const gpu::Chain& chain, gpu::uint bin, gpu::uint detail) {
  const gpu::uint level = bin / 2;
  const bool mirrored = bin % 2 == 1;
  const bool patches = detail == gpu::kDetailTessellation;
  const gpu::Lod& lod = scene.lods[patches ? chain.patchLod : chain.firstLod + level];
  Ranges ranges;
  ranges.firstList = patches && level > 0 ? gpu::kListSolidPatch : gpu::kListSolid;
  ranges.baseVertex = lod.baseVertex;
  ranges.firstIndex = {lod.firstIndex, lod.firstIndex + (mirrored ? 0 : lod.solidCount),
                       lod.firstIndex + lod.solidCount + lod.sheetCount};
  ranges.count = {mirrored ? 0 : lod.solidCount, lod.sheetCount + (mirrored ? lod.solidCount : 0), lod.blendCount};
  return ranges;
}

gpu::uint binOf(const scene::SceneData& scene, const gpu::CullView& view, const gpu::ObjectState& state,
                const gpu::ScreenBox& box, gpu::uint marks, const gpu::Chain& chain, gpu::uint phase) {
  gpu::uint level = state.lod;
  if (view.detail == gpu::kDetailTessellation) {
    level = state.tessellation > 1 ? 1 : 0;
  } else if (phase == gpu::kMarkEarly && view.cullMode != gpu::kCullHiz) {
    level = pixelErrorLod(std::span(scene.lods).subspan(chain.firstLod, chain.lodCount), box.pixelsPerUnit,
                          view.occluderTau);
  }
  return 2 * level + ((marks & gpu::kMarkMirrored) != 0 ? 1 : 0);
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
    gpu::uint object, chain, bin;
  };
  std::vector<Entry> entries;
  for (gpu::uint i = 0; i < scene.objects.size(); ++i) {
    if ((marks[i] & phase) == 0) continue;
    const gpu::uint chain = scene.objects[i].chain;
    entries.push_back({i, chain, binOf(scene, view, states[i], boxes[i], marks[i], scene.chains[chain], phase)});
  }
  std::stable_sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
    return a.chain != b.chain ? a.chain < b.chain : a.bin < b.bin;
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
    const Ranges ranges = rangesOf(scene, scene.chains[entry.chain], entry.bin, view.detail);
    const bool perObject = submission == Submission::kPerObject;
    addCommands(lists, ranges, static_cast<gpu::uint>(i), static_cast<gpu::uint>(end - i), perObject);
    if (perObject) addNothing(lists, ranges, view.detail == gpu::kDetailTessellation);
    for (; i < end; ++i)
      lists.instances.push_back(entries[i].object);
  }
  return lists;
}

}  // namespace jalousie::visibility
