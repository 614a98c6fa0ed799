// A file is binary if its length is what its number of triangles asks for, or if it is no text.
#include "bake/io/stl_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <numeric>
#include <string_view>

#include "core/error.h"

namespace jalousie::bake {
namespace {

constexpr std::size_t kHeader = 84;
constexpr std::size_t kTriangle = 50;
constexpr std::size_t kMaxTriangles = 1ULL << 28U;
constexpr std::size_t kMaxName = 4096;

class Reader {
 public:
  Reader(std::span<const std::byte> bytes, const std::filesystem::path& file, Notes& notes)
      : bytes_(bytes), text_(reinterpret_cast<const char*>(bytes.data()), bytes.size()), file_(file), notes_(notes) {}

  PolygonMesh run() {
    std::uint32_t triangles = 0;
    if (bytes_.size() >= kHeader) std::memcpy(&triangles, bytes_.data() + kHeader - 4, 4);
    const std::size_t held = bytes_.size() >= kHeader ? bytes_.size() - kHeader : 0;
    const std::size_t needed = std::size_t{triangles} * kTriangle;
    const bool isExact = bytes_.size() >= kHeader && held == needed;
    if (!isExact && isText()) {
      readText();
    } else if (bytes_.size() < kHeader) {
      fail("neither a binary nor an ASCII STL file");
    } else if (held < needed) {
      fail(fmt::format("the STL file is cut off: it has {} of {} triangles", held / kTriangle, triangles));
    } else {
      if (!isExact) notes_.add("bytes after the last STL facet are left out", fmt::format("{} bytes", held - needed));
      readBinary(triangles);
    }
    if (mesh_.faces.empty()) throw Error(ErrorCode::kUnsupported, "the STL file has no triangles", file_);
    shareCorners();
    return std::move(mesh_);
  }

 private:
  [[noreturn]] void fail(const std::string& reason) const { throw Error(ErrorCode::kMalformed, reason, file_); }

  /// Binary files may begin with the same word; their numbers hold zero bytes.
  bool isText() const {
    constexpr std::size_t kSample = 1024;
    return equalsKeyword(text_.substr(0, 5), "solid") && text_.substr(0, kSample).find('\0') == std::string_view::npos;
  }

  /// @param keyword  in lower case
  static bool equalsKeyword(std::string_view word, std::string_view keyword) {
    return std::equal(word.begin(), word.end(), keyword.begin(), keyword.end(), [](char a, char b) {
      return (a >= 'A' && a <= 'Z' ? static_cast<char>(a - 'A' + 'a') : a) == b;
    });
  }

  void readBinary(std::uint32_t triangles) {
    std::size_t colored = 0;
    mesh_.positions.reserve(3 * std::size_t{triangles});
    for (std::size_t t = 0; t < triangles; ++t) {
      for (std::size_t k = 1; k <= 3; ++k) {
        float xyz[3];
        std::memcpy(xyz, bytes_.data() + kHeader + t * kTriangle + 12 * k, sizeof xyz);
        addCorner(glm::dvec3(xyz[0], xyz[1], xyz[2]));
      }
      std::uint16_t attribute = 0;
      std::memcpy(&attribute, bytes_.data() + kHeader + (t + 1) * kTriangle - sizeof attribute, sizeof attribute);
      colored += attribute != 0 ? 1 : 0;
      endFace();
    }
    if (colored > 0) notes_.add("colours of STL facets are left out", fmt::format("{} facets", colored));
  }

  std::string_view word() {
    constexpr std::string_view kSpace = " \t\r\n";
    at_ = std::min(text_.find_first_not_of(kSpace, at_), text_.size());
    const std::size_t start = at_;
    at_ = std::min(text_.find_first_of(kSpace, start), text_.size());
    return text_.substr(start, at_ - start);
  }

  std::string_view restOfLine() {
    const std::size_t start = at_;
    at_ = std::min(text_.find_first_of("\r\n", start), text_.size());
    std::string_view rest = text_.substr(start, at_ - start);
    rest.remove_prefix(std::min(rest.find_first_not_of(" \t"), rest.size()));
    return rest.substr(0, rest.find_last_not_of(" \t") + 1);
  }

  double number() {
    std::string_view text = word();
    if (text.starts_with('+')) text.remove_prefix(1);
    double value = 0.0;
    const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (status != std::errc() || end != text.data() + text.size()) fail("a vertex of the STL file is no number");
    return value;
  }

  /// Everything but names and vertices is passed over.
  void readText() {
    std::size_t corners = 0;
    for (std::string_view keyword = word(); !keyword.empty(); keyword = word()) {
      if (equalsKeyword(keyword, "solid")) {
        beginObject(restOfLine());
      } else if (equalsKeyword(keyword, "endsolid")) {
        restOfLine();
      } else if (equalsKeyword(keyword, "vertex")) {
        const double x = number();
        const double y = number();
        addCorner({x, y, number()});
        ++corners;
      } else if (equalsKeyword(keyword, "endloop")) {
        if (corners != 3) fail("a facet of the STL file has no three vertices");
        endFace();
        corners = 0;
      }
    }
    if (corners != 0) fail("the STL file is cut off");
  }

  void beginObject(std::string_view name) {
    if (name.size() > kMaxName) throw Error(ErrorCode::kLimit, "a name of the STL file is too long", file_);
    if (!mesh_.faces.empty()) mesh_.objects.emplace_back();
    mesh_.objects.back() = name;
  }

  void addCorner(const glm::dvec3& p) {
    for (int k = 0; k < 3; ++k)
      if (!std::isfinite(static_cast<float>(p[k]))) fail("a vertex of the STL file is NaN or infinite");
    mesh_.corners.push_back({static_cast<std::uint32_t>(mesh_.positions.size()), kNoIndex, kNoIndex});
    mesh_.positions.push_back(p);
  }

  void endFace() {
    if (mesh_.faces.size() >= kMaxTriangles)
      throw Error(ErrorCode::kLimit, fmt::format("more than {} triangles", kMaxTriangles), file_);
    PolygonMesh::Face face;
    face.end = static_cast<std::uint32_t>(mesh_.corners.size());
    face.object = static_cast<std::uint32_t>(mesh_.objects.size() - 1);
    mesh_.faces.push_back(face);
  }

  /// Corners at one place get the first position there; -0 equals 0.
  void shareCorners() {
    std::vector<std::uint32_t> order(mesh_.positions.size());
    std::iota(order.begin(), order.end(), 0U);
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
      const glm::dvec3& p = mesh_.positions[a];
      const glm::dvec3& q = mesh_.positions[b];
      return p.x != q.x ? p.x < q.x : p.y != q.y ? p.y < q.y : p.z != q.z ? p.z < q.z : a < b;
    });
    for (std::size_t i = 0, first = 0; i < order.size(); ++i) {
      if (mesh_.positions[order[i]] != mesh_.positions[order[first]]) first = i;
      mesh_.corners[order[i]].position = order[first];
    }
  }

  std::span<const std::byte> bytes_;
  std::string_view text_;
  const std::filesystem::path& file_;
  Notes& notes_;
  std::size_t at_ = 0;
  PolygonMesh mesh_;
};

}  // namespace

PolygonMesh readStl(std::span<const std::byte> bytes, const std::filesystem::path& file, Notes& notes) {
  return Reader(bytes, file, notes).run();
}

}  // namespace jalousie::bake
