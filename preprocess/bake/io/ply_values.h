// The elements of a PLY file as its header declares them, and the values that follow.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.h"

namespace jalousie::bake::ply {

inline constexpr std::uint64_t kMaxElements = 1ULL << 28U;

enum class Encoding { kAscii, kLittle, kBig };
enum class Type { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat, kDouble };

struct Property {
  std::string name;
  Type type = Type::kFloat;
  std::optional<Type> countType;  ///< set for lists
};

struct Element {
  std::string name;
  std::uint64_t count = 0;
  std::vector<Property> properties;
};

struct Header {
  Encoding encoding = Encoding::kAscii;
  std::vector<std::string> pictures;  ///< of "comment TextureFile"
  std::vector<Element> elements;
};

/// Bytes of a value in binary files.
inline std::size_t sizeOf(Type type) {
  constexpr std::array<std::size_t, 8> kSizes = {1, 1, 2, 2, 4, 4, 4, 8};
  return kSizes[static_cast<std::size_t>(type)];
}

/// The input with a cursor; every read is checked.
class Input {
 public:
  Input(std::span<const std::byte> bytes, const std::filesystem::path& file)
      : text_(reinterpret_cast<const char*>(bytes.data()), bytes.size()), file_(file) {}

  [[noreturn]] void fail(const std::string& reason) const {
    throw Error(ErrorCode::kMalformed, fmt::format("{} (byte {})", reason, at_), file_);
  }
  [[noreturn]] void limit(const std::string& reason) const { throw Error(ErrorCode::kLimit, reason, file_); }

  std::size_t left() const { return text_.size() - at_; }

  /// Next header line without its end; CR LF is accepted.
  std::string_view line() {
    const std::size_t end = text_.find('\n', at_);
    if (end == std::string_view::npos) fail("the PLY header does not end");
    std::string_view result = text_.substr(at_, end - at_);
    at_ = end + 1;
    if (!result.empty() && result.back() == '\r') result.remove_suffix(1);
    return result;
  }

  std::string_view word() {
    while (at_ < text_.size() && isSpace(text_[at_]))
      ++at_;
    const std::size_t start = at_;
    while (at_ < text_.size() && !isSpace(text_[at_]))
      ++at_;
    if (start == at_) fail("the PLY data ends too early");
    return text_.substr(start, at_ - start);
  }

  const char* take(std::size_t count) {
    if (left() < count) fail("the PLY data ends too early");
    const char* data = text_.data() + at_;
    at_ += count;
    return data;
  }

  double value(Type type, Encoding encoding) {
    return encoding == Encoding::kAscii ? asciiValue(type) : binaryValue(type, encoding == Encoding::kBig);
  }

 private:
  static bool isSpace(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

  double asciiValue(Type type) {
    std::string_view text = word();
    if (text.starts_with('+')) text.remove_prefix(1);
    double result = 0.0;
    const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), result);
    if (status != std::errc() || end != text.data() + text.size()) fail("not a number: '" + printable(text) + "'");
    if (type != Type::kFloat && type != Type::kDouble && result != std::floor(result)) fail("an integer was expected");
    return result;
  }

  double binaryValue(Type type, bool bigEndian) {
    std::array<char, 8> raw = {};
    const std::size_t size = sizeOf(type);
    std::memcpy(raw.data(), take(size), size);
    if (bigEndian) std::reverse(raw.begin(), raw.begin() + static_cast<std::ptrdiff_t>(size));
    switch (type) {
      case Type::kInt8:
        return as<std::int8_t>(raw);
      case Type::kUint8:
        return as<std::uint8_t>(raw);
      case Type::kInt16:
        return as<std::int16_t>(raw);
      case Type::kUint16:
        return as<std::uint16_t>(raw);
      case Type::kInt32:
        return as<std::int32_t>(raw);
      case Type::kUint32:
        return as<std::uint32_t>(raw);
      case Type::kFloat:
        return static_cast<double>(as<float>(raw));
      case Type::kDouble:
        break;
    }
    return as<double>(raw);
  }

  template <class T>
  static T as(const std::array<char, 8>& raw) {
    T result;
    std::memcpy(&result, raw.data(), sizeof(T));
    return result;
  }

  static std::string printable(std::string_view text) {
    std::string result(text.substr(0, 32));
    std::replace_if(
        result.begin(), result.end(), [](char c) { return c < 0x20 || c > 0x7e; }, '?');
    return result;
  }

  std::string_view text_;
  std::size_t at_ = 0;
  const std::filesystem::path& file_;
};

/// Reads a property's value, or all values of a list, and drops them.
void skipProperty(Input& input, const Property& property, Encoding encoding);

}  // namespace jalousie::bake::ply
