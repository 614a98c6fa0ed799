// Carries the changes of a model over to the JSON that it was read from, so that what nobody here knows stays as it is.
#pragma once

#include <nlohmann/json.hpp>

namespace jalousie::asset::detail {

/// Applies to `original` what differs between `before` and `after`, which are the same document as tinygltf writes it.
/// Objects are compared member by member. Lists of objects are compared element by element, because elements are only
/// appended; a list of primitives of another length is replaced, and so is every other list that differs.
void applyChanges(nlohmann::json& original, const nlohmann::json& before, const nlohmann::json& after);

}  // namespace jalousie::asset::detail
