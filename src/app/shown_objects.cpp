// Lists of objects as text, and back.
#include "app/shown_objects.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <map>
#include <optional>
#include <string_view>
#include <utility>

#include "app/option_values.h"
#include "core/error.h"
#include "core/standard_streams.h"

namespace jalousie::app {
namespace {

/// First and last object; the whole text must be one number, or two with a hyphen between them.
std::optional<std::pair<std::uint64_t, std::uint64_t>> rangeOf(std::string_view text) {
  const auto number = [](std::string_view digits) -> std::optional<std::uint64_t> {
    std::uint64_t value = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (digits.empty() || error != std::errc() || end != digits.data() + digits.size()) return std::nullopt;
    return value;
  };
  const std::size_t hyphen = text.find('-');
  const std::optional<std::uint64_t> first = number(text.substr(0, hyphen));
  const std::optional<std::uint64_t> last = hyphen == std::string_view::npos ? first : number(text.substr(hyphen + 1));
  if (!first || !last) return std::nullopt;
  return std::pair(*first, *last);
}

/// Marks the objects of one list.
class NameSelection {
 public:
  /// @param path  of the file, for errors
  NameSelection(const asset::SceneFile& file, const char* option, std::filesystem::path path)
      : file_(file), option_(option), path_(std::move(path)), chosen_(file.instances.size()) {}

  void add(const std::string& list) {
    for (const std::string& entry : split(list, ',')) {
      if (entry.empty()) refuse(entry, "an entry is empty");
      if (const auto range = rangeOf(entry))
        addRange(entry, *range);
      else
        names_.emplace(entry, false);
    }
    addNames();
  }
  const std::vector<bool>& chosen() const { return chosen_; }

 private:
  [[noreturn]] void refuse(const std::string& entry, const std::string& reason) const {
    throw Error(ErrorCode::kUsage, fmt::format("{} {}: {}", option_, oneLine(entry), reason), path_);
  }

  void addRange(const std::string& entry, const std::pair<std::uint64_t, std::uint64_t>& range) {
    if (range.first > range.second || range.second >= chosen_.size())
      refuse(entry, fmt::format("the file has the objects 0 to {}", chosen_.empty() ? 0 : chosen_.size() - 1));
    for (std::uint64_t i = range.first; i <= range.second; ++i)
      chosen_[i] = true;
  }

  void addNames() {
    if (names_.empty()) return;
    for (std::size_t i = 0; i < file_.instances.size(); ++i) {
      const asset::Instance& instance = file_.instances[i];
      const std::string& mesh = file_.meshes[file_.chains[instance.chain].levels.front().mesh].name;
      if (instance.node < file_.nodeNames.size()) take(file_.nodeNames[instance.node], i);
      take(mesh, i);
    }
    for (const auto& [name, found] : names_)
      if (!found) refuse(name, "no node or mesh that is drawn has this name; `jalousie view --list` shows the names");
  }

  void take(const std::string& name, std::size_t instance) {
    const auto known = names_.find(name);
    if (known == names_.end()) return;
    known->second = true;
    chosen_[instance] = true;
  }

  const asset::SceneFile& file_;
  const char* option_;
  std::filesystem::path path_;
  std::vector<bool> chosen_;
  std::map<std::string, bool> names_;  ///< and whether an object has the name
};

}  // namespace

std::vector<std::uint32_t> hiddenObjects(const asset::SceneFile& file, const RenderOptions& options) {
  std::vector<std::uint32_t> hidden;
  if (options.hide.empty() && options.only.empty()) return hidden;
  NameSelection out(file, "--hide", options.scene);
  NameSelection in(file, "--only", options.scene);
  if (!options.hide.empty()) out.add(options.hide);
  if (!options.only.empty()) in.add(options.only);
  for (std::size_t i = 0; i < file.instances.size(); ++i)
    if (out.chosen()[i] || (!options.only.empty() && !in.chosen()[i])) hidden.push_back(static_cast<std::uint32_t>(i));
  return hidden;
}

std::string objectList(const std::vector<std::uint32_t>& objects) {
  std::string text;
  for (std::size_t i = 0; i < objects.size();) {
    std::size_t end = i + 1;
    while (end < objects.size() && objects[end] == objects[end - 1] + 1)
      ++end;
    text += text.empty() ? "" : ",";
    text += end - i == 1 ? fmt::format("{}", objects[i]) : fmt::format("{}-{}", objects[i], objects[end - 1]);
    i = end;
  }
  return text;
}

void hideObjects(RenderOptions& options, const std::vector<std::uint32_t>& hidden, std::size_t count) {
  std::vector<std::uint32_t> shown;
  auto next = hidden.begin();
  for (std::uint32_t i = 0; i < count; ++i) {
    if (next != hidden.end() && *next == i)
      ++next;
    else
      shown.push_back(i);
  }
  const std::string hide = objectList(hidden);
  const std::string only = objectList(shown);
  const bool showsFew = !shown.empty() && only.size() < hide.size();
  options.hide = showsFew ? "" : hide;
  options.only = showsFew ? only : "";
}

scene::BuildOptions buildOptionsOf(const asset::SceneFile& file, const RenderOptions& options) {
  return {.patches = rowOf(options.frameOptions.detail).patches,
          .cells = options.cells,
          .faces = options.frameOptions.faceCulling != FaceCulling::kOff,
          .hidden = hiddenObjects(file, options)};
}

}  // namespace jalousie::app
