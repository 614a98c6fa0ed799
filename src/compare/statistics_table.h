// Keys of a frame's counts in JSON and CSV files.
#pragma once

#include <cstdint>

#include "render/frame_statistics.h"

namespace jalousie::compare {

struct StatisticsField {
  const char* key;
  std::uint64_t render::FrameStatistics::*value;
};

/// All counts of a frame but its level histogram, in the order of `jalousie render --json`.
inline constexpr StatisticsField kStatisticsFields[] = {
    {"objects", &render::FrameStatistics::objects},
    {"culled_frustum", &render::FrameStatistics::culledFrustum},
    {"occluders", &render::FrameStatistics::occluders},
    {"culled_occlusion", &render::FrameStatistics::culledOcclusion},
    {"culled_small", &render::FrameStatistics::culledSmall},
    {"drawn", &render::FrameStatistics::drawn},
    {"drawn_early", &render::FrameStatistics::drawnEarly},
    {"drawn_stale", &render::FrameStatistics::drawnStale},
    {"switches", &render::FrameStatistics::switches},
    {"fading", &render::FrameStatistics::fading},
    {"dropped", &render::FrameStatistics::dropped},
    {"cells", &render::FrameStatistics::cells},
    {"cells_drawn", &render::FrameStatistics::cellsDrawn},
    {"draws", &render::FrameStatistics::draws},
    {"triangles", &render::FrameStatistics::triangles},
    {"triangles_full", &render::FrameStatistics::trianglesFinest},
    {"queries", &render::FrameStatistics::queries},
    {"query_boxes", &render::FrameStatistics::queryBoxes},
    {"query_waits", &render::FrameStatistics::queryWaits},
    {"query_round_trips", &render::FrameStatistics::queryRoundTrips},
    {"query_switches", &render::FrameStatistics::querySwitches},
    {"slices", &render::FrameStatistics::slices},
    {"nodes_visited", &render::FrameStatistics::nodesVisited},
    {"plane_tests", &render::FrameStatistics::planeTests},
};

}  // namespace jalousie::compare
