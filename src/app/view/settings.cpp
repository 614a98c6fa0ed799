// Settings of the interface as a JSON file.
#include "app/view/settings.h"

#include <algorithm>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string_view>
#include <vector>

#include "core/error.h"
#include "core/file.h"

namespace jalousie::app {
namespace {

constexpr std::uint64_t kMaxSettingsBytes = 4U << 20U;
constexpr const char* kFileName = "view.json";

nlohmann::json poseJson(const WorldPose& pose) {
  return {pose.eye.x, pose.eye.y, pose.eye.z, pose.look.x, pose.look.y, pose.look.z};
}

std::optional<WorldPose> poseFrom(const nlohmann::json& json) {
  const auto n = json.get<std::array<double, 6>>();
  const WorldPose pose{{n[0], n[1], n[2]}, {n[3], n[4], n[5]}};
  return isUsable(pose) ? std::optional(pose) : std::nullopt;
}

/// Reads a member if it exists and has the right type.
template <class Value>
void take(const nlohmann::json& root, const char* name, Value& value) {
  try {
    value = root.value(name, value);
  } catch (const nlohmann::json::exception&) {
    return;
  }
}

/// Reads a side of the window if it is in [64, 16384].
void takeSide(const nlohmann::json& root, const char* name, std::uint32_t& side) {
  std::int64_t value = side;
  take(root, name, value);
  if (value >= 64 && value <= 16384) side = static_cast<std::uint32_t>(value);
}

void takeBookmark(const std::string& number, const nlohmann::json& pose, Bookmarks& marks) {
  if (number.size() != 1 || number[0] < '0' || number[0] >= static_cast<char>('0' + kBookmarks)) return;
  try {
    marks[static_cast<std::size_t>(number[0] - '0')] = poseFrom(pose);
  } catch (const nlohmann::json::exception&) {
    return;
  }
}

void read(const nlohmann::json& root, ViewSettings& settings) {
  take(root, "panel", settings.panel);
  take(root, "graph", settings.graph);
  take(root, "objects", settings.objects);
  take(root, "speed", settings.speed);
  takeSide(root, "width", settings.width);
  takeSide(root, "height", settings.height);
  take(root, "layout", settings.layout);
  settings.speed = std::clamp(settings.speed, kLeastSpeed, kMostSpeed);
  take(root, "recent", settings.recent);
  if (settings.recent.size() > kMostRecent) settings.recent.resize(kMostRecent);
  const auto all = root.find("bookmarks");
  if (all == root.end() || !all->is_object()) return;
  for (const auto& [file, marks] : all->items()) {
    if (!marks.is_object()) continue;
    for (const auto& [number, pose] : marks.items())
      takeBookmark(number, pose, settings.bookmarks[file]);
  }
}

}  // namespace

std::filesystem::path settingsFolder() {
  const char* config = std::getenv("XDG_CONFIG_HOME");
  if (config != nullptr && *config == '/') return std::filesystem::path(config) / "jalousie";
  const char* home = std::getenv("HOME");
  if (home == nullptr || *home == '\0') return {};
  return std::filesystem::path(home) / ".config" / "jalousie";
}

ViewSettings loadSettings(const std::filesystem::path& folder) noexcept {
  try {
    ViewSettings settings;
    const std::vector<std::byte> bytes = readFile(folder / kFileName, kMaxSettingsBytes);
    read(nlohmann::json::parse(std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size())), settings);
    return settings;
  } catch (const std::exception&) {
    return {};
  }
}

void addRecent(ViewSettings& settings, const std::string& file) {
  std::erase(settings.recent, file);
  settings.recent.insert(settings.recent.begin(), file);
  if (settings.recent.size() > kMostRecent) settings.recent.resize(kMostRecent);
}

void mergeBookmarks(ViewSettings& settings, const ViewSettings& others) {
  for (const auto& [file, marks] : others.bookmarks)
    for (std::size_t i = 0; i < kBookmarks; ++i)
      if (std::optional<WorldPose>& mark = settings.bookmarks[file][i]; !mark) mark = marks[i];
}

void saveSettings(const ViewSettings& settings, const std::filesystem::path& folder) {
  if (folder.empty()) return;
  nlohmann::ordered_json root;
  root["panel"] = settings.panel;
  root["graph"] = settings.graph;
  root["objects"] = settings.objects;
  root["speed"] = settings.speed;
  root["width"] = settings.width;
  root["height"] = settings.height;
  root["layout"] = settings.layout;
  root["recent"] = settings.recent;
  root["bookmarks"] = nlohmann::ordered_json::object();
  for (const auto& [file, marks] : settings.bookmarks)
    for (std::size_t i = 0; i < kBookmarks; ++i)
      if (marks[i]) root["bookmarks"][file][std::to_string(i)] = poseJson(*marks[i]);
  std::error_code failed;
  std::filesystem::create_directories(folder, failed);
  if (failed) throw Error(ErrorCode::kWriteFailed, "cannot make the folder: " + failed.message(), folder);
  writeFileAtomic(folder / kFileName, root.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
}

}  // namespace jalousie::app
