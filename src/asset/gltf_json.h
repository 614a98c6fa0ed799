// The JSON of a glTF document, checked before and right after it is parsed.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string_view>

#include "asset/read_limits.h"

namespace jalousie::asset::detail {

/// Parses a document. Size and nesting are bounded by a scan before the parser runs; then the asset version, the
/// required extensions, the kinds of the top-level arrays and every index and size are checked, because tinygltf cuts
/// integers to 32 bits and passes over values of the wrong type. Errors: kLimit, kMalformed, kUnsupported (version,
/// required extension).
nlohmann::json parseDocument(std::string_view text, const Limits& limits, const std::filesystem::path& file);

/// A non-negative integer member; `fallback` if absent. Errors: kMalformed.
std::uint64_t unsignedMember(const nlohmann::json& object, const char* key, std::uint64_t fallback,
                             const std::filesystem::path& file);

/// Takes a name out of the lists of extensions that the document uses and requires; an empty list goes.
void forgetExtension(nlohmann::json& document, std::string_view name);

}  // namespace jalousie::asset::detail
