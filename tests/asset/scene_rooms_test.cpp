// Rooms and portals in extras: through files, in the flattened scene, and broken ones.
#include "asset/scene_rooms.h"

#include <functional>

#include "asset/asset_fixtures.h"
#include "asset/gltf_json.h"
#include "asset/scene_file.h"

namespace jalousie::asset {
namespace {

/// Two rooms side by side, the second with a pillar, and a door between them.
RoomPlan twoRooms(const glm::dvec3& at = glm::dvec3(0.0)) {
  RoomPlan plan;
  plan.rooms = {{"hall", 0.0, 3.0, {{{0, 0}, {4, 0}, {4, 4}, {0, 4}}}},
                {"", -1.0, 2.5, {{{4, 0}, {9, 0}, {9, 4}, {4, 4}}, {{6, 1}, {7, 1}, {7, 2}}}}};
  plan.portals = {{{0, 1}, {{4, 0, 1}, {4, 2, 1}, {4, 2, 2}, {4, 0, 2}}}};
  moveRooms(plan, at);
  return plan;
}

/// A triangle in the first room.
tinygltf::Model house(const RoomPlan& plan, const glm::dvec3& at = glm::dvec3(0.0)) {
  tinygltf::Model model;
  model.asset.version = "2.0";
  tinygltf::Primitive primitive;
  primitive.mode = TINYGLTF_MODE_TRIANGLES;
  const std::vector<glm::vec3> corners = {{1, 1, 1}, {2, 1, 1}, {1, 2, 1}};
  primitive.attributes["POSITION"] = appendVec3(model, corners, TINYGLTF_TARGET_ARRAY_BUFFER);
  tinygltf::Mesh mesh;
  mesh.primitives.push_back(primitive);
  model.meshes.push_back(mesh);
  test::addNode(model, 0);
  model.nodes.back().translation = {at.x, at.y, at.z};
  test::setScene(model, {0});
  model.scenes[0].extras =
      tinygltf::Value(tinygltf::Value::Object{{"author", tinygltf::Value(std::string("someone"))}});
  setRooms(model.scenes[0], plan);
  return model;
}

tinygltf::Model sceneThroughFile(const tinygltf::Model& model) {
  return parseGltf(encodeGlb(model), "rooms.glb");
}

TEST(SceneRooms, ComeBackAsTheyWere) {
  const tinygltf::Model model = sceneThroughFile(house(twoRooms()));
  EXPECT_EQ(roomsOf(model), twoRooms());
  EXPECT_EQ(model.scenes[0].extras.Get("author").Get<std::string>(), "someone");
  EXPECT_EQ(readScene(model, "rooms.glb").rooms, twoRooms());
  EXPECT_TRUE(roomsOf(tinygltf::Model()).empty());
  RoomPlan alone = twoRooms();
  alone.portals.clear();
  EXPECT_EQ(roomsOf(sceneThroughFile(house(alone))), alone) << "rooms without portals";
}

TEST(SceneRooms, FollowAScenePlacedNearTheOrigin) {
  const glm::dvec3 far(4e6, 100.0, -7e6);
  const SceneFile scene = readScene(sceneThroughFile(house(twoRooms(far), far)), "rooms.glb");
  ASSERT_NE(scene.originWorld, glm::dvec3(0.0));
  RoomPlan plan = scene.rooms;
  moveRooms(plan, scene.originWorld - far);
  EXPECT_EQ(plan, twoRooms());
}

TEST(SceneRooms, AreThoseOfTheSceneThatIsDrawn) {
  tinygltf::Model model = house(twoRooms());
  model.scenes.emplace_back();
  model.scenes.back().nodes = {0};
  model.defaultScene = 1;
  EXPECT_TRUE(roomsOf(sceneThroughFile(model)).empty());
}

std::string failureOf(const std::function<void(RoomPlan&)>& change) {
  RoomPlan plan = twoRooms();
  change(plan);
  try {
    sceneThroughFile(house(plan));
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kMalformed);
    return error.what();
  }
  return "";
}

TEST(SceneRooms, BrokenOnesAreRefusedByName) {
  const auto fails = [](const char* part, const std::function<void(RoomPlan&)>& change) {
    EXPECT_NE(failureOf(change).find(part), std::string::npos) << failureOf(change);
  };
  fails("scene 0: extras.jalousie_rooms: room 0 has no height", [](RoomPlan& p) { p.rooms[0].ceiling = 0.0; });
  fails("room 1 has a height that is no usable number", [](RoomPlan& p) { p.rooms[1].floor = -1e10; });
  fails("room 0 has no list of outline", [](RoomPlan& p) { p.rooms[0].outline.clear(); });
  fails("room 1 has a loop of fewer than three points", [](RoomPlan& p) { p.rooms[1].outline[1].resize(2); });
  fails("room 0 has a point that is no usable number", [](RoomPlan& p) { p.rooms[0].outline[0][2].y = 1e300; });
  fails("portal 0 names a room that is not there: 0 and 2 of 2", [](RoomPlan& p) { p.portals[0].rooms[1] = 2; });
  fails("portal 0 joins a room with itself", [](RoomPlan& p) { p.portals[0].rooms[1] = 0; });
  fails("portal 0 has not 3 to 32 corners", [](RoomPlan& p) { p.portals[0].corners.resize(2); });
  fails("portal 0 has a corner that is no usable number", [](RoomPlan& p) { p.portals[0].corners[1].x = 1e12; });
  fails("portal 0", [](RoomPlan& p) { p.portals[0].corners[2] = p.portals[0].corners[1]; });
  fails("portal 0", [](RoomPlan& p) { std::swap(p.portals[0].corners[1], p.portals[0].corners[2]); });
  fails("portal 0", [](RoomPlan& p) { p.portals[0].corners[1].x += 0.5; });
  fails("portal 0 reaches out of room 1",
        [](RoomPlan& p) { p.portals[0].corners[1].y = p.portals[0].corners[2].y = 2.9; });
  fails("portal 0 reaches out of room 0", [](RoomPlan& p) {
    for (glm::dvec3& corner : p.portals[0].corners)
      corner.x = 4.1;
  });
}

/// The plan with one member of the list's first element changed.
std::string failureOfMember(const char* list, const char* key, const tinygltf::Value& value) {
  using tinygltf::Value;
  tinygltf::Model model = house(twoRooms());
  Value::Object plan = model.scenes[0].extras.Get(kRooms).Get<Value::Object>();
  Value::Array elements = plan[list].Get<Value::Array>();
  Value::Object first = elements[0].Get<Value::Object>();
  first[key] = value;
  elements[0] = Value(first);
  plan[list] = Value(elements);
  model.scenes[0].extras = Value(Value::Object{{kRooms, Value(plan)}});
  try {
    sceneThroughFile(model);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kMalformed);
    return error.what();
  }
  return "";
}

TEST(SceneRooms, OtherTypesAreRefused) {
  using tinygltf::Value;
  const Value text(std::string("x"));
  for (const char* key : {"floor", "ceiling", "outline"})
    EXPECT_NE(failureOfMember("rooms", key, text).find("room 0"), std::string::npos) << key;
  EXPECT_NE(failureOfMember("rooms", "name", Value(3)).find("a name that is no text"), std::string::npos);
  for (const char* key : {"rooms", "corners"})
    EXPECT_NE(failureOfMember("portals", key, text).find("portal 0"), std::string::npos) << key;
  for (const Value& rooms : {Value(Value::Array{Value(0)}), Value(Value::Array{Value(0), Value(-1)}),
                             Value(Value::Array{Value(0), Value(0.5)}), Value(Value::Array{Value(0), text})})
    EXPECT_NE(failureOfMember("portals", "rooms", rooms).find("portal 0"), std::string::npos);
}

/// Hostile files must not take long: corners times outlines are counted first.
TEST(SceneRooms, APlanThatWouldTakeLongIsRefused) {
  RoomPlan plan = twoRooms();
  std::vector<glm::dvec2>& loop = plan.rooms[0].outline.emplace_back();
  for (int i = 0; i < 30000; ++i)
    loop.emplace_back(1.0 + 1e-5 * (i % 200), 1.0 + 1e-5 * i);
  plan.portals.resize(5000, plan.portals[0]);
  ASSERT_TRUE(faultOf(plan).has_value());
  EXPECT_NE(faultOf(plan)->find("makes the plan too large"), std::string::npos) << *faultOf(plan);
  plan.portals.resize(1);
  EXPECT_EQ(faultOf(plan), std::nullopt);
}

}  // namespace
}  // namespace jalousie::asset
