// Objects are copied and put back: tinygltf values cannot be changed.
#include "asset/extras.h"

#include <cmath>
#include <limits>
#include <utility>

#include "core/check.h"

namespace jalousie::asset {

std::optional<std::uint32_t> countIn(const tinygltf::Value& value) {
  const double number = value.IsNumber() ? value.GetNumberAsDouble() : -1.0;
  if (!(number >= 0.0 && number <= std::numeric_limits<int>::max()) || number != std::floor(number))
    return std::nullopt;
  return static_cast<std::uint32_t>(number);
}

tinygltf::Value countValue(std::uint32_t count) {
  JAL_CHECK(count <= static_cast<std::uint32_t>(std::numeric_limits<int>::max()));
  return tinygltf::Value(static_cast<int>(count));
}

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
