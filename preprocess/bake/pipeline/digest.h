// SHA-256 of bytes and texts.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace jalousie::bake {

/// 64 lower-case hexadecimal digits.
std::string sha256(std::span<const std::byte> bytes);
std::string sha256(std::string_view text);

}  // namespace jalousie::bake
