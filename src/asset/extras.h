// Members of extras.
#pragma once

#include <tiny_gltf.h>

namespace jalousie::asset {

/// Sets one member of extras and keeps the others. If they are no object, they become the member "value" of one.
void setMember(tinygltf::Value& extras, const char* key, tinygltf::Value value);

}  // namespace jalousie::asset
