// Buffer blocks of the drawing programs.

layout(std140, binding = kBindingDrawView) uniform DrawViewBlock { DrawView drawView; };
layout(std430, binding = kBindingTransforms) readonly buffer TransformBlock { Transform transforms[]; };
layout(std430, binding = kBindingObjects) readonly buffer ObjectBlock { Object objects[]; };
layout(std430, binding = kBindingChains) readonly buffer ChainBlock { Chain chains[]; };
layout(std430, binding = kBindingDrawBoxes) readonly buffer BoxBlock { ScreenBox boxes[]; };
layout(std430, binding = kBindingStates) readonly buffer StateBlock { ObjectState states[]; };
layout(std430, binding = kBindingMarks) readonly buffer MarkBlock { uint marks[]; };
