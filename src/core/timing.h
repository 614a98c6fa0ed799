// How the passes of a frame are timed, and one pass' time: plain values.
#pragma once

#include <string_view>

namespace jalousie {

/// How passes are timed.
enum class Timing {
  kOff,   ///< not timed; only the debug groups are opened
  kWall,  ///< wall time between glFinish calls around each pass: right on a software renderer, too
  kGpu,   ///< timestamps on the GPU; passes overlap as they do without a timer
};

/// Time of one pass.
struct PassTime {
  std::string_view name;  ///< a string literal
  double ms = 0.0;
};

}  // namespace jalousie
