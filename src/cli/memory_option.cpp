// Whole numbers with a unit.
#include "cli/memory_option.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <charconv>
#include <optional>
#include <string_view>

namespace jalousie::cli {
namespace {

/// Bytes of "512", "512K", "1M", "2GiB"; nothing if it is no such text or has no room in 64 bits.
std::optional<std::uint64_t> parseBytes(std::string_view text) {
  constexpr std::string_view kUnits = "KMGT";
  std::uint64_t number = 0;
  const auto parsed = std::from_chars(text.data(), text.data() + text.size(), number);
  if (parsed.ec != std::errc() || parsed.ptr == text.data()) return std::nullopt;
  std::string_view unit = text.substr(static_cast<std::size_t>(parsed.ptr - text.data()));
  if (unit.empty()) return number;
  const std::size_t index = kUnits.find(static_cast<char>(unit.front() & ~0x20));  // lower case, too
  unit.remove_prefix(1);
  if (index == std::string_view::npos || !(unit.empty() || unit == "B" || unit == "iB")) return std::nullopt;
  const auto shift = static_cast<unsigned>(10 * (index + 1));
  if (number > (UINT64_MAX >> shift)) return std::nullopt;
  return number << shift;
}

}  // namespace

std::function<std::string(std::string& text)> bytesOption(std::uint64_t least) {
  return [least](std::string& text) {
    const std::optional<std::uint64_t> bytes = parseBytes(text);
    if (!bytes) return fmt::format("\"{}\" is no size; write bytes, or a whole number with K, M or G", text);
    if (*bytes != 0 && *bytes < least)
      return fmt::format("\"{}\" is too little; the least is {}M, and 0 means no limit", text, least >> 20U);
    text = std::to_string(*bytes);
    return std::string();
  };
}

void addMemoryOption(CLI::App& command, MemoryLimit& limit) {
  constexpr std::uint64_t kLeast = 1ULL << 20U;
  command
      .add_option("--max-memory", limit.bytes,
                  "Refuse what would need more memory, on the host and on the GPU together, by an estimate made before "
                  "it is allocated; bytes or with K, M, G; 0: no limit")
      ->transform(CLI::Validator(bytesOption(kLeast), ""))
      ->type_name("SIZE")
      ->default_str("2G");
}

}  // namespace jalousie::cli
