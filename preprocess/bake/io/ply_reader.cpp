// Parses the header, reads values in each encoding, and reads the vertices and the faces.
#include "bake/io/ply_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

#include "core/error.h"

namespace jalousie::bake {
namespace {

constexpr std::uint64_t kMaxElements = 1ULL << 28U;
constexpr std::uint32_t kMaxPolygon = 4096;

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
  std::vector<Element> elements;
};

std::size_t sizeOf(Type type) {
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

std::vector<std::string_view> words(std::string_view line) {
  std::vector<std::string_view> result;
  while (!line.empty()) {
    const std::size_t start = line.find_first_not_of(" \t");
    if (start == std::string_view::npos) break;
    line.remove_prefix(start);
    const std::size_t end = std::min(line.find_first_of(" \t"), line.size());
    result.push_back(line.substr(0, end));
    line.remove_prefix(end);
  }
  return result;
}

Type parseType(const Input& input, std::string_view name) {
  struct Named {
    std::string_view name;
    Type type;
  };
  constexpr std::array<Named, 16> kTypes = {{{"char", Type::kInt8},
                                             {"int8", Type::kInt8},
                                             {"uchar", Type::kUint8},
                                             {"uint8", Type::kUint8},
                                             {"short", Type::kInt16},
                                             {"int16", Type::kInt16},
                                             {"ushort", Type::kUint16},
                                             {"uint16", Type::kUint16},
                                             {"int", Type::kInt32},
                                             {"int32", Type::kInt32},
                                             {"uint", Type::kUint32},
                                             {"uint32", Type::kUint32},
                                             {"float", Type::kFloat},
                                             {"float32", Type::kFloat},
                                             {"double", Type::kDouble},
                                             {"float64", Type::kDouble}}};
  for (const Named& named : kTypes)
    if (named.name == name) return named.type;
  input.fail("unknown PLY type");
}

std::uint64_t parseCount(const Input& input, std::string_view text) {
  std::uint64_t count = 0;
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), count);
  const bool isNumber = status != std::errc::invalid_argument && end == text.data() + text.size();
  if (!isNumber) input.fail("bad PLY element count");
  if (count > kMaxElements || status == std::errc::result_out_of_range)
    input.limit(fmt::format("{} PLY elements are more than the limit of {}", text.substr(0, 20), kMaxElements));
  return count;
}

void parseProperty(const Input& input, const std::vector<std::string_view>& line, Header& header) {
  if (header.elements.empty()) input.fail("PLY property outside an element");
  Property property;
  if (line.size() == 5 && line[1] == "list") {
    property.countType = parseType(input, line[2]);
    if (*property.countType == Type::kFloat || *property.countType == Type::kDouble)
      input.fail("PLY list count must be an integer");
    property.type = parseType(input, line[3]);
    property.name = line[4];
  } else if (line.size() == 3) {
    property.type = parseType(input, line[1]);
    property.name = line[2];
  } else {
    input.fail("bad PLY property");
  }
  if (header.elements.back().properties.size() >= 256) input.limit("more than 256 properties in one PLY element");
  header.elements.back().properties.push_back(std::move(property));
}

Header parseHeader(Input& input) {
  if (input.left() < 4 || input.line() != "ply") input.fail("not a PLY file");
  Header header;
  bool hasFormat = false;
  for (std::size_t lines = 0;; ++lines) {
    if (lines > 4096) input.limit("the PLY header has more than 4096 lines");
    const std::vector<std::string_view> line = words(input.line());
    if (line.empty() || line[0] == "comment" || line[0] == "obj_info") continue;
    if (line[0] == "end_header") break;
    if (line[0] == "format" && line.size() == 3 && line[2] == "1.0") {
      hasFormat = line[1] == "ascii" || line[1] == "binary_little_endian" || line[1] == "binary_big_endian";
      header.encoding = line[1] == "ascii"               ? Encoding::kAscii
                        : line[1] == "binary_big_endian" ? Encoding::kBig
                                                         : Encoding::kLittle;
    } else if (line[0] == "element" && line.size() == 3) {
      header.elements.push_back({std::string(line[1]), parseCount(input, line[2]), {}});
    } else if (line[0] == "property") {
      parseProperty(input, line, header);
    } else {
      input.fail("unknown line in the PLY header");
    }
  }
  if (!hasFormat) input.fail("the PLY header names no known format");
  return header;
}

/// The least number of bytes of one element: a digit and a space per value in ASCII, empty lists in binary.
std::uint64_t minBytes(const Element& element, Encoding encoding) {
  std::uint64_t bytes = 0;
  for (const Property& property : element.properties)
    bytes += encoding == Encoding::kAscii ? 2 : sizeOf(property.countType.value_or(property.type));
  return bytes;
}

void checkCounts(const Input& input, const Header& header) {
  std::uint64_t needed = 0;
  for (const Element& element : header.elements) {
    if (element.properties.empty() && element.count > 0) input.fail("a PLY element has no properties");
    needed += element.count * minBytes(element, header.encoding);
  }
  // The last ASCII value may end with the file instead of a space.
  if (needed > input.left() + 1) input.fail("the PLY file is shorter than its header says");
}

void skipProperty(Input& input, const Property& property, Encoding encoding) {
  std::uint64_t count = 1;
  if (property.countType) {
    const double given = input.value(*property.countType, encoding);
    if (!(given >= 0.0) || given > static_cast<double>(input.left())) input.fail("bad PLY list length");
    count = static_cast<std::uint64_t>(given);
  }
  if (encoding == Encoding::kAscii) {
    for (std::uint64_t i = 0; i < count; ++i)
      input.word();
  } else {
    input.take(count * sizeOf(property.type));
  }
}

float linearFromSrgb(double value) {
  return static_cast<float>(value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4));
}

/// Slot that a vertex property fills: position 0-2, normal 3-5, uv 6-7, colour 8-11; -1 if none.
int slotOf(std::string_view name) {
  constexpr std::array<std::string_view, 12> kNames = {"x", "y", "z",   "nx",    "ny",   "nz",
                                                       "s", "t", "red", "green", "blue", "alpha"};
  for (std::size_t i = 0; i < kNames.size(); ++i)
    if (kNames[i] == name) return static_cast<int>(i);
  if (name == "u" || name == "texture_u") return 6;
  if (name == "v" || name == "texture_v") return 7;
  return -1;
}

/// The value of full colour: floats reach 1, ushort 65535, and all other integers 255, whatever their width.
double colorScale(Type type) {
  if (type == Type::kFloat || type == Type::kDouble) return 1.0;
  return type == Type::kUint16 ? 65535.0 : 255.0;
}

/// A colour component as a share of full colour. Errors: kMalformed unless it lies in [0, 1] but for rounding.
double colorShare(const Input& input, double value, Type type) {
  constexpr double kRounding = 1e-3;
  const double share = value / colorScale(type);
  if (!(share >= -kRounding && share <= 1.0 + kRounding))
    input.fail(fmt::format("the colour {:g} of a PLY vertex is outside [0, {:g}]", value, colorScale(type)));
  return std::clamp(share, 0.0, 1.0);
}

void readVertices(Input& input, const Element& element, Encoding encoding, TriangleMesh& mesh) {
  std::array<bool, 12> has = {};
  for (const Property& property : element.properties) {
    const int slot = property.countType ? -1 : slotOf(property.name);
    if (slot < 0) continue;
    if (has[static_cast<std::size_t>(slot)]) input.fail("a PLY vertex property stands twice");
    has[static_cast<std::size_t>(slot)] = true;
  }
  if (!has[0] || !has[1] || !has[2]) input.fail("PLY vertices without x, y, z");
  const bool hasNormals = has[3] && has[4] && has[5];
  const bool hasUvs = has[6] && has[7];
  const bool hasColors = has[8] && has[9] && has[10];
  mesh.positions.reserve(element.count);
  for (std::uint64_t v = 0; v < element.count; ++v) {
    std::array<double, 12> values = {0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1};
    for (const Property& property : element.properties) {
      const int slot = property.countType ? -1 : slotOf(property.name);
      if (slot < 0) {
        skipProperty(input, property, encoding);
        continue;
      }
      const double value = input.value(property.type, encoding);
      if (!std::isfinite(static_cast<float>(value))) input.fail("a PLY vertex holds NaN or an infinite number");
      values[static_cast<std::size_t>(slot)] = slot >= 8 ? colorShare(input, value, property.type) : value;
    }
    const auto at = [&](std::size_t i) { return static_cast<float>(values[i]); };
    mesh.positions.emplace_back(at(0), at(1), at(2));
    if (hasNormals) mesh.normals.emplace_back(at(3), at(4), at(5));
    if (hasUvs) mesh.uvs.emplace_back(at(6), 1.0F - at(7));
    if (hasColors)
      mesh.colors.emplace_back(linearFromSrgb(values[8]), linearFromSrgb(values[9]), linearFromSrgb(values[10]),
                               at(11));
  }
}

void readFaces(Input& input, const Element& element, Encoding encoding, std::vector<std::uint32_t>& indices) {
  std::vector<std::uint32_t> polygon;
  for (std::uint64_t f = 0; f < element.count; ++f) {
    for (const Property& property : element.properties) {
      const bool isIndices =
          property.countType && (property.name == "vertex_indices" || property.name == "vertex_index");
      if (!isIndices) {
        skipProperty(input, property, encoding);
        continue;
      }
      const double count = input.value(*property.countType, encoding);
      if (!(count >= 0.0) || count > static_cast<double>(input.left()))
        input.fail("a PLY face has an impossible number of corners");
      if (count > kMaxPolygon)
        input.limit(fmt::format("a PLY face has {} corners, the limit is {}", count, kMaxPolygon));
      polygon.clear();
      for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(count); ++i) {
        const double index = input.value(property.type, encoding);
        if (!(index >= 0.0 && index <= std::numeric_limits<std::uint32_t>::max()) || index != std::floor(index))
          input.fail("a PLY face has an index out of range");
        polygon.push_back(static_cast<std::uint32_t>(index));
      }
      for (std::size_t i = 2; i < polygon.size(); ++i)
        indices.insert(indices.end(), {polygon[0], polygon[i - 1], polygon[i]});
      if (indices.size() > 3 * kMaxElements) input.limit("the PLY file has too many triangles");
    }
  }
}

/// Whether all normals have a direction; otherwise all are recomputed.
bool allUnitLike(const std::vector<glm::vec3>& normals) {
  return std::all_of(normals.begin(), normals.end(), [](const glm::vec3& n) { return glm::dot(n, n) > 1e-8F; });
}

}  // namespace

TriangleMesh readPly(std::span<const std::byte> bytes, const std::filesystem::path& file) {
  Input input(bytes, file);
  const Header header = parseHeader(input);
  checkCounts(input, header);
  TriangleMesh mesh;
  for (const Element& element : header.elements) {
    if (element.name == "vertex" && mesh.positions.empty()) {
      readVertices(input, element, header.encoding, mesh);
    } else if (element.name == "face") {
      readFaces(input, element, header.encoding, mesh.indices);
    } else {
      for (std::uint64_t i = 0; i < element.count; ++i)
        for (const Property& property : element.properties)
          skipProperty(input, property, header.encoding);
    }
  }
  for (const std::uint32_t index : mesh.indices)
    if (index >= mesh.positions.size()) input.fail("a PLY face has an index out of range");
  const bool hasFaces = std::any_of(header.elements.begin(), header.elements.end(),
                                    [](const Element& element) { return element.name == "face" && element.count > 0; });
  if (mesh.indices.empty() && hasFaces) input.fail("no face of the PLY file has three corners");
  if (mesh.indices.empty())
    throw Error(ErrorCode::kUnsupported, "the PLY file has no faces; point clouds cannot be baked", file);
  if (!allUnitLike(mesh.normals)) mesh.normals.clear();
  for (glm::vec3& normal : mesh.normals)
    normal = glm::normalize(normal);
  return mesh;
}

}  // namespace jalousie::bake
