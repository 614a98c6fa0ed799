// Copies field by field, because the simplification does not know the baked format.
#include "bake/io/lod_measures.h"

namespace jalousie::bake {
namespace {

asset::DistanceInfo infoOf(const Distances& distances) {
  return {distances.max, distances.mean};
}

asset::SpreadInfo infoOf(const Spread& spread) {
  return {spread.mean, spread.p95};
}

}  // namespace

asset::LodMeasures lodMeasures(const Deviation& deviation) {
  asset::LodMeasures measures;
  measures.toOriginal = infoOf(deviation.toOriginal);
  measures.fromOriginal = infoOf(deviation.fromOriginal);
  measures.twoSided = infoOf(deviation.twoSided);
  measures.normalDegrees = infoOf(deviation.normalDegrees);
  measures.uv = infoOf(deviation.uv);
  return measures;
}

}  // namespace jalousie::bake
