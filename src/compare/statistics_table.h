// Keys of a frame's counts in JSON and CSV files.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "core/check.h"
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
    {"faces_tested", &render::FrameStatistics::facesTested},
    {"faces_culled", &render::FrameStatistics::facesCulled},
    {"faces_whole", &render::FrameStatistics::facesWhole},
    {"triangles_full", &render::FrameStatistics::trianglesFinest},
    {"queries", &render::FrameStatistics::queries},
    {"query_boxes", &render::FrameStatistics::queryBoxes},
    {"query_waits", &render::FrameStatistics::queryWaits},
    {"query_round_trips", &render::FrameStatistics::queryRoundTrips},
    {"query_switches", &render::FrameStatistics::querySwitches},
    {"slices", &render::FrameStatistics::slices},
    {"shadows", &render::FrameStatistics::shadows},
    {"rooms", &render::FrameStatistics::rooms},
    {"portals", &render::FrameStatistics::portals},
    {"nodes_visited", &render::FrameStatistics::nodesVisited},
    {"plane_tests", &render::FrameStatistics::planeTests},
    {"query_decision_ns", &render::FrameStatistics::decisionNs},
};

/// Counts of one technique, as a summary and frames.csv show them.
struct CountGroup {
  const char* name;                               ///< of the object in the summary
  std::uint64_t render::FrameStatistics::*leads;  ///< the technique was used where one of both is not 0
  std::uint64_t render::FrameStatistics::*orLeads;
  std::span<const char* const> keys;
};

inline constexpr const char* kQueryCounts[] = {"queries",           "query_boxes",    "query_waits",
                                               "query_round_trips", "query_switches", "slices",
                                               "nodes_visited",     "plane_tests",    "query_decision_ns"};
inline constexpr const char* kFaceCounts[] = {"faces_tested", "faces_culled", "faces_whole"};

inline constexpr CountGroup kCountGroups[] = {
    {"queries", &render::FrameStatistics::queries, &render::FrameStatistics::queries, kQueryCounts},
    {"faces", &render::FrameStatistics::facesTested, &render::FrameStatistics::facesWhole, kFaceCounts},
};

/// @pre the key is in the table (checked)
inline const StatisticsField& statisticsField(std::string_view key) {
  for (const StatisticsField& field : kStatisticsFields)
    if (field.key == key) return field;
  JAL_CHECK(key == "a key of the table");
  return kStatisticsFields[0];
}

}  // namespace jalousie::compare
