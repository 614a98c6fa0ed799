// Lengths as percentages of a mesh's diagonal.
#pragma once

#include <fmt/format.h>

#include <string>

#include "asset/lod_chain.h"

namespace jalousie::bake {

/// `length` as % of `diagonal`, both in one unit; 0 if there is no diagonal.
inline double percentOf(double diagonal, double length) {
  return diagonal > 0.0 ? 100.0 * length / diagonal : 0.0;
}

/// The error that a level was asked to have, nine characters wide; '-' if none was.
inline std::string targetText(const asset::LodMeasures& measures) {
  return measures.target ? fmt::format("{:>9.4f}", percentOf(measures.diagonal, *measures.target))
                         : fmt::format("{:>9}", "-");
}

}  // namespace jalousie::bake
