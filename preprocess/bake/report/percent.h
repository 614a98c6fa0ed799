// Lengths as percentages of a mesh's diagonal.
#pragma once

namespace jalousie::bake {

/// `length` as % of `diagonal`, both in one unit; 0 if there is no diagonal.
inline double percentOf(double diagonal, double length) {
  return diagonal > 0.0 ? 100.0 * length / diagonal : 0.0;
}

}  // namespace jalousie::bake
