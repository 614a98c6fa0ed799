// Checks and rewrites OBJ text before tinyobjloader parses it: the library reads "v nan 1 x" as a point at 0 1 0,
// counts the corners of a face in a byte and allocates tags of any size.
#include "bake/io/obj_filter.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <cstdint>
#include <string_view>
#include <vector>

#include "core/error.h"

namespace jalousie::bake {
namespace {

constexpr std::size_t kMaxName = 4096;
constexpr std::size_t kMaxCorners = 255;

using Words = std::vector<std::string_view>;

class Filter {
 public:
  Filter(std::string_view text, const std::filesystem::path& file) : text_(text), file_(file) {
    if (text.find('\0') != std::string_view::npos) throw Error(ErrorCode::kMalformed, "not an OBJ file", file);
    out_.reserve(text.size());
  }

  std::string run() {
    Words words;
    while (at_ < text_.size()) {
      nextLine(words);
      if (!words.empty()) statement(words);
    }
    return std::move(out_);
  }

 private:
  [[noreturn]] void fail(std::string_view reason) const {
    throw Error(ErrorCode::kMalformed, fmt::format("line {}: {}", line_, reason), file_);
  }

  /// Splits a line into words; a backslash at the end of the line joins the next line.
  void nextLine(Words& words) {
    words.clear();
    ++line_;
    while (at_ < text_.size()) {
      const std::size_t start = at_;
      at_ = std::min(text_.find_first_of(" \t\r\n", start), text_.size());
      std::string_view word = text_.substr(start, at_ - start);
      const bool lineEnds = at_ == text_.size() || text_[at_] == '\n' || text_[at_] == '\r';
      const bool continued = lineEnds && word.ends_with('\\');
      if (continued) word.remove_suffix(1);
      if (!word.empty()) words.push_back(word);
      if (at_ == text_.size()) return;
      at_ += text_.compare(at_, 2, "\r\n") == 0 ? 2 : 1;
      if (lineEnds && !continued) return;
      line_ += continued ? 1U : 0U;
    }
  }

  void statement(const Words& words) {
    const std::string_view keyword = words[0];
    if (keyword == "v") return numbers(words, 3, 3);
    if (keyword == "vn") return numbers(words, 3, 3);
    if (keyword == "vt") return numbers(words, 1, 2);
    if (keyword == "f") return face(words);
    if (keyword == "usemtl" || keyword == "mtllib") return names(words);
  }

  /// Writes the keyword and the first `kept` numbers, of which `needed` must be present.
  void numbers(const Words& words, std::size_t needed, std::size_t kept) {
    if (words.size() <= needed) fail(fmt::format("'{}' without {} numbers", words[0], needed));
    out_ += words[0];
    for (std::size_t i = 1; i <= kept; ++i) {
      out_ += ' ';
      out_ += i < words.size() ? finite(words[i]) : std::string_view("0");
    }
    out_ += '\n';
  }

  std::string_view finite(std::string_view word) const {
    if (word.starts_with('+')) word.remove_prefix(1);
    double value = 0.0;
    const auto [end, status] = std::from_chars(word.data(), word.data() + word.size(), value);
    const bool isNumber = status == std::errc() && end == word.data() + word.size();
    if (!isNumber || !std::isfinite(static_cast<float>(value))) fail("not a finite number");
    if (word.size() > 64)
      throw Error(ErrorCode::kLimit, fmt::format("line {}: a number of {} digits", line_, word.size()), file_);
    return word;
  }

  static bool isIndex(std::string_view word) {
    std::int32_t value = 0;
    const auto [end, status] = std::from_chars(word.data(), word.data() + word.size(), value);
    return status == std::errc() && end == word.data() + word.size() && value != 0;
  }

  static bool isCorner(std::string_view word) {
    const std::size_t first = word.find('/');
    if (first == std::string_view::npos) return isIndex(word);
    const std::size_t second = word.find('/', first + 1);
    const std::string_view uv = word.substr(first + 1, second == std::string_view::npos ? second : second - first - 1);
    const bool hasNormal = second != std::string_view::npos;
    return isIndex(word.substr(0, first)) && (uv.empty() ? hasNormal : isIndex(uv)) &&
           (!hasNormal || isIndex(word.substr(second + 1)));
  }

  void corners(std::string_view a, std::string_view b, std::string_view c) {
    out_ += fmt::format("f {} {} {}\n", a, b, c);
  }

  void face(const Words& words) {
    for (std::size_t i = 1; i < words.size(); ++i)
      if (!isCorner(words[i])) fail("a face has a corner that is no index");
    if (words.size() < 4) return;  // points and lines in disguise
    if (words.size() > kMaxCorners + 1) {
      for (std::size_t i = 3; i < words.size(); ++i)
        corners(words[1], words[i - 1], words[i]);
      return;
    }
    out_ += 'f';
    for (std::size_t i = 1; i < words.size(); ++i) {
      out_ += ' ';
      out_ += words[i];
    }
    out_ += '\n';
  }

  void names(const Words& words) {
    std::size_t length = 0;
    for (const std::string_view word : words) {
      length += word.size() + 1;
      if (length > kMaxName)
        throw Error(ErrorCode::kLimit, fmt::format("line {}: a name of over {} bytes", line_, kMaxName), file_);
      out_ += word;
      out_ += ' ';
    }
    out_.back() = '\n';
  }

  std::string_view text_;
  const std::filesystem::path& file_;
  std::size_t at_ = 0;
  std::uint64_t line_ = 0;
  std::string out_;
};

}  // namespace

std::string filteredObj(std::span<const std::byte> bytes, const std::filesystem::path& file) {
  return Filter({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, file).run();
}

}  // namespace jalousie::bake
