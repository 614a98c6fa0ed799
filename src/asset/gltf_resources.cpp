// URI decoding and confined file access for glTF documents.
#include "asset/gltf_resources.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <optional>
#include <utility>

#include "core/error.h"
#include "core/file.h"

namespace jalousie::asset::detail {
namespace {

namespace fs = std::filesystem;

std::optional<unsigned> hexDigit(char c) {
  if (c >= '0' && c <= '9') return static_cast<unsigned>(c - '0');
  if (c >= 'a' && c <= 'f') return static_cast<unsigned>(c - 'a' + 10);
  if (c >= 'A' && c <= 'F') return static_cast<unsigned>(c - 'A' + 10);
  return std::nullopt;
}

/// Replaces %XX; a lone percent sign stays, as exporters write file names undecoded.
std::string percentDecoded(const std::string& text) {
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '%' && i + 2 < text.size()) {
      const auto high = hexDigit(text[i + 1]);
      const auto low = hexDigit(text[i + 2]);
      if (high && low) {
        result += static_cast<char>(*high * 16U + *low);
        i += 2;
        continue;
      }
    }
    result += text[i];
  }
  return result;
}

constexpr std::array<std::int8_t, 256> makeBase64Table() {
  std::array<std::int8_t, 256> table{};
  table.fill(-1);
  constexpr std::string_view kAlphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  for (std::size_t i = 0; i < kAlphabet.size(); ++i)
    table[static_cast<unsigned char>(kAlphabet[i])] = static_cast<std::int8_t>(i);
  return table;
}

std::optional<std::vector<unsigned char>> base64Decoded(std::string_view text) {
  static constexpr std::array<std::int8_t, 256> kTable = makeBase64Table();
  while (!text.empty() && text.back() == '=')
    text.remove_suffix(1);
  if (text.size() % 4 == 1) return std::nullopt;
  std::vector<unsigned char> bytes;
  bytes.reserve(text.size() / 4 * 3 + 3);
  std::uint32_t bits = 0;
  unsigned held = 0;
  for (const char c : text) {
    const std::int8_t digit = kTable[static_cast<unsigned char>(c)];
    if (digit < 0) return std::nullopt;
    bits = (bits << 6U) | static_cast<std::uint32_t>(digit);
    held += 6;
    if (held >= 8) {
      held -= 8;
      bytes.push_back(static_cast<unsigned char>((bits >> held) & 0xFFU));
    }
  }
  return bytes;
}

/// Copies of the same bytes, as many as any honest document makes.
constexpr std::uint64_t kFreeBytes = 64ULL << 20U;
constexpr std::uint64_t kMaxCopies = 16;

/// Part of a URI fit for an error message: one line, not the megabytes of a data URI.
std::string shortened(const std::string& uri) {
  std::string text = uri.substr(0, 80);
  std::replace_if(
      text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20; }, '?');
  return text;
}

}  // namespace

ResourceLoader::ResourceLoader(fs::path document, const Limits& limits, ReadObserver observer)
    : document_(std::move(document)), observer_(std::move(observer)), maxBytes_(limits.maxFileBytes) {}

std::vector<unsigned char> ResourceLoader::load(const std::string& uri) {
  if (uri.starts_with("data:")) {
    const std::size_t comma = uri.find(',');
    if (comma == std::string::npos || !std::string_view(uri).substr(0, comma).ends_with(";base64"))
      throw Error(ErrorCode::kMalformed, fmt::format("data URI without base64: {}", shortened(uri)), document_);
    auto bytes = base64Decoded(std::string_view(uri).substr(comma + 1));
    if (!bytes) throw Error(ErrorCode::kMalformed, fmt::format("bad base64: {}", shortened(uri)), document_);
    account(bytes->size(), true);
    return std::move(*bytes);
  }
  const std::vector<std::byte> bytes = readNamed(uri);
  return copy(bytes, seen_.insert(uri).second);
}

std::vector<unsigned char> ResourceLoader::copy(std::span<const std::byte> bytes, bool isNew) {
  account(bytes.size(), isNew);
  std::vector<unsigned char> result(bytes.size());
  if (!bytes.empty()) std::memcpy(result.data(), bytes.data(), bytes.size());
  return result;
}

void ResourceLoader::account(std::uint64_t bytes, bool isNew) {
  if (bytes > maxBytes_ - usedBytes_)
    throw Error(ErrorCode::kLimit, fmt::format("buffers and images exceed {} bytes", maxBytes_), document_);
  usedBytes_ += bytes;
  if (isNew) givenBytes_ += bytes;
  if (usedBytes_ > kFreeBytes + kMaxCopies * givenBytes_)
    throw Error(ErrorCode::kLimit, fmt::format("buffers and images copy {} bytes over and over", givenBytes_),
                document_);
}

std::vector<std::byte> ResourceLoader::readNamed(const std::string& uri) {
  const std::string name = percentDecoded(uri);
  if (name.empty() || name.find('\0') != std::string::npos)
    throw Error(ErrorCode::kMalformed, fmt::format("URI \"{}\" is no file name", shortened(uri)), document_);
  if (name.substr(0, name.find('/')).find(':') != std::string::npos)
    throw Error(ErrorCode::kUnsupported,
                fmt::format("URI \"{}\" has a scheme; only relative files and data URIs are read", shortened(uri)),
                document_);
  if (!folder_) folder_.emplace(folderOf(document_));
  std::vector<std::byte> bytes;
  try {
    bytes = folder_->readFile(name, maxBytes_ - usedBytes_);
  } catch (const Error& error) {
    throw Error(error.code(), fmt::format("names another file, {}", error.what()), document_);
  }
  if (observer_) observer_(name, bytes);
  return bytes;
}

}  // namespace jalousie::asset::detail
