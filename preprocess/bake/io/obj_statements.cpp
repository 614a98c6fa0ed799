// One pass over the lines; indices are checked when all vertices are known.
#include "bake/io/obj_statements.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <map>
#include <string_view>

#include "bake/io/color_space.h"
#include "core/error.h"

namespace jalousie::bake {
namespace {

constexpr std::size_t kMaxName = 4096;

using Words = std::vector<std::string_view>;

class Reader {
 public:
  Reader(std::string_view text, const std::filesystem::path& file, Notes& notes)
      : text_(withoutByteOrderMark(text)), file_(file), notes_(notes) {
    if (text.find('\0') != std::string_view::npos) throw Error(ErrorCode::kMalformed, "not an OBJ file", file);
  }

  ObjStatements run() {
    Words words;
    while (at_ < text_.size()) {
      nextLine(words);
      if (!words.empty()) statement(words);
    }
    checkIndices();
    settleObjects();
    settleColors();
    return std::move(result_);
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
    if (keyword == "v") return position(words);
    if (keyword == "vn") return normal(words);
    if (keyword == "vt") return uv(words);
    if (keyword == "f") return face(words);
    if (keyword == "o") return name(words, object_, hasObjects_);
    if (keyword == "g") return name(words, group_, hasGroups_);
    if (keyword == "s") return smoothing(words);
    if (keyword == "usemtl") return useMaterial(words);
    if (keyword == "mtllib") {
      for (std::size_t i = 1; i < words.size(); ++i)
        result_.libraries.push_back(checkedName(words[i]));
      if (words.size() > 2) result_.libraries.push_back(joined(words));  // one name with spaces
      return;
    }
    if (keyword == "p" || keyword == "l") return notes_.add("points and lines of the OBJ file are left out", place());
    if (!keyword.starts_with('#')) notes_.add("OBJ statements are passed over", std::string(keyword.substr(0, 40)));
  }

  std::string place() const { return fmt::format("line {}", line_); }

  double number(const Words& words, std::size_t i) const {
    std::string_view word = words[i];
    if (word.starts_with('+')) word.remove_prefix(1);
    double value = 0.0;
    const auto [end, status] = std::from_chars(word.data(), word.data() + word.size(), value);
    const bool isNumber = status == std::errc() && end == word.data() + word.size();
    if (!isNumber || !std::isfinite(value)) fail("not a finite number");
    if (!std::isfinite(static_cast<float>(value))) fail("a number that is too large for single precision");
    if (word.size() > 64)
      throw Error(ErrorCode::kLimit, fmt::format("line {}: a number of {} digits", line_, word.size()), file_);
    return value;
  }

  glm::dvec3 three(const Words& words, std::size_t first) const {
    if (words.size() < first + 3) fail(fmt::format("'{}' without 3 numbers", words[0]));
    return {number(words, first), number(words, first + 1), number(words, first + 2)};
  }

  void position(const Words& words) {
    PolygonMesh& mesh = result_.mesh;
    mesh.positions.push_back(three(words, 1));
    if (words.size() < 7) return;
    mesh.colors.resize(mesh.positions.size() - 1, glm::vec4(1.0F));
    ++colorCount_;
    mesh.colors.emplace_back(glm::vec3(three(words, words.size() == 7 ? 4 : words.size() - 3)), 1.0F);
  }

  void normal(const Words& words) { result_.mesh.normals.emplace_back(three(words, 1)); }

  void uv(const Words& words) {
    if (words.size() < 2) fail("'vt' without a number");
    const double v = words.size() > 2 ? number(words, 2) : 0.0;
    result_.mesh.uvs.emplace_back(number(words, 1), 1.0 - v);
  }

  /// An index of a list of which `count` elements are known: from 1, or backwards from -1. Out of range: later.
  std::uint32_t index(std::string_view word, std::size_t count) const {
    std::int32_t value = 0;
    const auto [end, status] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (status != std::errc() || end != word.data() + word.size() || value == 0)
      fail("a face has a corner that is no index");
    const std::int64_t place = value > 0 ? std::int64_t{value} - 1 : static_cast<std::int64_t>(count) + value;
    if (place < 0) fail("a face has an index out of range");
    return static_cast<std::uint32_t>(place);
  }

  PolygonMesh::Corner corner(std::string_view word) const {
    const PolygonMesh& mesh = result_.mesh;
    const std::size_t first = std::min(word.find('/'), word.size());
    const std::size_t second = std::min(word.find('/', first + 1), word.size());
    PolygonMesh::Corner corner;
    corner.position = index(word.substr(0, first), mesh.positions.size());
    if (first == word.size()) return corner;
    const std::string_view uv = word.substr(first + 1, second - first - 1);
    const bool hasNormal = second < word.size();
    if (!uv.empty() || !hasNormal) corner.uv = index(uv, mesh.uvs.size());
    if (hasNormal) corner.normal = index(word.substr(second + 1), mesh.normals.size());
    return corner;
  }

  void face(const Words& words) {
    PolygonMesh& mesh = result_.mesh;
    const std::size_t first = mesh.corners.size();
    for (std::size_t i = 1; i < words.size(); ++i)
      mesh.corners.push_back(corner(words[i]));
    if (words.size() < 4) {  // points and lines in disguise
      notes_.add("OBJ faces of fewer than three corners are left out", place());
      return mesh.corners.resize(first);
    }
    if (words.size() > kMaxPolygonCorners + 1) {
      notes_.add(fmt::format("OBJ faces of over {} corners are left out", kMaxPolygonCorners), place());
      return mesh.corners.resize(first);
    }
    if (mesh.corners.size() >= kNoIndex) throw Error(ErrorCode::kLimit, "the faces have too many corners", file_);
    PolygonMesh::Face face;
    face.end = static_cast<std::uint32_t>(mesh.corners.size());
    face.object = objectNumber();
    face.material = material_;
    face.smoothing = smoothing_;
    mesh.faces.push_back(face);
    lineOfFace_.push_back(line_);
    if (groupOfFace_.empty() || groupOfFace_.back().second != groupNumber_)
      groupOfFace_.emplace_back(mesh.faces.size() - 1, groupNumber_);
  }

  std::string checkedName(std::string_view text) const {
    if (text.size() > kMaxName)
      throw Error(ErrorCode::kLimit, fmt::format("line {}: a name of over {} bytes", line_, kMaxName), file_);
    return std::string(text);
  }

  std::string joined(const Words& words) const {
    std::string text;
    for (std::size_t i = 1; i < words.size(); ++i) {
      text += (text.empty() ? "" : " ") + std::string(words[i]);
      checkedName(text);
    }
    return text;
  }

  void name(const Words& words, std::string& target, bool& has) {
    target = joined(words);
    has = true;
    objectNumber_ = kNoIndex;
    groupNumber_ = number(groups_, group_);
  }

  static std::uint32_t number(std::map<std::string, std::uint32_t>& numbers, const std::string& name) {
    return numbers.try_emplace(name, static_cast<std::uint32_t>(numbers.size())).first->second;
  }

  std::uint32_t objectNumber() {
    if (objectNumber_ == kNoIndex) objectNumber_ = number(objects_, object_);
    return objectNumber_;
  }

  void smoothing(const Words& words) {
    result_.mesh.hasSmoothing = true;
    smoothing_ = 0;
    if (words.size() < 2 || words[1] == "off") return;
    const auto [end, status] = std::from_chars(words[1].data(), words[1].data() + words[1].size(), smoothing_);
    if (words[1] == "on") smoothing_ = 1;
    if (words[1] != "on" && (status != std::errc() || end != words[1].data() + words[1].size())) smoothing_ = 0;
  }

  void useMaterial(const Words& words) {
    const std::string name = joined(words);
    const auto [place, isNew] = materials_.try_emplace(name, static_cast<int>(materials_.size()));
    if (isNew) {
      result_.mesh.materials.emplace_back();
      result_.mesh.materials.back().name = name;
    }
    material_ = place->second;
  }

  /// Indices may name what comes later in the file.
  void checkIndices() {
    const PolygonMesh& mesh = result_.mesh;
    std::size_t c = 0;
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
      line_ = lineOfFace_[f];
      for (; c < mesh.faces[f].end; ++c) {
        const PolygonMesh::Corner& corner = mesh.corners[c];
        requireIndex(corner.position, mesh.positions.size(), "vertex");
        if (corner.uv != kNoIndex) requireIndex(corner.uv, mesh.uvs.size(), "texture coordinate");
        if (corner.normal != kNoIndex) requireIndex(corner.normal, mesh.normals.size(), "normal");
      }
    }
  }

  void requireIndex(std::uint32_t index, std::size_t count, const char* what) const {
    if (index < count) return;
    fail(fmt::format("a face has an index out of range: {} {} of {}", what, std::uint64_t{index} + 1, count));
  }

  /// Names the objects; in files without objects, the groups take their place.
  void settleObjects() {
    PolygonMesh& mesh = result_.mesh;
    const bool byGroup = !hasObjects_ && hasGroups_;
    const std::map<std::string, std::uint32_t>& numbers = byGroup ? groups_ : objects_;
    mesh.objects.assign(std::max<std::size_t>(numbers.size(), 1), std::string());
    for (const auto& [name, number] : numbers)
      mesh.objects[number] = name;
    if (!byGroup) return;
    for (std::size_t i = 0; i < groupOfFace_.size(); ++i) {
      const std::size_t end = i + 1 < groupOfFace_.size() ? groupOfFace_[i + 1].first : mesh.faces.size();
      for (std::size_t f = groupOfFace_[i].first; f < end; ++f)
        mesh.faces[f].object = groupOfFace_[i].second;
    }
  }

  /// Shares of one with a stray value above are told from shares of 255, which reach further.
  void settleColors() {
    std::vector<glm::vec4>& colors = result_.mesh.colors;
    if (colors.empty()) return;
    if (colorCount_ < result_.mesh.positions.size())
      notes_.add("vertices without a colour become white",
                 fmt::format("{} of {}", result_.mesh.positions.size() - colorCount_, result_.mesh.positions.size()));
    colors.resize(result_.mesh.positions.size(), glm::vec4(1.0F));
    const auto most = [](const glm::vec4& c) { return std::max({c.r, c.g, c.b}); };
    constexpr float kMostOfOne = 4.0F;
    const bool inBytes =
        std::any_of(colors.begin(), colors.end(), [&](const glm::vec4& c) { return most(c) > kMostOfOne; });
    const float limit = inBytes ? 255.0F : 1.0F;
    for (const glm::vec4& c : colors)
      if (most(c) > limit || std::min({c.r, c.g, c.b}) < 0.0F)
        notes_.add(fmt::format("vertex colours outside of 0 to {:g} are clamped", limit),
                   fmt::format("{:g} {:g} {:g}", c.r, c.g, c.b));
    for (glm::vec4& color : colors)
      for (int k = 0; k < 3; ++k)
        color[k] = linearFromSrgb(std::clamp(inBytes ? color[k] / 255.0F : color[k], 0.0F, 1.0F));
  }

  std::string_view text_;
  const std::filesystem::path& file_;
  Notes& notes_;
  std::size_t at_ = 0;
  std::uint64_t line_ = 0;
  std::vector<std::uint64_t> lineOfFace_;
  std::size_t colorCount_ = 0;  ///< vertices with a colour
  ObjStatements result_;
  std::string object_, group_;
  bool hasObjects_ = false;
  bool hasGroups_ = false;
  std::map<std::string, std::uint32_t> objects_;
  std::map<std::string, std::uint32_t> groups_{{std::string(), 0U}};
  std::map<std::string, int> materials_;
  std::vector<std::pair<std::size_t, std::uint32_t>> groupOfFace_;  ///< face from which on, number of the group
  std::uint32_t objectNumber_ = kNoIndex;
  std::uint32_t groupNumber_ = 0;
  std::uint32_t smoothing_ = 0;
  int material_ = -1;
};

}  // namespace

ObjStatements readObjStatements(std::span<const std::byte> bytes, const std::filesystem::path& file, Notes& notes) {
  return Reader({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, file, notes).run();
}

std::string_view withoutByteOrderMark(std::string_view text) {
  constexpr std::string_view kMark = "\xEF\xBB\xBF";
  if (text.starts_with(kMark)) text.remove_prefix(kMark.size());
  return text;
}

}  // namespace jalousie::bake
