// Looks entries up and verifies every file by its hash.
#include "bake/pipeline/cache.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <system_error>
#include <utility>

#include "bake/io/import.h"
#include "bake/pipeline/digest.h"
#include "core/confined_folder.h"
#include "core/error.h"
#include "core/file.h"

namespace jalousie::bake {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr int kFormat = 1;
constexpr std::uint64_t kMaxEntryBytes = 64ULL << 20U;
constexpr std::uint64_t kMaxObjectBytes = 16ULL << 30U;

/// The JSON of an entry; nullopt if a path is not UTF-8.
std::optional<std::string> entryText(const std::vector<ReadFile>& read, const CacheEntry& entry) {
  json document = {{"format", kFormat}, {"output", sha256(entry.output)}, {"sheet", nullptr}};
  if (!entry.sheet.empty()) document["sheet"] = sha256(entry.sheet);
  document["report"] = entry.report;
  document["table"] = entry.table;
  document["read"] = json::array();
  for (const ReadFile& file : read)
    document["read"].push_back(
        {{"input", file.input}, {"name", file.name}, {"sha256", file.sha256 ? json(*file.sha256) : json()}});
  try {
    return document.dump(1) + "\n";
  } catch (const json::exception&) {
    return std::nullopt;
  }
}

void touch(const fs::path& path) {
  ::utimensat(AT_FDCWD, path.c_str(), nullptr, 0);
}

std::vector<ReadFile> readList(const json& document) {
  std::vector<ReadFile> read;
  for (const json& file : document.at("read")) {
    read.push_back({file.at("input").get<std::size_t>(), file.at("name").get<std::string>(), std::nullopt});
    if (file.at("sha256").is_string()) read.back().sha256 = file.at("sha256").get<std::string>();
  }
  return read;
}

/// Whether every side file still has its old content. Names are resolved within the input's folder, as in the bake.
bool stillHolds(const std::vector<ReadFile>& read, const BakeJob& job, const asset::Limits& limits) {
  for (const ReadFile& file : read) {
    if (file.name.empty()) continue;  // inputs are part of the key
    if (file.input >= job.inputs.size()) return false;
    const fs::path& input = job.inputs[file.input];
    std::optional<std::string> now;
    try {
      const ConfinedFolder folder(folderOf(input));
      now = sha256(folder.readFile(file.name, limits.maxFileBytes));
    } catch (const Error& error) {
      if (error.code() != ErrorCode::kFileNotFound) return false;
    }
    if (now != file.sha256) return false;
  }
  return true;
}

}  // namespace

Cache::Cache(fs::path folder, std::string identity) : folder_(std::move(folder)), identity_(std::move(identity)) {}

fs::path Cache::entryFolder(const BakeJob& job, const std::vector<ReadFile>& inputs) const {
  std::string text = identity_ + "\n";
  for (std::size_t i = 0; i < job.inputs.size(); ++i) {
    // PLY and OBJ files name their meshes by the file's name; glTF files contain the names.
    const std::string name = isGltf(job.inputs[i]) ? std::string("glTF") : job.inputs[i].filename().string();
    text += fmt::format("{}:{} {}\n", name.size(), name, inputs[i].sha256.value_or(""));
  }
  if (!job.sheet.empty()) text += "sheet " + job.output.filename().string() + "\n";
  const std::string key = sha256(text);
  return folder_ / "entries" / key.substr(0, 2) / key;
}

fs::path Cache::objectPath(const std::string& digest) const {
  return folder_ / "objects" / digest.substr(0, 2) / digest;
}

std::optional<std::vector<std::byte>> Cache::object(const std::string& digest) const {
  const bool isDigest = digest.size() == 64 && digest.find_first_not_of("0123456789abcdef") == std::string::npos;
  if (!isDigest) return std::nullopt;
  try {
    std::vector<std::byte> bytes = readFile(objectPath(digest), kMaxObjectBytes);
    if (sha256(bytes) != digest) return std::nullopt;
    touch(objectPath(digest));
    return bytes;
  } catch (const Error&) {
    return std::nullopt;
  }
}

std::optional<CacheEntry> Cache::find(const BakeJob& job, const asset::Limits& limits,
                                      std::vector<ReadFile>& read) const {
  std::vector<ReadFile> inputs;
  for (std::size_t i = 0; i < job.inputs.size(); ++i)
    inputs.push_back({i, {}, sha256(readFile(job.inputs[i], limits.maxFileBytes))});
  std::error_code failed;
  for (const fs::directory_entry& file : fs::directory_iterator(entryFolder(job, inputs), failed)) {
    try {
      const std::vector<std::byte> bytes = readFile(file.path(), kMaxEntryBytes);
      const json document = json::parse(reinterpret_cast<const char*>(bytes.data()),
                                        reinterpret_cast<const char*>(bytes.data()) + bytes.size());
      if (document.at("format") != kFormat) continue;
      std::vector<ReadFile> list = readList(document);
      if (!stillHolds(list, job, limits)) continue;
      std::optional<std::vector<std::byte>> output = object(document.at("output").get<std::string>());
      std::optional<std::vector<std::byte>> sheet = std::vector<std::byte>();
      if (document.at("sheet").is_string()) sheet = object(document.at("sheet").get<std::string>());
      if (!output || !sheet) continue;
      touch(file.path());
      read = std::move(list);
      return CacheEntry{std::move(*output), std::move(*sheet), document.at("report").get<std::string>(),
                        document.at("table").get<std::string>()};
    } catch (const Error&) {
      continue;
    } catch (const json::exception&) {
      continue;
    }
  }
  return std::nullopt;
}

void Cache::storeObject(const std::string& digest, std::span<const std::byte> bytes) const {
  if (object(digest)) return;
  fs::create_directories(objectPath(digest).parent_path());
  writeFileAtomic(objectPath(digest), bytes);
}

void Cache::store(const BakeJob& job, const std::vector<ReadFile>& read, const CacheEntry& entry) const {
  const std::optional<std::string> text = entryText(read, entry);
  if (!text) return;
  std::vector<ReadFile> inputs;
  std::copy_if(read.begin(), read.end(), std::back_inserter(inputs),
               [](const ReadFile& file) { return file.name.empty(); });
  const fs::path folder = entryFolder(job, inputs);
  try {
    storeObject(sha256(entry.output), entry.output);
    if (!entry.sheet.empty()) storeObject(sha256(entry.sheet), entry.sheet);
    fs::create_directories(folder);
    writeFileAtomic(folder / (sha256(*text) + ".json"), *text);  // last, so that an entry never names missing objects
  } catch (const fs::filesystem_error& error) {
    throw Error(ErrorCode::kWriteFailed, "cannot write to the cache: " + error.code().message(), folder_);
  }
}

void trimCache(const fs::path& folder, std::uint64_t maxBytes) noexcept {
  struct Kept {
    fs::file_time_type used;
    std::uint64_t bytes;
    fs::path path;
  };
  try {
    std::vector<Kept> files;
    std::uint64_t total = 0;
    for (const char* part : {"entries", "objects"}) {
      std::error_code absent;
      for (const fs::directory_entry& file : fs::recursive_directory_iterator(folder / part, absent)) {
        std::error_code gone;  // another process may trim at the same time
        if (!file.is_regular_file(gone) || gone) continue;
        const Kept kept{file.last_write_time(gone), file.file_size(gone), file.path()};
        if (gone) continue;
        total += kept.bytes;
        files.push_back(kept);
      }
    }
    std::sort(files.begin(), files.end(),
              [](const Kept& a, const Kept& b) { return a.used != b.used ? a.used < b.used : a.path < b.path; });
    for (const Kept& file : files) {
      if (total <= maxBytes) return;
      std::error_code gone;
      if (fs::remove(file.path, gone)) total -= file.bytes;
    }
  } catch (const std::exception&) {
    return;
  }
}

}  // namespace jalousie::bake
