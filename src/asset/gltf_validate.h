// Structural validation of a parsed model.
#pragma once

#include <tiny_gltf.h>

#include <cstddef>
#include <string>

#include "asset/read_limits.h"

namespace jalousie::asset::detail {

/// Throws an error of code kMalformed.
[[noreturn]] void malformed(const std::string& message);

/// @pre the index is in range
inline const tinygltf::Accessor& accessorAt(const tinygltf::Model& model, int index) {
  return model.accessors[static_cast<std::size_t>(index)];
}

/// Checks the values of skins, animations and instances: a finite matrix for each joint, key times that are finite and
/// ascend, a finite value of the right type for each key, rotations with a direction, finite transforms of instances.
/// @pre indices and ranges are valid. Errors (without a file): kMalformed, kLimit.
void validateMotion(const tinygltf::Model& model, const Limits& limits);

/// Checks what accessors hold: sizes and ranges, elements without data and overlap within the limits, types that fit
/// their use, equal counts of all attributes of a primitive, vertex indices and joints in range, weights that are
/// finite and not negative, sparse indices ascending; then validateMotion. Positions and other attributes may be NaN or
/// infinite. Errors (without a file): kMalformed, kLimit.
void validateData(const tinygltf::Model& model, const Limits& limits);

/// Checks that every index is in range, every buffer view lies in its buffer, every accessor in its view, that the
/// nodes form a forest and scenes list only its roots, each once; then validateData. Errors (without a file):
/// kMalformed, kLimit.
void validateModel(const tinygltf::Model& model, const Limits& limits);

}  // namespace jalousie::asset::detail
