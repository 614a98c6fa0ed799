// The four coefficients of the 2D DCT-II that the level of visibility needs (thesis Eq. 3.2, 3.3).
// CPU twin: src/visibility/level_of_visibility.cpp

/// Level of visibility of a block, normalised by (P/2) sqrt(NM) with values in [-P/2, P/2], P = 1 (docs/level_of_visibility.md).
///   dc   sum f,  u, v, uv   sums of f against cos along x, along y, along both
/// High means hidden: +1 fully covered, -1 fully open, never below -1.83.
float levelOfVisibility(float dc, float u, float v, float uv, uint width, uint height) {
  const float kRoot2 = 1.41421356237;
  // a(0,N) a(0,M) = 1/sqrt(NM); each nonzero frequency adds a factor sqrt(2); normalising divides by sqrt(NM)/2.
  float scale = 2.0 / float(width * height);
  return scale * (dc - (kRoot2 * abs(u) + kRoot2 * abs(v) + 2.0 * abs(uv)));
}
