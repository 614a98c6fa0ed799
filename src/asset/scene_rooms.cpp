// Types and counts are checked where they are read; the plan by faultOf().
#include "asset/scene_rooms.h"

#include <fmt/format.h>

#include <optional>
#include <string>
#include <utility>

#include "asset/extras.h"
#include "core/error.h"

namespace jalousie::asset {
namespace {

using tinygltf::Value;

[[noreturn]] void refusePlan(const std::string& what) {
  throw Error(ErrorCode::kMalformed, fmt::format("extras.{}: {}", kRooms, what));
}

const Value::Array& listIn(const Value& object, const char* key, std::size_t most, const std::string& owner) {
  if (!object.IsObject() || !object.Get(key).IsArray()) refusePlan(fmt::format("{} has no list of {}", owner, key));
  const Value::Array& list = object.Get(key).Get<Value::Array>();
  if (list.size() > most) refusePlan(fmt::format("{} has more than {} {}", owner, most, key));
  return list;
}

double numberIn(const Value& value, const std::string& owner) {
  if (!value.IsNumber()) refusePlan(fmt::format("{} has something that is no number", owner));
  return value.GetNumberAsDouble();
}

template <class Vector>
Vector pointIn(const Value& value, const std::string& owner) {
  constexpr int kCount = Vector::length();
  if (!value.IsArray() || value.ArrayLen() != kCount)
    refusePlan(fmt::format("{} has a point without {} numbers", owner, kCount));
  Vector point(0.0);
  for (int axis = 0; axis < kCount; ++axis)
    point[axis] = numberIn(value.Get(axis), owner);
  return point;
}

Room readRoom(const Value& value, const std::string& owner) {
  if (!value.IsObject()) refusePlan(owner + " is not an object");
  Room room;
  if (value.Has("name")) {
    if (!value.Get("name").IsString()) refusePlan(owner + " has a name that is no text");
    room.name = value.Get("name").Get<std::string>();
  }
  room.floor = numberIn(value.Get("floor"), owner);
  room.ceiling = numberIn(value.Get("ceiling"), owner);
  for (const Value& loop : listIn(value, "outline", RoomPlan::kMostLoops, owner)) {
    if (!loop.IsArray() || loop.ArrayLen() > RoomPlan::kMostOutlinePoints)
      refusePlan(owner + " has a loop that is no list of points");
    std::vector<glm::dvec2>& points = room.outline.emplace_back();
    for (const Value& point : loop.Get<Value::Array>())
      points.push_back(pointIn<glm::dvec2>(point, owner));
  }
  return room;
}

Portal readPortal(const Value& value, const std::string& owner) {
  Portal portal;
  const Value::Array& rooms = listIn(value, "rooms", 2, owner);
  if (rooms.size() != 2) refusePlan(owner + " has not two rooms");
  for (std::size_t side = 0; side < 2; ++side) {
    const std::optional<std::uint32_t> room = countIn(rooms[side]);
    if (!room) refusePlan(owner + " has a room that is no index");
    portal.rooms[side] = *room;
  }
  for (const Value& corner : listIn(value, "corners", RoomPlan::kMostCorners, owner))
    portal.corners.push_back(pointIn<glm::dvec3>(corner, owner));
  return portal;
}

RoomPlan checked(RoomPlan plan) {
  if (const std::optional<std::string> fault = faultOf(plan)) refusePlan(*fault);
  return plan;
}

template <class Vector>
Value valueOf(const Vector& point) {
  Value::Array numbers;
  for (int axis = 0; axis < Vector::length(); ++axis)
    numbers.emplace_back(point[axis]);
  return Value(std::move(numbers));
}

Value valueOf(const Room& room) {
  Value::Array outline;
  for (const std::vector<glm::dvec2>& loop : room.outline) {
    Value::Array points;
    for (const glm::dvec2& point : loop)
      points.push_back(valueOf(point));
    outline.emplace_back(std::move(points));
  }
  Value::Object object;
  if (!room.name.empty()) object["name"] = Value(room.name);
  object["floor"] = Value(room.floor);
  object["ceiling"] = Value(room.ceiling);
  object["outline"] = Value(std::move(outline));
  return Value(std::move(object));
}

Value valueOf(const Portal& portal) {
  Value::Array corners;
  for (const glm::dvec3& corner : portal.corners)
    corners.push_back(valueOf(corner));
  Value::Object object;
  object["rooms"] = Value(Value::Array{countValue(portal.rooms[0]), countValue(portal.rooms[1])});
  object["corners"] = Value(std::move(corners));
  return Value(std::move(object));
}

}  // namespace

void setRooms(tinygltf::Scene& scene, const RoomPlan& plan) {
  Value::Array rooms;
  for (const Room& room : plan.rooms)
    rooms.push_back(valueOf(room));
  Value::Array portals;
  for (const Portal& portal : plan.portals)
    portals.push_back(valueOf(portal));
  Value::Object object;
  object["rooms"] = Value(std::move(rooms));
  object["portals"] = Value(std::move(portals));
  setMember(scene.extras, kRooms, Value(std::move(object)));
}

RoomPlan roomsOf(const tinygltf::Scene& scene) {
  if (!scene.extras.IsObject() || !scene.extras.Has(kRooms)) return {};
  const Value& value = scene.extras.Get(kRooms);
  RoomPlan plan;
  for (const Value& room : listIn(value, "rooms", RoomPlan::kMostRooms, "the plan"))
    plan.rooms.push_back(readRoom(room, fmt::format("room {}", plan.rooms.size())));
  if (!value.Has("portals")) return checked(std::move(plan));  // tinygltf drops empty lists
  for (const Value& portal : listIn(value, "portals", RoomPlan::kMostPortals, "the plan"))
    plan.portals.push_back(readPortal(portal, fmt::format("portal {}", plan.portals.size())));
  return checked(std::move(plan));
}

RoomPlan roomsOf(const tinygltf::Model& model) {
  if (model.scenes.empty()) return {};
  return roomsOf(model.scenes[static_cast<std::size_t>(model.defaultScene >= 0 ? model.defaultScene : 0)]);
}

}  // namespace jalousie::asset
