// Members in the order of the specification; defaults are left out where tinygltf leaves them out.
#include "asset/gltf_elements.h"

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

namespace jalousie::asset::detail {
namespace {

using nlohmann::json;
using tinygltf::Value;

/// Elements without a value have no JSON, and are left out of lists.
json jsonOf(const Value& value) {
  switch (value.Type()) {
    case tinygltf::REAL_TYPE:
      return value.Get<double>();
    case tinygltf::INT_TYPE:
      return value.Get<int>();
    case tinygltf::BOOL_TYPE:
      return value.Get<bool>();
    case tinygltf::STRING_TYPE:
      return value.Get<std::string>();
    case tinygltf::ARRAY_TYPE: {
      json list = json::array();
      for (const Value& element : value.Get<Value::Array>())
        if (element.Type() != tinygltf::NULL_TYPE) list.push_back(jsonOf(element));
      return list;
    }
    case tinygltf::OBJECT_TYPE: {
      json object = json::object();
      for (const auto& [key, member] : value.Get<Value::Object>())
        if (member.Type() != tinygltf::NULL_TYPE) object.emplace(key, jsonOf(member));
      return object;
    }
    default:
      return json::object();
  }
}

template <class Element>
void addName(json& object, const Element& element) {
  if (!element.name.empty()) object.emplace("name", element.name);
}

template <class Element>
void addExtras(json& object, const Element& element) {
  if (element.extras.Type() != tinygltf::NULL_TYPE) object.emplace("extras", jsonOf(element.extras));
}

template <class Element>
void addExtensions(json& object, const Element& element) {
  if (element.extensions.empty()) return;
  json extensions = json::object();
  for (const auto& [name, extension] : element.extensions)
    extensions.emplace(name, jsonOf(extension));
  object.emplace("extensions", std::move(extensions));
}

void addIndex(json& object, const char* key, int index) {
  if (index >= 0) object.emplace(key, index);
}

template <class Number>
void addList(json& object, const char* key, const std::vector<Number>& values) {
  if (!values.empty()) object.emplace(key, values);
}

void addBound(json& object, const char* key, const tinygltf::Accessor& accessor, const std::vector<double>& values) {
  if (accessor.componentType == TINYGLTF_COMPONENT_TYPE_FLOAT) return addList(object, key, values);
  addList(object, key, std::vector<std::int64_t>(values.begin(), values.end()));
}

const char* nameOfType(int type) {
  switch (type) {
    case TINYGLTF_TYPE_SCALAR:
      return "SCALAR";
    case TINYGLTF_TYPE_VEC2:
      return "VEC2";
    case TINYGLTF_TYPE_VEC3:
      return "VEC3";
    case TINYGLTF_TYPE_VEC4:
      return "VEC4";
    case TINYGLTF_TYPE_MAT2:
      return "MAT2";
    case TINYGLTF_TYPE_MAT3:
      return "MAT3";
    case TINYGLTF_TYPE_MAT4:
      return "MAT4";
    default:
      return "";
  }
}

json sparseOf(const tinygltf::Accessor& accessor) {
  const auto& sparse = accessor.sparse;
  return {{"count", sparse.count},
          {"indices",
           {{"bufferView", sparse.indices.bufferView},
            {"byteOffset", sparse.indices.byteOffset},
            {"componentType", sparse.indices.componentType}}},
          {"values", {{"bufferView", sparse.values.bufferView}, {"byteOffset", sparse.values.byteOffset}}}};
}

json elementOf(const tinygltf::Accessor& accessor) {
  json object = json::object();
  addIndex(object, "bufferView", accessor.bufferView);
  if (accessor.byteOffset > 0) object.emplace("byteOffset", accessor.byteOffset);
  object.emplace("componentType", accessor.componentType);
  if (accessor.normalized) object.emplace("normalized", true);
  object.emplace("count", accessor.count);
  object.emplace("type", nameOfType(accessor.type));
  addBound(object, "min", accessor, accessor.minValues);
  addBound(object, "max", accessor, accessor.maxValues);
  if (accessor.sparse.isSparse) object.emplace("sparse", sparseOf(accessor));
  addName(object, accessor);
  addExtras(object, accessor);
  return object;
}

json elementOf(const tinygltf::BufferView& view) {
  json object = {{"buffer", view.buffer}, {"byteOffset", view.byteOffset}, {"byteLength", view.byteLength}};
  if (view.byteStride >= 4) object.emplace("byteStride", view.byteStride);
  if (view.target == TINYGLTF_TARGET_ARRAY_BUFFER || view.target == TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER)
    object.emplace("target", view.target);
  addName(object, view);
  addExtras(object, view);
  return object;
}

json elementOf(const tinygltf::Primitive& primitive) {
  json object = {{"attributes", primitive.attributes}, {"mode", primitive.mode}};
  addIndex(object, "indices", primitive.indices);
  addIndex(object, "material", primitive.material);
  addList(object, "targets", primitive.targets);
  addExtensions(object, primitive);
  addExtras(object, primitive);
  return object;
}

json elementOf(const tinygltf::Mesh& mesh) {
  json object = json::object();
  json primitives = json::array();
  for (const tinygltf::Primitive& primitive : mesh.primitives)
    primitives.push_back(elementOf(primitive));
  object.emplace("primitives", std::move(primitives));
  addList(object, "weights", mesh.weights);
  addName(object, mesh);
  addExtensions(object, mesh);
  addExtras(object, mesh);
  return object;
}

json elementOf(const tinygltf::Node& node) {
  json object = json::object();
  addIndex(object, "camera", node.camera);
  addList(object, "children", node.children);
  addIndex(object, "skin", node.skin);
  addList(object, "matrix", node.matrix);
  addIndex(object, "mesh", node.mesh);
  addList(object, "rotation", node.rotation);
  addList(object, "scale", node.scale);
  addList(object, "translation", node.translation);
  addList(object, "weights", node.weights);
  addName(object, node);
  addExtensions(object, node);
  addExtras(object, node);
  return object;
}

template <class Element>
void takeList(json& document, const char* key, std::vector<Element>& elements) {
  if (elements.empty()) return;
  json list = json::array();
  for (const Element& element : elements)
    list.push_back(elementOf(element));
  document.emplace(key, std::move(list));
  elements.clear();
}

}  // namespace

json takeElements(tinygltf::Model& model) {
  json document = json::object();
  takeList(document, "accessors", model.accessors);
  takeList(document, "bufferViews", model.bufferViews);
  takeList(document, "meshes", model.meshes);
  takeList(document, "nodes", model.nodes);
  return document;
}

}  // namespace jalousie::asset::detail
