// LV -> detail -> draw commands, one object at a time (thesis 4.1.1, 4.1.3).
#include "visibility/commands_reference.h"

#include "visibility/lod_policy.h"

namespace jalousie::visibility {
namespace {

using Commands = std::array<gpu::DrawCommand, gpu::kListCount>;

gpu::DrawCommand command(gpu::uint count, gpu::uint firstIndex, int baseVertex, gpu::uint object) {
  return {count, count > 0 ? 1U : 0U, firstIndex, baseVertex, object};
}

void addRange(Commands& commands, gpu::uint solidList, const gpu::Lod& lod, bool mirrored, bool drawn,
              gpu::uint object) {
  const gpu::uint solid = drawn && !mirrored ? lod.solidCount : 0;
  const gpu::uint sheet = drawn ? lod.sheetCount + (mirrored ? lod.solidCount : 0) : 0;
  commands[solidList] = command(solid, lod.firstIndex, lod.baseVertex, object);
  commands[solidList + 1] = command(sheet, lod.firstIndex + (mirrored ? 0 : lod.solidCount), lod.baseVertex, object);
}

}  // namespace

gpu::ObjectState chooseDetail(gpu::ObjectState state, const gpu::CullView& view, const gpu::Chain& chain) {
  if (view.lodRule != gpu::kLodLinear || state.verdict != gpu::kVerdictPartial) return state;
  state.lod = linearLod(state.lv, chain.lodCount);
  state.tessellation = tessellationLevel(state.lv, view.maxTessellation);
  return state;
}

Commands objectCommands(const scene::SceneData& scene, const gpu::CullView& view, gpu::uint objectIndex, bool drawn,
                        gpu::uint lod, gpu::uint tessellation) {
  const gpu::Object& object = scene.objects[objectIndex];
  const gpu::Chain& chain = scene.chains[object.chain];
  const bool mirrored = (object.flags & gpu::kObjectMirrored) != 0;
  Commands commands = {};
  if (view.detail == gpu::kDetailDiscrete) {
    addRange(commands, gpu::kListSolid, scene.lods[chain.firstLod + lod], mirrored, drawn, objectIndex);
    return commands;
  }
  const gpu::Lod& base = scene.lods[chain.patchLod];
  addRange(commands, gpu::kListSolid, base, mirrored, drawn && tessellation == 1, objectIndex);
  addRange(commands, gpu::kListSolidPatch, base, mirrored, drawn && tessellation > 1, objectIndex);
  return commands;
}

}  // namespace jalousie::visibility
