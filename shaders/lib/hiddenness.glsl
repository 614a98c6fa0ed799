// Measures of hiddenness of one block. CPU twin: src/visibility/hiddenness.cpp
// Include lib/dct.glsl before.

/// Sums over a block of opacities, row by row; which of them count depends on the measure.
struct BlockSums {
  float covered;                   // sum of the opacities
  float low[3][3];                 // sums of f cos(u) cos(v), f = opacity - 1/2, [v][u]
  float differences;               // of neighbouring texels, along rows and columns
  uint width;
  uint height;
};

/// The thesis' measure is a level of visibility itself, normalised, about [-1.83, 1].
float thesisLv(BlockSums s) {
  bool spectrum = max(s.width, s.height) >= kMinSpectrumSide;
  return levelOfVisibility(s.low[0][0], spectrum ? s.low[0][1] : 0.0, spectrum ? s.low[1][0] : 0.0,
                           spectrum ? s.low[1][1] : 0.0, s.width, s.height);
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

/// Mean length of the open runs along rows and columns, texels; kEndlessChord where nothing differs and something is
/// open. @param covered  sum of the opacities   @param differences  of neighbouring texels
const float kEndlessChord = 32768.0;
float meanOpenChord(float covered, float differences, uint width, uint height) {
  float open = 1.0 - covered / float(width * height);
  uint pairs = (width - 1u) * height + width * (height - 1u);
  if (differences <= 0.0 || pairs == 0u) return open > 0.0 ? kEndlessChord : 0.0;
  return 2.0 * open * float(pairs) / differences;
}

/// Covered share, halved where the mean open chord is kChordPixels long.
float chordHiddenness(BlockSums s, float texelPixels) {
  float area = float(s.width * s.height);
  float covered = s.covered / area;
  uint pairs = (s.width - 1u) * s.height + s.width * (s.height - 1u);
  if (s.differences <= 0.0 || pairs == 0u) return covered >= 1.0 ? 1.0 : 0.0;
  float chord = 2.0 * (1.0 - covered) * float(pairs) / s.differences;
  return covered / (1.0 + chord * texelPixels / kChordPixels);
}

/// lv of a block that is neither hidden nor open.
float blockLv(BlockSums s, float texelPixels) {
  float covered = s.covered / float(s.width * s.height);
  if (hasTrait(kTraitLvThesis)) return thesisLv(s);
  float h = hasTrait(kTraitLvSpectral)                  ? covered * spectralFineness(s)
            : hasTrait(kTraitLvChord)                   ? chordHiddenness(s, texelPixels)
            : hasTrait(kTraitLvCoverage | kTraitLvPixels) ? covered  // pixels: not counted yet
                                                          : 0.0;
  return 2.0 * h - 1.0;
}
