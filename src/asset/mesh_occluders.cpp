// Every value is checked where it is read; the shape of a solid by faultOf().
#include "asset/mesh_occluders.h"

#include <fmt/format.h>

#include <optional>
#include <string>
#include <utility>

#include "asset/extras.h"
#include "core/error.h"

namespace jalousie::asset {
namespace {

using tinygltf::Value;

[[noreturn]] void refuse(std::size_t occluder, const std::string& what) {
  throw Error(ErrorCode::kMalformed, fmt::format("extras.{}: occluder {} {}", kOccluders, occluder, what));
}

std::uint32_t countOf(const Value& value, std::size_t occluder, const char* what) {
  const std::optional<std::uint32_t> count = countIn(value);
  if (!count) refuse(occluder, fmt::format("has {} that is no count", what));
  return *count;
}

const Value::Array& listOf(const Value& object, const char* key, std::size_t most, std::size_t occluder) {
  if (!object.Get(key).IsArray()) refuse(occluder, fmt::format("has no list of {}", key));
  const Value::Array& list = object.Get(key).Get<Value::Array>();
  if (list.size() > most) refuse(occluder, fmt::format("has more than {} {}", most, key));
  return list;
}

glm::vec3 vertexOf(const Value& value, std::size_t occluder) {
  if (!value.IsArray() || value.ArrayLen() != 3) refuse(occluder, "has a vertex without three numbers");
  glm::vec3 vertex(0.0F);
  for (int axis = 0; axis < 3; ++axis) {
    const Value& number = value.Get(axis);
    if (!number.IsNumber()) refuse(occluder, "has a vertex without three numbers");
    vertex[axis] = static_cast<float>(number.GetNumberAsDouble());
  }
  return vertex;
}

Occluder readOccluder(const Value& value, std::size_t index) {
  if (!value.IsObject()) refuse(index, "is not an object");
  Occluder occluder;
  for (const Value& vertex : listOf(value, "vertices", ConvexSolid::kMostVertices, index))
    occluder.solid.vertices.push_back(vertexOf(vertex, index));
  for (const Value& face : listOf(value, "faces", ConvexSolid::kMostFaces, index)) {
    if (!face.IsArray() || face.ArrayLen() > ConvexSolid::kMostVertices) refuse(index, "has a face that is no list");
    std::vector<std::uint32_t>& corners = occluder.solid.faces.emplace_back();
    for (const Value& corner : face.Get<Value::Array>())
      corners.push_back(countOf(corner, index, "a corner"));
  }
  occluder.levels = value.Has("levels") ? countOf(value.Get("levels"), index, "a number of levels") : 1;
  if (value.Has("bothSides")) {
    if (!value.Get("bothSides").IsBool()) refuse(index, "has bothSides that is neither true nor false");
    occluder.solid.bothSides = value.Get("bothSides").Get<bool>();
  }
  if (const std::optional<std::string> fault = faultOf(occluder.solid)) refuse(index, *fault);
  return occluder;
}

Value writeOccluder(const Occluder& occluder) {
  Value::Array vertices;
  for (const glm::vec3& v : occluder.solid.vertices)
    vertices.emplace_back(Value::Array{Value(double{v.x}), Value(double{v.y}), Value(double{v.z})});
  Value::Array faces;
  for (const std::vector<std::uint32_t>& face : occluder.solid.faces) {
    Value::Array corners;
    for (const std::uint32_t corner : face)
      corners.emplace_back(static_cast<int>(corner));
    faces.emplace_back(std::move(corners));
  }
  Value::Object object;
  object["vertices"] = Value(std::move(vertices));
  object["faces"] = Value(std::move(faces));
  object["levels"] = Value(static_cast<int>(occluder.levels));
  if (occluder.solid.bothSides) object["bothSides"] = Value(true);
  return Value(std::move(object));
}

}  // namespace

void setOccluders(tinygltf::Mesh& mesh, std::span<const Occluder> occluders) {
  if (!occluders.empty()) {
    Value::Array list;
    for (const Occluder& occluder : occluders)
      list.push_back(writeOccluder(occluder));
    setMember(mesh.extras, kOccluders, Value(std::move(list)));
  } else if (mesh.extras.IsObject() && mesh.extras.Has(kOccluders)) {
    Value::Object object = mesh.extras.Get<Value::Object>();
    object.erase(kOccluders);
    mesh.extras = object.empty() ? Value() : Value(std::move(object));
  }
}

std::vector<Occluder> meshOccluders(const tinygltf::Mesh& mesh) {
  if (!mesh.extras.IsObject() || !mesh.extras.Has(kOccluders)) return {};
  const Value& list = mesh.extras.Get(kOccluders);
  if (!list.IsArray()) throw Error(ErrorCode::kMalformed, fmt::format("extras.{} is not a list", kOccluders));
  if (list.ArrayLen() > kMostOccluders)
    throw Error(ErrorCode::kMalformed, fmt::format("extras.{} has more than {} occluders", kOccluders, kMostOccluders));
  std::vector<Occluder> occluders;
  for (const Value& value : list.Get<Value::Array>())
    occluders.push_back(readOccluder(value, occluders.size()));
  return occluders;
}

void requireWithin(std::span<const Occluder> occluders, const Aabb& meshBounds) {
  const glm::vec3 slack(1e-4F * meshBounds.diagonal());
  for (std::size_t i = 0; i < occluders.size(); ++i)
    for (const glm::vec3& v : occluders[i].solid.vertices)
      if (glm::any(glm::lessThan(v, meshBounds.min - slack)) || glm::any(glm::greaterThan(v, meshBounds.max + slack)))
        refuse(i, "reaches out of its mesh");
}

}  // namespace jalousie::asset
