// Looks in the cache; on a miss imports, bakes, encodes and stores; then writes.
#include "bake/pipeline/job.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>

#include <optional>

#include "asset/gltf_quantize.h"
#include "bake/io/bake_document.h"
#include "bake/io/bake_occluders.h"
#include "bake/io/import.h"
#include "bake/io/read_back.h"
#include "bake/pipeline/cache.h"
#include "bake/pipeline/digest.h"
#include "bake/report/report.h"
#include "bake/report/sheet.h"
#include "core/error.h"
#include "core/file.h"

namespace jalousie::bake {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> dependencyPaths(const BakeJob& job, const std::vector<ReadFile>& read) {
  std::vector<fs::path> paths = job.inputs;
  for (const ReadFile& file : read)
    if (!file.name.empty() && file.sha256) paths.push_back(job.inputs[file.input].parent_path() / file.name);
  return paths;
}

/// Whether a file already has these bytes; false if it cannot be read.
bool holds(const fs::path& path, std::span<const std::byte> bytes) {
  std::error_code ignored;
  if (fs::file_size(path, ignored) != bytes.size()) return false;
  try {
    const std::vector<std::byte> there = readFile(path, bytes.size());
    return std::equal(there.begin(), there.end(), bytes.begin(), bytes.end());
  } catch (const Error&) {
    return false;
  }
}

/// Writes the file unless it already has these bytes. In that case only its time is set, for build tools that compare
/// times. @return  whether it already had these bytes
bool writeIfOther(const fs::path& path, std::span<const std::byte> bytes) {
  if (holds(path, bytes) && ::utimensat(AT_FDCWD, path.c_str(), nullptr, 0) == 0) return true;
  writeFileAtomic(path, bytes);
  return false;
}

void makeFolderOf(const fs::path& file) {
  std::error_code failed;
  if (file.has_parent_path()) fs::create_directories(file.parent_path(), failed);
  if (failed) throw Error(ErrorCode::kWriteFailed, "cannot make this folder: " + failed.message(), file.parent_path());
}

CacheEntry bake(const BakeJob& job, const JobSettings& settings, std::vector<ReadFile>& read,
                const std::function<void(const std::string&)>& progress) {
  Notes notes;
  tinygltf::Model model =
      importFiles(job.inputs, settings.bake.limits, notes,
                  [&](std::size_t input, const std::string& name, std::optional<std::span<const std::byte>> bytes) {
                    const auto hash = [&] { return settings.cache.empty() ? std::string() : sha256(*bytes); };
                    read.push_back({input, name, bytes ? std::optional(hash()) : std::nullopt});
                  });
  const std::vector<MeshReport> reports =
      bakeDocument(model, settings.bake, [&](std::size_t done, std::size_t total, const std::string& what) {
        progress(fmt::format("mesh {} of {}, {}", done + 1, total, what));
      });
  CacheEntry entry;
  if (!job.sheet.empty()) {
    SheetOptions options;
    options.title = job.output.filename().string();
    options.slices = settings.bake.chain.slices;
    const std::string page = sheetHtml(model, options);
    const auto bytes = std::as_bytes(std::span(page.data(), page.size()));
    entry.sheet.assign(bytes.begin(), bytes.end());
  }
  if (settings.quantize) asset::quantizeModel(model);
  bakeOccluders(model, settings.bake);
  entry.output = asset::encodeGlb(std::move(model), {settings.compress});
  requireReadable(entry.output, job.output);
  noteMeshes(reports, notes);
  entry.report = reportJson(settings.meshReports ? reports : std::vector<MeshReport>(), notes.lines());
  entry.table = reportText(reports);
  return entry;
}

}  // namespace

JobResult runJob(const BakeJob& job, const JobSettings& settings,
                 const std::function<void(const std::string&)>& progress) {
  std::optional<Cache> cache;
  if (!settings.cache.empty()) cache.emplace(settings.cache, settings.identity);
  std::vector<ReadFile> read;
  std::optional<CacheEntry> entry;
  if (cache) entry = cache->find(job, settings.bake.limits, read);
  const bool isHit = entry.has_value();
  if (!isHit) {
    read.clear();
    entry = bake(job, settings, read, progress);
  }
  if (settings.makeFolders) {
    makeFolderOf(job.output);
    makeFolderOf(job.sheet);
  }
  bool unchanged = isHit;
  if (!job.sheet.empty()) {
    unchanged = writeIfOther(job.sheet, entry->sheet) && unchanged;
  }
  unchanged = writeIfOther(job.output, entry->output) && unchanged;
  JobResult result;
  result.warnings = reportedWarnings(entry->report);
  try {
    if (cache && !isHit) cache->store(job, read, *entry);
  } catch (const Error& error) {  // the bake is done; only the next one will be slower
    result.warnings.emplace_back(error.what());
  }
  result.status = unchanged ? JobStatus::kUnchanged : isHit ? JobStatus::kCached : JobStatus::kBaked;
  result.dependencies = dependencyPaths(job, read);
  result.report = std::move(entry->report);
  result.table = std::move(entry->table);
  return result;
}

}  // namespace jalousie::bake
