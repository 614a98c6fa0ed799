// Which accessors and buffer views a document refers to, and which of them may go.
#pragma once

#include <nlohmann/json.hpp>
#include <vector>

namespace jalousie::asset::detail {

/// What becomes of accessors and buffer views that nothing refers to.
enum class Unused {
  kDrop,   ///< the rest is numbered anew: every reference is known
  kEmpty,  ///< numbers stay, and their place is kept by an element of no size: extras may hold numbers
  kKeep,   ///< they stay as they are: an extension that is not known may refer to them
};

/// kKeep if an extension that is not known holds an integer or a JSON pointer to an accessor or view; kEmpty if extras
/// hold an integer; else kDrop.
Unused fateOfUnused(const nlohmann::json& document);

/// For each accessor and view whether something refers to it; views of accessors without a reference are not.
struct References {
  std::vector<bool> accessors;
  std::vector<bool> views;
};

/// By the schemas of glTF 2.0 and of the extensions that are known. Errors: kMalformed (out of range).
References findReferences(nlohmann::json& document);

/// findReferences, and what nothing known referred to in the original document: extras may do so.
References keepUnknown(nlohmann::json& document, nlohmann::json original);

/// Drops the accessors and views that are not referred to and numbers the rest anew, everywhere.
void dropUnreferenced(nlohmann::json& document, const References& kept);

/// Puts elements without bytes of their own in the place of accessors and views that are not kept.
void emptyUnreferenced(nlohmann::json& document, const References& kept);

}  // namespace jalousie::asset::detail
