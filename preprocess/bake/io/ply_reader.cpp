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

#include "bake/io/color_space.h"
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
  std::vector<std::string> pictures;  ///< of "comment TextureFile"
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
    const std::string_view text = input.line();
    const std::vector<std::string_view> line = words(text);
    if (line.size() > 2 && line[0] == "comment" && (line[1] == "TextureFile" || line[1] == "texture_file"))
      header.pictures.emplace_back(text.substr(static_cast<std::size_t>(line[2].data() - text.data())));
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

/// Slot that a vertex property fills: position 0-2, normal 3-5, uv 6-7, colour 8-11; -1 if none.
int slotOf(std::string_view name) {
  struct Named {
    std::string_view name;
    int slot;
  };
  static constexpr std::array<Named, 36> kNames = {{{"x", 0},
                                                    {"y", 1},
                                                    {"z", 2},
                                                    {"nx", 3},
                                                    {"ny", 4},
                                                    {"nz", 5},
                                                    {"normal_x", 3},
                                                    {"normal_y", 4},
                                                    {"normal_z", 5},
                                                    {"s", 6},
                                                    {"t", 7},
                                                    {"u", 6},
                                                    {"v", 7},
                                                    {"texture_u", 6},
                                                    {"texture_v", 7},
                                                    {"texture_s", 6},
                                                    {"texture_t", 7},
                                                    {"s0", 6},
                                                    {"t0", 7},
                                                    {"u0", 6},
                                                    {"v0", 7},
                                                    {"red", 8},
                                                    {"green", 9},
                                                    {"blue", 10},
                                                    {"alpha", 11},
                                                    {"r", 8},
                                                    {"g", 9},
                                                    {"b", 10},
                                                    {"a", 11},
                                                    {"diffuse_red", 8},
                                                    {"diffuse_green", 9},
                                                    {"diffuse_blue", 10},
                                                    {"diffuse_alpha", 11},
                                                    {"Red", 8},
                                                    {"Green", 9},
                                                    {"Blue", 10}}};
  for (const Named& named : kNames)
    if (named.name == name) return named.slot;
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

/// What the vertices have, by slot. Errors: kMalformed (no position, a property twice).
std::array<bool, 12> slotsOf(const Input& input, const Element& element) {
  std::array<bool, 12> has = {};
  for (const Property& property : element.properties) {
    const int slot = property.countType ? -1 : slotOf(property.name);
    if (slot < 0) continue;
    if (has[static_cast<std::size_t>(slot)]) input.fail("a PLY vertex property stands twice");
    has[static_cast<std::size_t>(slot)] = true;
  }
  if (!has[0] || !has[1] || !has[2]) input.fail("PLY vertices without x, y, z");
  return has;
}

void readVertices(Input& input, const Element& element, Encoding encoding, PolygonMesh& mesh) {
  const std::array<bool, 12> has = slotsOf(input, element);
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
    mesh.positions.emplace_back(values[0], values[1], values[2]);
    if (hasNormals) mesh.normals.emplace_back(values[3], values[4], values[5]);
    if (hasUvs) mesh.uvs.emplace_back(values[6], 1.0F - static_cast<float>(values[7]));
    if (hasColors)
      mesh.colors.emplace_back(linearFromSrgb(values[8]), linearFromSrgb(values[9]), linearFromSrgb(values[10]),
                               values[11]);
  }
}

/// One face while it is read.
struct PlyFace {
  std::vector<std::uint32_t> polygon;
  std::vector<float> uvs;  ///< two for each corner, or none
  double picture = 0.0;    ///< number of its picture
};

std::uint64_t listLength(Input& input, const Property& property, Encoding encoding) {
  const double count = input.value(*property.countType, encoding);
  if (!(count >= 0.0) || count > static_cast<double>(input.left()))
    input.fail("a PLY face has an impossible number of corners");
  return static_cast<std::uint64_t>(count);
}

std::uint32_t vertexIndex(Input& input, const Property& property, Encoding encoding) {
  const double index = input.value(property.type, encoding);
  if (!(index >= 0.0 && index < std::numeric_limits<std::uint32_t>::max()) || index != std::floor(index))
    input.fail("a PLY face has an index out of range");
  return static_cast<std::uint32_t>(index);
}

bool isIndexList(const Property& property) {
  return property.countType && (property.name == "vertex_indices" || property.name == "vertex_index");
}

void readFace(Input& input, const Element& element, Encoding encoding, PlyFace& face) {
  face.polygon.clear();
  face.uvs.clear();
  face.picture = 0.0;
  for (const Property& property : element.properties) {
    if (isIndexList(property)) {
      const std::uint64_t count = listLength(input, property, encoding);
      if (count > kMaxPolygon)
        input.limit(fmt::format("a PLY face has {} corners, the limit is {}", count, kMaxPolygon));
      face.polygon.clear();
      for (std::uint64_t i = 0; i < count; ++i)
        face.polygon.push_back(vertexIndex(input, property, encoding));
    } else if (property.countType && property.name == "texcoord") {
      const std::uint64_t count = listLength(input, property, encoding);
      for (std::uint64_t i = 0; i < count; ++i)
        face.uvs.push_back(static_cast<float>(input.value(property.type, encoding)));
    } else if (!property.countType && property.name == "texnumber") {
      face.picture = input.value(property.type, encoding);
    } else {
      skipProperty(input, property, encoding);
    }
  }
}

/// Adds faces to a mesh. Attributes of vertices follow the position; texture coordinates of faces replace those.
class FaceBuilder {
 public:
  FaceBuilder(const Input& input, PolygonMesh& mesh, std::size_t pictures)
      : input_(input), mesh_(mesh), pictures_(pictures), vertexUvs_(mesh.uvs.size()) {}

  void add(const PlyFace& face) {
    if (face.polygon.size() < 3) return;
    const bool hasOwnUvs = face.uvs.size() == 2 * face.polygon.size();
    for (std::size_t i = 0; i < face.polygon.size(); ++i) {
      PolygonMesh::Corner corner = cornerOf(face.polygon[i]);
      if (hasOwnUvs) {
        const float u = face.uvs[2 * i];
        const float v = face.uvs[2 * i + 1];
        if (!std::isfinite(u) || !std::isfinite(v)) input_.fail("a PLY texture coordinate is NaN or infinite");
        corner.uv = static_cast<std::uint32_t>(mesh_.uvs.size());
        mesh_.uvs.emplace_back(u, 1.0F - v);
      }
      mesh_.corners.push_back(corner);
    }
    const bool hasPicture = face.picture >= 0.0 && face.picture < static_cast<double>(pictures_);
    finish(hasPicture ? static_cast<int>(face.picture) : -1);
  }

  /// The triangles of strips, which -1 separates: every second one is wound the other way.
  void addStrip(const std::vector<std::int64_t>& strip) {
    std::size_t first = 0;
    for (std::size_t i = 0; i <= strip.size(); ++i) {
      if (i < strip.size() && strip[i] >= 0) continue;
      for (std::size_t k = first; k + 2 < i; ++k) {
        const std::size_t odd = (k - first) % 2;
        for (const std::size_t at : {k, k + 1 + odd, k + 2 - odd})
          mesh_.corners.push_back(cornerOf(static_cast<std::uint32_t>(strip[at])));
        finish(pictures_ > 0 ? 0 : -1);
      }
      first = i + 1;
    }
  }

 private:
  PolygonMesh::Corner cornerOf(std::uint32_t index) const {
    if (index >= mesh_.positions.size()) input_.fail("a PLY face has an index out of range");
    PolygonMesh::Corner corner{index, kNoIndex, kNoIndex};
    if (!mesh_.normals.empty()) corner.normal = index;
    if (vertexUvs_ > 0) corner.uv = index;
    return corner;
  }

  void finish(int material) {
    if (mesh_.corners.size() > 3 * kMaxElements) input_.limit("the PLY file has too many triangles");
    PolygonMesh::Face face;
    face.end = static_cast<std::uint32_t>(mesh_.corners.size());
    face.material = material;
    mesh_.faces.push_back(face);
  }

  const Input& input_;
  PolygonMesh& mesh_;
  std::size_t pictures_;
  std::size_t vertexUvs_;
};

void readStrips(Input& input, const Element& element, Encoding encoding, FaceBuilder& faces) {
  std::vector<std::int64_t> strip;
  for (std::uint64_t i = 0; i < element.count; ++i) {
    for (const Property& property : element.properties) {
      if (!isIndexList(property)) {
        skipProperty(input, property, encoding);
        continue;
      }
      const std::uint64_t count = listLength(input, property, encoding);
      strip.clear();
      for (std::uint64_t k = 0; k < count; ++k) {
        const double index = input.value(property.type, encoding);
        if (!(index >= -1.0 && index < std::numeric_limits<std::uint32_t>::max()) || index != std::floor(index))
          input.fail("a PLY strip has an index out of range");
        strip.push_back(static_cast<std::int64_t>(index));
      }
      faces.addStrip(strip);
    }
  }
}

void skipElement(Input& input, const Element& element, Encoding encoding) {
  for (std::uint64_t i = 0; i < element.count; ++i)
    for (const Property& property : element.properties)
      skipProperty(input, property, encoding);
}

void noteSkipped(const Element& element, Notes& notes) {
  const bool isKnown = element.name == "vertex" || element.name == "face" || element.name == "tristrips";
  if (!isKnown && element.count > 0) notes.add("PLY elements are passed over", element.name);
  for (const Property& property : element.properties) {
    const bool isColor = element.name == "face" && slotOf(property.name) >= 8;
    if (isColor) notes.add("colours of PLY faces are left out", property.name);
  }
}

}  // namespace

PolygonMesh readPly(std::span<const std::byte> bytes, const std::filesystem::path& file, Notes& notes) {
  Input input(bytes, file);
  const Header header = parseHeader(input);
  checkCounts(input, header);
  PolygonMesh mesh;
  for (const std::string& picture : header.pictures) {
    mesh.materials.emplace_back();
    mesh.materials.back().name = picture;
    mesh.materials.back().baseColorPicture = picture;
  }
  std::optional<FaceBuilder> faces;
  bool hasFaces = false;
  for (const Element& element : header.elements) {
    noteSkipped(element, notes);
    if (element.name == "vertex" && mesh.positions.empty()) {
      readVertices(input, element, header.encoding, mesh);
      continue;
    }
    hasFaces = hasFaces || ((element.name == "face" || element.name == "tristrips") && element.count > 0);
    if (!faces && hasFaces) faces.emplace(input, mesh, header.pictures.size());
    if (element.name == "face" && faces) {
      PlyFace face;
      for (std::uint64_t f = 0; f < element.count; ++f) {
        readFace(input, element, header.encoding, face);
        faces->add(face);
      }
    } else if (element.name == "tristrips" && faces) {
      readStrips(input, element, header.encoding, *faces);
    } else {
      skipElement(input, element, header.encoding);
    }
  }
  if (mesh.faces.empty() && hasFaces) input.fail("no face of the PLY file has three corners");
  if (mesh.faces.empty())
    throw Error(ErrorCode::kUnsupported, "the PLY file has no faces; point clouds cannot be baked", file);
  return mesh;
}

}  // namespace jalousie::bake
