// The four coefficients of the 2D DCT-II that the level of visibility needs (thesis Eq. 3.2, 3.3).
// CPU twin: src/visibility/level_of_visibility.cpp

/// Level of visibility of a block, divided by (P/2) sqrt(NM) for values in [-P/2, P/2] with P = 1: +1 for a covered
/// block, -1 for an open one, never below -1.83 (docs/level_of_visibility.md).
/// @param sums  x: sum of f; y, z, w: sums of f times the cosine along x, along y, and along both   @param area  N M
float levelOfVisibility(vec4 sums, uint area) {
  const float kRoot2 = 1.41421356237;
  // a(0,N) a(0,M) = 1/sqrt(NM); each nonzero frequency adds a factor sqrt(2); normalising divides by sqrt(NM)/2.
  float scale = 2.0 / float(area);
  return scale * (sums.x - (kRoot2 * abs(sums.y) + kRoot2 * abs(sums.z) + 2.0 * abs(sums.w)));
}
