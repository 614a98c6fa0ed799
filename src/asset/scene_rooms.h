// Rooms and portals of a scene in its extras (docs/formats.md).
//
// On a scene:  extras.jalousie_rooms = {"rooms": [ROOM, ...], "portals": [PORTAL, ...]}
//   ROOM    {"name": s, "floor": y, "ceiling": y, "outline": [[[x, z], ...], ...]}
//   PORTAL  {"rooms": [a, b], "corners": [[x, y, z], ...]}
#pragma once

#include <tiny_gltf.h>

#include "core/room_plan.h"

namespace jalousie::asset {

inline constexpr const char* kRooms = "jalousie_rooms";

/// Writes a plan, keeping other extras. @pre without faults
void setRooms(tinygltf::Scene& scene, const RoomPlan& plan);
/// Reads it back; empty if absent. Errors: kMalformed (wrong types, faultOf).
RoomPlan roomsOf(const tinygltf::Scene& scene);
/// Those of the scene that is drawn.
RoomPlan roomsOf(const tinygltf::Model& model);

}  // namespace jalousie::asset
