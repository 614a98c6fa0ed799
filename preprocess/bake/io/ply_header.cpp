// Splits lines into words; every count is checked against the size of the file.
#include "bake/io/ply_header.h"

#include <utility>

namespace jalousie::bake::ply {
namespace {

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

}  // namespace

Header readHeader(Input& input) {
  Header header = parseHeader(input);
  checkCounts(input, header);
  return header;
}

}  // namespace jalousie::bake::ply
