// What is drawn before the occlusion test. Include the block of CullView before.
// CPU twin: src/visibility/classify_reference.cpp

/// Two phases: whether an object or a cell is drawn before the test. What was tested in the last frame is expected to
/// keep its visibility; of the others, those with a large rectangle (kLargeShare) are expected to be visible.
bool isExpectedVisible(uint lastMarks, vec4 rect) {
  if ((lastMarks & kMarkTested) != 0u) return (lastMarks & kMarkVisible) != 0u;
  vec2 size = rect.zw - rect.xy;
  return size.x * size.y >= kLargeShare * float(cullView.viewportWidth * cullView.viewportHeight);
}
