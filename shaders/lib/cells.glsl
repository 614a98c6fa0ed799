// What the kernels that cull cells share. CPU twin: src/visibility/cell_reference.cpp

layout(std140, binding = kBindingCullView) uniform CullViewBlock { CullView cullView; };
#include "lib/traits.glsl"
layout(std430, binding = kBindingTransforms) readonly buffer TransformBlock { Transform transforms[]; };
layout(std430, binding = kBindingObjects) readonly buffer CellBlock { Object cells[]; };
layout(std430, binding = kBindingChains) readonly buffer ChainBlock { Chain chains[]; };
/// By the levels of the cells' chains.
layout(std430, binding = kBindingCellBounds) readonly buffer BoundsBlock { CellBounds bounds[]; };
/// Of the objects.
layout(std430, binding = kBindingStates) readonly buffer StateBlock { ObjectState states[]; };
layout(std430, binding = kBindingMarks) readonly buffer MarkBlock { uint marks[]; };
/// Of the cells.
layout(std430, binding = kBindingCellStates) writeonly buffer CellStateBlock { ObjectState cellStates[]; };
layout(std430, binding = kBindingCellMarks) buffer CellMarkBlock { uint cellMarks[]; };

/// Bounds of what a cell draws: at its object's level and, in a cross-fade, at the level that fades out.
CellBounds drawnBounds(Object cell, uint lod, uint mark) {
  uint first = chains[cell.chain].firstLod;
  CellBounds drawn = bounds[first + lod];
  if (fadeFrames(mark) > 0u) {
    CellBounds fading = bounds[first + fadingLod(lod, mark)];
    drawn.minObject = min(drawn.minObject, fading.minObject);
    drawn.maxObject = max(drawn.maxObject, fading.maxObject);
  }
  return drawn;
}

bool isEmpty(CellBounds box) { return box.minObject.x > box.maxObject.x; }

BoxOnScreen cellOnScreen(Object cell, CellBounds drawn) {
  return boxOnScreen(transforms[cell.transform], drawn.minObject.xyz, drawn.maxObject.xyz, cullView.clipFromWorld,
                     vec2(cullView.viewportWidth, cullView.viewportHeight));
}

/// Whether any of an object may be drawn.
bool isInView(uint verdict) { return verdict != kVerdictOutside && verdict != kVerdictSmall; }
