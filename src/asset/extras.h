// Counts and members of extras.
#pragma once

#include <tiny_gltf.h>

#include <cstdint>
#include <optional>

namespace jalousie::asset {

/// A whole number from 0 to 2^31 - 1; nullopt if the value is anything else.
std::optional<std::uint32_t> countIn(const tinygltf::Value& value);

/// The value that countIn reads. @pre count is below 2^31 (checked)
tinygltf::Value countValue(std::uint32_t count);

/// Sets one member of extras and keeps the others. If they are no object, they become the member "value" of one.
void setMember(tinygltf::Value& extras, const char* key, tinygltf::Value value);

}  // namespace jalousie::asset
