// Parameters of the methods that know their occluders before the frame.
#pragma once

#include <cstdint>

namespace jalousie::culling {

/// Most occluders in use at a time: a mask has a bit for each.
inline constexpr std::uint32_t kMostActive = 32;

/// What closes the shadow of a solid towards the eye.
enum class Cap : std::uint8_t {
  kExact,  ///< the planes of all front faces
  kPaper,  ///< one plane behind the silhouette: smaller, and cheaper to test
};

/// By what occluders are chosen.
enum class Rank : std::uint8_t {
  kSolidAngle,  ///< the part of the sphere of directions that they cover
  kPaper,       ///< the published measures, which depend on the unit of length
};

/// Which rooms are seen through portals.
enum class PortalReach : std::uint8_t {
  kAll,         ///< every room that is behind a row of portals
  kNeighbours,  ///< direct neighbours alone, as printed in lectures: loses what is seen through two portals
};

/// No option but portalReach changes the picture, only how much is culled and how long it takes.
struct OccluderOptions {
  std::uint32_t active = 15;    ///< occluders in use at a time
  std::uint32_t rankEvery = 1;  ///< frames from one choice to the next; at least 1
  Cap cap = Cap::kExact;
  Rank rank = Rank::kSolidAngle;
  PortalReach portalReach = PortalReach::kAll;
};

}  // namespace jalousie::culling
