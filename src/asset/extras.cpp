// tinygltf values are immutable: an object is copied and put back.
#include "asset/extras.h"

#include <utility>

namespace jalousie::asset {

void setMember(tinygltf::Value& extras, const char* key, tinygltf::Value value) {
  constexpr const char* kOtherExtras = "value";
  tinygltf::Value::Object object;
  if (extras.IsObject()) {
    object = extras.Get<tinygltf::Value::Object>();
  } else if (extras.Type() != tinygltf::NULL_TYPE) {
    object[kOtherExtras] = extras;
  }
  object[key] = std::move(value);
  extras = tinygltf::Value(std::move(object));
}

}  // namespace jalousie::asset
