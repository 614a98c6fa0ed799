// Compares what a stream announces with the accessors before Draco's decoder allocates, then copies what it decoded.
#include "asset/gltf_draco.h"

#include <draco/compression/mesh/mesh_edgebreaker_decoder.h>
#include <draco/compression/mesh/mesh_sequential_decoder.h>
#include <draco/core/varint_decoding.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <utility>

#include "asset/accessor_layout.h"
#include "asset/gltf_json.h"
#include "core/error.h"

namespace jalousie::asset::detail {
namespace {

using nlohmann::json;
using Path = std::filesystem::path;
using Bytes = std::vector<unsigned char>;

constexpr const char* kDraco = "KHR_draco_mesh_compression";
/// Most bytes that one compressed byte can stand for beyond the free ones. Large planes of equal attributes come close.
constexpr std::uint64_t kMaxDracoExpansion = 256;
constexpr std::uint64_t kFreeDracoBytes = 64ULL << 20U;
constexpr std::uint64_t kCornerBytes =
    4;  ///< of each index, whatever its type: the decoder's own tables grow with them

/// What the accessors of a primitive say about the stream.
struct Expected {
  std::uint64_t points = 0;
  std::uint64_t faces = 0;
  std::uint64_t maxBytes = 0;  ///< of all attributes in the stream
};

/// The two numbers with which the connectivity of both methods begins, without moving the buffer.
std::optional<std::pair<std::uint32_t, std::uint32_t>> firstCounts(draco::DecoderBuffer buffer) {
  std::uint32_t first = 0;
  std::uint32_t second = 0;
  if (!draco::DecodeVarint(&first, &buffer) || !draco::DecodeVarint(&second, &buffer)) return std::nullopt;
  return std::pair(first, second);
}

/// A decoder of the library that stops before it allocates more than the accessors describe.
template <class Decoder, bool facesComeFirst>
class Bounded : public Decoder {
 public:
  explicit Bounded(const Expected& expected) : expected_(expected) {}
  /// Why decoding stopped; empty if the library did not like the data.
  const std::string& reason() const { return reason_; }

 protected:
  bool DecodeGeometryData() override {
    const auto counts = firstCounts(*this->buffer());
    if (!counts) return false;
    const std::uint64_t faces = facesComeFirst ? counts->first : counts->second;
    if (faces != expected_.faces) return stop("triangles", faces, expected_.faces);
    // An edgebreaker stream counts vertices before it knows the seams: they are fewer than the points, never more.
    const std::uint64_t points = facesComeFirst ? counts->second : counts->first;
    if (points > expected_.points) return stop("vertices", points, expected_.points);
    return Decoder::DecodeGeometryData();
  }

  /// Here the attributes are known, and none has its values yet.
  bool DecodeAllAttributes() override {
    const draco::PointCloud& cloud = *this->point_cloud();
    if (cloud.num_points() != expected_.points) return stop("vertices", cloud.num_points(), expected_.points);
    std::uint64_t bytes = 0;
    for (int i = 0; i < cloud.num_attributes(); ++i)
      bytes +=
          expected_.points * static_cast<std::uint64_t>(std::max<std::int64_t>(cloud.attribute(i)->byte_stride(), 0));
    if (bytes > expected_.maxBytes) {
      reason_ = fmt::format("its attributes unfold to {} bytes, the limit is {}", bytes, expected_.maxBytes);
      return false;
    }
    return Decoder::DecodeAllAttributes();
  }

 private:
  bool stop(const char* what, std::uint64_t found, std::uint64_t expected) {
    reason_ = fmt::format("{} {} in the stream, {} in the accessors", found, what, expected);
    return false;
  }

  Expected expected_;
  std::string reason_;
};

using Edgebreaker = Bounded<draco::MeshEdgebreakerDecoder, false>;
using Sequential = Bounded<draco::MeshSequentialDecoder, true>;

/// One accessor that a stream fills.
struct Target {
  std::size_t accessor = 0;
  std::int64_t uniqueId = 0;  ///< of the attribute in the stream; kIndices for the triangles
  std::uint64_t count = 0;
  std::uint32_t components = 0;
  int componentType = 0;

  std::uint64_t elementBytes() const { return std::uint64_t{components} * componentBytes(componentType); }
  /// Elements of vertex attributes begin at multiples of four bytes.
  std::uint64_t stride() const { return uniqueId == kIndices ? elementBytes() : (elementBytes() + 3) / 4 * 4; }

  static constexpr std::int64_t kIndices = -1;
};

std::uint32_t componentsOf(const json& accessor) {
  constexpr std::array kTypes = {"SCALAR", "VEC2", "VEC3", "VEC4"};
  const auto type = accessor.find("type");
  if (type == accessor.end()) return 0;
  const auto found = std::find(kTypes.begin(), kTypes.end(), *type);
  return found == kTypes.end() ? 0 : static_cast<std::uint32_t>(found - kTypes.begin()) + 1;
}

/// Copies one attribute of a mesh.
template <class T>
bool copyValues(const draco::PointAttribute& source, const Target& target, unsigned char* out,
                std::array<T, 8>& range) {
  std::fill_n(range.begin(), 4, std::numeric_limits<T>::max());
  std::fill_n(range.begin() + 4, 4, std::numeric_limits<T>::lowest());
  for (std::uint32_t p = 0; p < target.count; ++p) {
    const draco::AttributeValueIndex value = source.mapped_index(draco::PointIndex(p));
    std::array<T, 4> elements{};
    if (value.value() >= source.size() ||
        !source.ConvertValue<T>(value, static_cast<std::int8_t>(target.components), elements.data()))
      return false;
    std::memcpy(out + p * target.stride(), elements.data(), target.elementBytes());
    for (std::size_t k = 0; k < 4; ++k) {
      if constexpr (std::is_floating_point_v<T>)
        if (!std::isfinite(elements[k])) continue;
      range[k] = std::min(range[k], elements[k]);
      range[k + 4] = std::max(range[k + 4], elements[k]);
    }
  }
  return true;
}

/// Copies the corners of all triangles. @return  false if one is no vertex
template <class T>
bool copyCorners(const draco::Mesh& mesh, const Target& target, unsigned char* out, std::array<T, 8>& range) {
  range[0] = std::numeric_limits<T>::max();
  for (std::uint32_t i = 0; i < target.count; ++i) {
    const std::uint32_t corner = mesh.face(draco::FaceIndex(i / 3))[i % 3].value();
    if (corner >= mesh.num_points() || corner > std::numeric_limits<T>::max()) return false;
    const T index = static_cast<T>(corner);
    std::memcpy(out + i * sizeof index, &index, sizeof index);
    range[0] = std::min(range[0], index);
    range[4] = std::max(range[4], index);
  }
  return true;
}

/// The decoder of one document.
class DracoReader {
 public:
  DracoReader(json& document, std::vector<Bytes>& buffers, const Limits& limits, const Path& file)
      : document_(document), buffers_(buffers), limits_(limits), file_(file) {
    std::uint64_t given = 0;
    for (const Bytes& buffer : buffers)
      given += buffer.size();
    room_ = std::min(limits.maxFileBytes, kFreeDracoBytes + kMaxDracoExpansion * given);
  }

  void run() {
    const auto meshes = document_.find("meshes");
    if (meshes == document_.end()) return;
    for (json& mesh : *meshes) {
      for (json& primitive : mesh["primitives"]) {
        const auto extensions = primitive.find("extensions");
        if (extensions == primitive.end() || !extensions->is_object() || !extensions->contains(kDraco)) continue;
        const json extension = (*extensions)[kDraco];
        extensions->erase(kDraco);
        if (extensions->empty()) primitive.erase("extensions");
        if (!hasOtherData(primitive)) decodePrimitive(primitive, extension);
      }
      ++mesh_;
    }
  }

 private:
  [[noreturn]] void fail(const std::string& what, ErrorCode code = ErrorCode::kMalformed) const {
    throw Error(code, fmt::format("mesh {}: {}: {}", mesh_, kDraco, what), file_);
  }

  /// An object of a top-level array. Errors: kMalformed (the index is out of range).
  json& element(const char* list, const json& index, const char* what) {
    const auto found = document_.find(list);
    const std::size_t count = found == document_.end() ? 0 : found->size();
    if (!index.is_number_unsigned() || index.get<std::uint64_t>() >= count)
      fail(fmt::format("{} {} is out of range, there are {}", what, oneLine(index.dump()), count));
    return (*found)[index.get<std::size_t>()];
  }

  /// Whether all accessors of a primitive have data of their own, so that nothing is missing without the extension.
  bool hasOtherData(const json& primitive) {
    const json& attributes = primitive["attributes"];
    const auto hasView = [&](const json& index) {
      return element("accessors", index, "accessor").contains("bufferView") &&
             !filled_.contains(index.get<std::size_t>());
    };
    return std::all_of(attributes.begin(), attributes.end(), hasView) &&
           (!primitive.contains("indices") || hasView(primitive["indices"]));
  }

  /// The bytes of a view. Errors: kMalformed.
  std::span<const unsigned char> streamOf(const json& extension) {
    const std::uint64_t none = ~0ULL;
    const json& view = element("bufferViews", extension.value("bufferView", json()), "buffer view");
    const std::uint64_t buffer = unsignedMember(view, "buffer", none, file_);
    const std::uint64_t offset = unsignedMember(view, "byteOffset", 0, file_);
    const std::uint64_t length = unsignedMember(view, "byteLength", none, file_);
    if (buffer >= buffers_.size()) fail("the buffer of its view is out of range");
    const Bytes& bytes = buffers_[buffer];
    if (offset > bytes.size() || length > bytes.size() - offset) fail("its view lies outside of its buffer");
    return std::span(bytes).subspan(offset, length);
  }

  Target targetOf(const json& index, std::int64_t uniqueId) {
    const json& accessor = element("accessors", index, "accessor");
    Target target;
    target.accessor = index.get<std::size_t>();
    target.uniqueId = uniqueId;
    target.count = unsignedMember(accessor, "count", 0, file_);
    target.components = componentsOf(accessor);
    target.componentType =
        static_cast<int>(std::min<std::uint64_t>(unsignedMember(accessor, "componentType", 0, file_), 1U << 16U));
    if (target.elementBytes() == 0) fail(fmt::format("accessor {} has no type for vertices", target.accessor));
    if (target.count == 0) fail(fmt::format("accessor {} has no elements", target.accessor));
    if (target.count > limits_.maxAccessorElements)
      fail(fmt::format("accessor {} has {} elements, the limit is {}", target.accessor, target.count,
                       limits_.maxAccessorElements),
           ErrorCode::kLimit);
    return target;
  }

  Target indicesOf(const json& primitive) {
    if (primitive.value("mode", json(4)) != 4) {
      if (primitive["mode"] == 5) fail("triangle strips cannot be read", ErrorCode::kUnsupported);
      fail("the primitive has no triangles");
    }
    if (!primitive.contains("indices")) fail("the primitive has no indices");
    const Target indices = targetOf(primitive["indices"], Target::kIndices);
    if (indices.components != 1 || indices.count % 3 != 0 ||
        (indices.componentType != TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE &&
         indices.componentType != TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT &&
         indices.componentType != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT))
      fail("the accessor of its indices cannot hold triangles");
    return indices;
  }

  /// The accessors that a stream fills, indices first; all have one number of vertices.
  std::vector<Target> targetsOf(const json& primitive, const json& extension) {
    if (!extension.is_object()) fail("not an object");
    std::vector<Target> targets = {indicesOf(primitive)};
    const auto ids = extension.find("attributes");
    if (ids == extension.end() || !ids->is_object() || ids->empty()) fail("it has no attributes");
    for (const auto& [name, id] : ids->items()) {
      const auto index = primitive["attributes"].find(name);
      if (index == primitive["attributes"].end()) fail(fmt::format("the primitive has no attribute {}", oneLine(name)));
      if (!id.is_number_unsigned() || id.get<std::uint64_t>() > std::numeric_limits<std::uint32_t>::max())
        fail(fmt::format("the number of {} is none", oneLine(name)));
      targets.push_back(targetOf(*index, id.get<std::int64_t>()));
      if (targets.back().count != targets[1].count) fail("its accessors differ in their number of vertices");
    }
    return targets;
  }

  /// Counts what a primitive unfolds to. Errors: kLimit.
  void account(const std::vector<Target>& targets) {
    std::uint64_t bytes = targets[0].count * kCornerBytes;
    for (const Target& target : targets)
      bytes += target.count * target.stride();
    if (bytes > room_) fail(fmt::format("{} bytes are more than the file may unfold to", bytes), ErrorCode::kLimit);
    room_ -= bytes;
  }

  template <class Decoder>
  void decodeWith(const Expected& expected, draco::DecoderBuffer stream, draco::Mesh& mesh) const {
    Decoder decoder(expected);
    const draco::DecoderOptions options;
    const draco::Status status = decoder.Decode(options, &stream, &mesh);
    if (!decoder.reason().empty()) fail(decoder.reason());
    if (!status.ok()) fail(fmt::format("the data does not decode: {}", oneLine(status.error_msg_string())));
    if (mesh.num_faces() != expected.faces || mesh.num_points() != expected.points)
      fail("the data decodes to another mesh than it announces");
  }

  void decodeStream(std::span<const unsigned char> bytes, const Expected& expected, draco::Mesh& mesh) const {
    draco::DecoderBuffer stream;
    stream.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    draco::DecoderBuffer ahead = stream;
    draco::DracoHeader header{};
    if (!draco::PointCloudDecoder::DecodeHeader(&ahead, &header).ok()) fail("the data has no header of Draco");
    if (header.version_major != 2 || header.version_minor != 2)
      fail(fmt::format("version {}.{} of the bitstream, only 2.2 is read", header.version_major, header.version_minor),
           ErrorCode::kUnsupported);
    if (header.encoder_type != draco::TRIANGULAR_MESH) fail("the data is no mesh");
    if (header.encoder_method == draco::MESH_EDGEBREAKER_ENCODING) {
      decodeWith<Edgebreaker>(expected, stream, mesh);
    } else if (header.encoder_method == draco::MESH_SEQUENTIAL_ENCODING) {
      decodeWith<Sequential>(expected, stream, mesh);
    } else {
      fail("the data has an unknown method");
    }
  }

  template <class T>
  void fillWith(const draco::Mesh& mesh, const Target& target, unsigned char* out, json& accessor) const {
    std::array<T, 8> range{};
    if (target.uniqueId == Target::kIndices) {
      if constexpr (std::is_unsigned_v<T>)
        if (!copyCorners<T>(mesh, target, out, range)) fail("a triangle has a vertex that the accessor cannot hold");
    } else {
      const draco::PointAttribute* source = mesh.GetAttributeByUniqueId(static_cast<std::uint32_t>(target.uniqueId));
      if (source == nullptr) fail(fmt::format("the data has no attribute {}", target.uniqueId));
      if (source->num_components() != target.components)
        fail(fmt::format("attribute {} has {} components, accessor {} has {}", target.uniqueId,
                         source->num_components(), target.accessor, target.components));
      if (!copyValues<T>(*source, target, out, range))
        fail(fmt::format("attribute {} has values that accessor {} cannot hold", target.uniqueId, target.accessor));
    }
    if (!accessor.contains("min") && !accessor.contains("max")) return;
    accessor["min"] = std::vector<T>(range.begin(), range.begin() + target.components);
    accessor["max"] = std::vector<T>(range.begin() + 4, range.begin() + 4 + target.components);
  }

  void fill(const draco::Mesh& mesh, const Target& target, unsigned char* out, json& accessor) const {
    switch (target.componentType) {
      case TINYGLTF_COMPONENT_TYPE_BYTE:
        return fillWith<std::int8_t>(mesh, target, out, accessor);
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return fillWith<std::uint8_t>(mesh, target, out, accessor);
      case TINYGLTF_COMPONENT_TYPE_SHORT:
        return fillWith<std::int16_t>(mesh, target, out, accessor);
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return fillWith<std::uint16_t>(mesh, target, out, accessor);
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        return fillWith<std::uint32_t>(mesh, target, out, accessor);
      default:
        return fillWith<float>(mesh, target, out, accessor);
    }
  }

  /// Appends a buffer with the values of all targets, and a view of it for each accessor.
  void store(const draco::Mesh& mesh, const std::vector<Target>& targets) {
    Bytes bytes;
    for (const Target& target : targets) {
      const std::size_t offset = bytes.size();
      const std::size_t length = target.count * target.stride();
      bytes.resize(offset + (length + 3) / 4 * 4);
      json& accessor = document_["accessors"][target.accessor];
      fill(mesh, target, bytes.data() + offset, accessor);
      json view = {{"buffer", buffers_.size()}, {"byteOffset", offset}, {"byteLength", length}};
      const bool isIndices = target.uniqueId == Target::kIndices;
      view["target"] = isIndices ? TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER : TINYGLTF_TARGET_ARRAY_BUFFER;
      if (!isIndices) view["byteStride"] = target.stride();
      accessor["bufferView"] = document_["bufferViews"].size();
      accessor.erase("byteOffset");
      document_["bufferViews"].push_back(std::move(view));
    }
    document_["buffers"].push_back({{"byteLength", bytes.size()}, {"uri", fmt::format("buffer/{}", buffers_.size())}});
    buffers_.push_back(std::move(bytes));
  }

  /// Repoints a primitive to copies of the accessors that another stream has filled already.
  /// @return  whether any accessor is still to be filled
  bool settleAccessors(json& primitive, const json& extension) {
    const auto view = extension["bufferView"].get<std::uint64_t>();
    bool isAnyNew = false;
    const auto settle = [&](json& index, std::int64_t uniqueId) {
      const std::pair source(view, uniqueId);
      const auto [filled, isNew] = filled_.try_emplace(index.get<std::size_t>(), source);
      isAnyNew = isAnyNew || isNew || filled->second != source;
      if (isNew || filled->second == source) return;
      json copy = document_["accessors"][index.get<std::size_t>()];
      copy.erase("bufferView");
      index = document_["accessors"].size();
      document_["accessors"].push_back(std::move(copy));
      filled_.try_emplace(index.get<std::size_t>(), source);
    };
    settle(primitive["indices"], Target::kIndices);
    for (const auto& [name, id] : extension["attributes"].items())
      settle(primitive["attributes"][name], id.get<std::int64_t>());
    return isAnyNew;
  }

  void decodePrimitive(json& primitive, const json& extension) {
    targetsOf(primitive, extension);  // checks everything that the next lines take for granted
    const std::span<const unsigned char> stream = streamOf(extension);
    if (!settleAccessors(primitive, extension)) return;
    const std::vector<Target> targets = targetsOf(primitive, extension);
    account(targets);
    draco::Mesh mesh;
    decodeStream(stream, {targets[1].count, targets[0].count / 3, kFreeDracoBytes + kMaxDracoExpansion * stream.size()},
                 mesh);
    store(mesh, targets);
  }

  json& document_;
  std::vector<Bytes>& buffers_;
  const Limits& limits_;
  const Path& file_;
  std::uint64_t room_ = 0;  ///< bytes that may still be decoded
  std::size_t mesh_ = 0;
  std::map<std::size_t, std::pair<std::uint64_t, std::int64_t>> filled_;  ///< accessor -> view and attribute
};

}  // namespace

void decodeDracoPrimitives(json& document, std::vector<Bytes>& buffers, const Limits& limits, const Path& file) {
  forgetExtension(document, kDraco);
  DracoReader(document, buffers, limits, file).run();
}

}  // namespace jalousie::asset::detail
