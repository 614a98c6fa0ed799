// Identifies the program down to the machine code.
#pragma once

#include <string>

namespace jalousie::bake {

inline constexpr const char* kVersion = "0.1.0";

/// A text that changes if the program or a loaded shared library is built from other code. Two runs with the same
/// identity, options and input bytes give the same output.
std::string buildIdentity();

}  // namespace jalousie::bake
