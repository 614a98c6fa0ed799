// Pyramid addressing of the overlap test (thesis 3.4, Eq. 3.1). Texel (x, y) of level L stands for exactly the pixels
// [x << L, (x + 1) << L), [y << L, (y + 1) << L), clipped to the screen.  CPU twin:
// src/visibility/overlap_reference.cpp

/// Smallest level whose texels are at least `extent` pixels wide: ceil(log2(extent)), exact, 0 below one pixel.
uint levelForExtent(float extent) {
  uint level = 0u;
  while (level < 31u && float(1u << level) < extent) ++level;
  return level;
}

/// Pixels a clipped rectangle touches: first.xy, last.xy inclusive; never empty.
uvec4 touchedPixels(vec4 rect, uvec2 viewport) {
  uvec2 first = min(uvec2(floor(rect.xy)), viewport - 1u);
  uvec2 end = min(uvec2(ceil(rect.zw)), viewport);
  return uvec4(first, max(end, first + 1u) - 1u);
}

/// Number of screen pixels that a texel of a level stands for.
uint texelArea(uvec2 texel, uint level, uvec2 viewport) {
  uvec2 size = min((texel + 1u) << level, viewport) - min(texel << level, viewport);
  return size.x * size.y;
}

/// One dimension of the analysed block: first of the texels that [first, last] touches, and their count (at
/// most kMaxBlockSide).
/// A misaligned span can touch 17: the end that the rectangle covers less is left out.
uvec2 blockSpan(uint firstPixel, uint lastPixel, float lower, float upper, uint level) {
  uint first = firstPixel >> level;
  uint count = (lastPixel >> level) - first + 1u;
  if (count > kMaxBlockSide) {
    float size = float(1u << level);
    float coveredFirst = float(first + 1u) * size - lower;
    float coveredLast = upper - float(first + count - 1u) * size;
    if (coveredFirst < coveredLast) ++first;
    count = kMaxBlockSide;
  }
  return uvec2(first, count);
}
