// Which program this is, down to the machine code.
#pragma once

#include <string>

namespace jalousie::bake {

inline constexpr const char* kVersion = "0.1.0";

/// Changes whenever the program or a shared library it has loaded is built from other code: two runs with the same
/// identity, options and input bytes give the same output.
std::string buildIdentity();

}  // namespace jalousie::bake
