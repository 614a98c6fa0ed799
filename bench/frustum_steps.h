// What the steps of frustum culling over a hierarchy save: plane tests per object.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "support/culling.h"

namespace jalousie::bench {

/// Prints a table of plane tests per object over the frames of a journey, and checks that all combinations of steps
/// agree with the flat test.
void measureFrustumSteps(const test::Journey& journey, float aspect, std::uint32_t frames,
                         nlohmann::ordered_json& figures);

}  // namespace jalousie::bench
