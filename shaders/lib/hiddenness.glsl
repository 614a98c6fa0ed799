// Measures of how occluded an object behind a block of the occlusion map or depth pyramid is.
// CPU twin: src/visibility/hiddenness.cpp. Include lib/dct.glsl and lib/traits.glsl before.

/// Mean open chord of a block without any difference and with something open: infinity.
const float kEndlessChord = uintBitsToFloat(0x7f800000u);

/// Sums over a block of opacities.
struct BlockSums {
  float covered;      // sum of the opacities
  float differences;  // absolute differences of neighbouring texels along rows and columns; only for the chord
  float low[3][3];    // sums of f cos(u) cos(v) with f = opacity - 1/2, [v][u]; for all measures but the chord
  uint width;         // texels
  uint height;
};

/// The thesis' measure is a level of visibility itself, normalised, about [-1.83, 1].
float thesisLv(BlockSums s) {
  bool spectrum = max(s.width, s.height) >= kMinSpectrumSide;
  return levelOfVisibility(vec4(s.low[0][0], spectrum ? s.low[0][1] : 0.0, spectrum ? s.low[1][0] : 0.0,
                                spectrum ? s.low[1][1] : 0.0),
                           s.width * s.height);
}

/// phi = 1 - E_low / E: how finely divided the open area is.
float spectralFineness(BlockSums s) {
  float area = float(s.width * s.height);
  float open = 1.0 - s.covered / area;
  float variance = open * (1.0 - open);
  if (variance <= 1e-6) return 0.0;
  float energy = 0.0;
  for (uint v = 0u; v < 3u; ++v) {
    for (uint u = 0u; u < 3u; ++u) {
      if (u + v == 0u || u >= s.width || v >= s.height) continue;
      // a(u,N)^2 a(v,M)^2 / (NM): a factor 2 per nonzero frequency, over (NM)^2.
      energy += (u > 0u ? 2.0 : 1.0) * (v > 0u ? 2.0 : 1.0) * s.low[v][u] * s.low[v][u];
    }
  }
  return clamp(1.0 - energy / (area * area) / variance, 0.0, 1.0);
}

/// Mean length of the open runs along rows and columns, texels: 0 if all is covered, kEndlessChord where no
/// neighbours differ and something is open.
float meanOpenChord(BlockSums s) {
  float open = 1.0 - s.covered / float(s.width * s.height);
  uint pairs = (s.width - 1u) * s.height + s.width * (s.height - 1u);
  if (s.differences <= 0.0 || pairs == 0u) return open > 0.0 ? kEndlessChord : 0.0;
  return 2.0 * open * float(pairs) / s.differences;
}

/// lv of a block that is neither covered nor open.
float blockLv(BlockSums s, float texelPixels) {
  if (hasTrait(kTraitLvThesis)) return thesisLv(s);
  float covered = s.covered / float(s.width * s.height);
  float h = 0.0;
  if (hasTrait(kTraitLvCoverage | kTraitLvPixels)) h = covered;  // pixels: until the first count
  if (hasTrait(kTraitLvSpectral)) h = covered * spectralFineness(s);
  if (hasTrait(kTraitLvChord)) h = covered / (1.0 + meanOpenChord(s) * texelPixels / kChordPixels);
  return 2.0 * h - 1.0;
}
