// Converts measured deviations to the structs of the baked format.
#pragma once

#include "asset/lod_chain.h"
#include "bake/simplify/deviation.h"

namespace jalousie::bake {

/// The distances and spreads of a level. Diagonal, coverage and stop reason keep their defaults.
asset::LodMeasures lodMeasures(const Deviation& deviation);

}  // namespace jalousie::bake
