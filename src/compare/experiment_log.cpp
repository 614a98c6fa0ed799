// The log's format: a head with the fingerprint, then one object per step.
#include "compare/experiment_log.h"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <span>

#include "core/error.h"
#include "core/file.h"

namespace jalousie::compare {
namespace {

using nlohmann::json;

constexpr int kLogVersion = 1;
constexpr std::uint64_t kMaxLogBytes = 1ULL << 31U;

std::filesystem::path logFile(const std::filesystem::path& folder) {
  return folder / kLogName;
}

/// FNV-1a, 64 bits (Fowler, Noll, Vo).
class Hash {
 public:
  void bytes(std::span<const std::byte> data) {
    for (const std::byte b : data)
      state_ = (state_ ^ static_cast<std::uint64_t>(b)) * 0x100000001b3ULL;
  }
  template <class T>
  void values(const std::vector<T>& data) {
    value(data.size());
    bytes(std::as_bytes(std::span(data)));
  }
  template <class T>
  void value(const T& data) {
    bytes(std::as_bytes(std::span(&data, 1)));
  }
  void text(const std::string& data) {
    value(data.size());
    bytes(std::as_bytes(std::span(data.data(), data.size())));
  }
  std::string digits() const { return fmt::format("{:016x}", state_); }

 private:
  std::uint64_t state_ = 0xcbf29ce484222325ULL;
};

void addScene(Hash& hash, const scene::SceneData& scene, const asset::Camera& path, const Plan& plan) {
  hash.values(scene.vertices);
  hash.values(scene.indices);
  hash.value(scene.objects.size());
  for (const gpu::Object& object : scene.objects)
    hash.value(scene.transforms[object.transform]);
  hash.value(scene.objects.size());
  for (const gpu::Object& object : scene.objects) {
    hash.value(object.chain);
    hash.value(object.owner);
  }
  hash.values(scene.chains);
  hash.values(scene.lods);
  hash.values(scene.materials);
  for (const std::vector<ImageRgba8>& layer : scene.textures.layers)
    if (!layer.empty()) hash.values(layer.front().pixels);
  hash.value(path.fovY);
  hash.value(path.zNear);
  hash.value(path.zFar.value_or(0.0F));
  hash.value(path.worldFromCamera);
  hash.value(path.worldFromParent);
  hash.values(path.track.translationTimes);
  hash.values(path.track.translations);
  hash.values(path.track.rotationTimes);
  hash.values(path.track.rotations);
  hash.value(plan.width);
  hash.value(plan.height);
  hash.value(plan.reference);
  hash.text(plan.renderer);
  hash.text(plan.build);
}

json toJson(const Sample& sample) {
  const render::FrameStatistics& s = sample.statistics;
  json passes = json::array();
  for (const auto& [name, ms] : sample.passes)
    passes.push_back({name, ms});
  json result = {{"frame", sample.frame},
                 {"configuration", sample.configuration},
                 {"objects", s.objects},
                 {"culled_frustum", s.culledFrustum},
                 {"culled_occlusion", s.culledOcclusion},
                 {"culled_small", s.culledSmall},
                 {"occluders", s.occluders},
                 {"drawn", s.drawn},
                 {"drawn_early", s.drawnEarly},
                 {"drawn_stale", s.drawnStale},
                 {"switches", s.switches},
                 {"fading", s.fading},
                 {"dropped", s.dropped},
                 {"draws", s.draws},
                 {"triangles", s.triangles},
                 {"triangles_full", s.trianglesFull},
                 {"lod_histogram", s.lodHistogram},
                 {"frame_ms", sample.frameMs},
                 {"passes", passes}};
  if (sample.error)  // no number stands for infinity
    result["error"] = {{"psnr", std::isinf(sample.error->psnr) ? json() : json(sample.error->psnr)},
                       {"ssim", sample.error->ssim},
                       {"flip", sample.error->flip}};
  if (sample.visible) result["visible"] = *sample.visible;
  if (sample.temporal) result["temporal_flip"] = *sample.temporal;
  if (sample.switched) result["visible_switched"] = *sample.switched;
  return result;
}

ImageError errorFrom(const json& value) {
  const json& psnr = value.at("psnr");
  return {psnr.is_null() ? std::numeric_limits<double>::infinity() : psnr.get<double>(), value.at("ssim"),
          value.at("flip")};
}

Sample sampleFrom(const json& value) {
  Sample sample;
  sample.frame = value.at("frame");
  sample.configuration = value.at("configuration");
  render::FrameStatistics& s = sample.statistics;
  s.objects = value.at("objects");
  s.culledFrustum = value.at("culled_frustum");
  s.culledOcclusion = value.at("culled_occlusion");
  s.culledSmall = value.at("culled_small");
  s.occluders = value.at("occluders");
  s.drawn = value.at("drawn");
  s.drawnEarly = value.at("drawn_early");
  s.drawnStale = value.at("drawn_stale");
  s.switches = value.at("switches");
  s.fading = value.at("fading");
  s.dropped = value.at("dropped");
  s.draws = value.at("draws");
  s.triangles = value.at("triangles");
  s.trianglesFull = value.at("triangles_full");
  s.lodHistogram = value.at("lod_histogram").get<std::vector<std::uint64_t>>();
  sample.frameMs = value.at("frame_ms");
  for (const json& pass : value.at("passes"))
    sample.passes.emplace_back(pass.at(0).get<std::string>(), pass.at(1).get<double>());
  if (value.contains("error")) sample.error = errorFrom(value.at("error"));
  if (value.contains("visible")) sample.visible = value.at("visible").get<std::uint64_t>();
  if (value.contains("temporal_flip")) sample.temporal = value.at("temporal_flip").get<double>();
  if (value.contains("visible_switched")) sample.switched = value.at("visible_switched").get<std::uint64_t>();
  return sample;
}

json toJson(const KeptSample& sample) {
  return {{"frame", sample.frame},
          {"configuration", sample.configuration},
          {"frozen_mean", sample.frozenMean},
          {"frozen_largest", sample.frozenLargest},
          {"temporal", sample.temporal}};
}

KeptSample keptFrom(const json& value) {
  return {value.at("frame"), value.at("configuration"), value.at("frozen_mean"), value.at("frozen_largest"),
          value.at("temporal")};
}

json toJson(const SweepSample& sample) {
  return {{"configuration", sample.configuration},
          {"tau", sample.tau},
          {"frame", sample.frame},
          {"triangles", sample.triangles},
          {"frame_ms", sample.frameMs},
          {"error",
           {{"psnr", std::isinf(sample.error.psnr) ? json() : json(sample.error.psnr)},
            {"ssim", sample.error.ssim},
            {"flip", sample.error.flip}}}};
}

SweepSample sweepFrom(const json& value) {
  return {value.at("configuration"), value.at("tau"),      value.at("frame"),
          value.at("triangles"),     value.at("frame_ms"), errorFrom(value.at("error"))};
}

Results stepFrom(const json& line) {
  Results results;
  for (const json& value : line.at("samples"))
    results.samples.push_back(sampleFrom(value));
  for (const json& value : line.at("kept"))
    results.kept.push_back(keptFrom(value));
  for (const json& value : line.at("sweep"))
    results.sweep.push_back(sweepFrom(value));
  return results;
}

}  // namespace

std::string referenceFingerprint(const scene::SceneData& scene, const asset::Camera& path, const Plan& plan) {
  Hash hash;
  addScene(hash, scene, path, plan);
  return hash.digits();
}

std::string experimentFingerprint(const scene::SceneData& scene, const asset::Camera& path,
                                  const std::vector<Configuration>& configurations, const Plan& plan) {
  Hash hash;
  addScene(hash, scene, path, plan);
  hash.value(plan.range.first);
  hash.value(plan.range.last);
  hash.value(plan.range.step);
  hash.value(plan.lead);
  hash.value(plan.keep);
  hash.values(plan.taus);
  hash.value(plan.baseline);
  hash.value(plan.gpuTiming);
  hash.value(plan.pixelsPerDegree);
  for (const Configuration& configuration : configurations) {
    hash.text(configuration.name);
    hash.text(configuration.commandLine);
    if (const visibility::ImportanceMask* mask = configuration.renderer.importance; mask != nullptr)
      hash.bytes(std::as_bytes(mask->level(0)));
  }
  return hash.digits();
}

void startLog(const std::filesystem::path& folder, const std::string& fingerprint) {
  writeFileAtomic(logFile(folder), json({{"log", kLogVersion}, {"experiment", fingerprint}}).dump() + "\n");
}

void appendLog(const std::filesystem::path& folder, const Results& step) {
  json line = {{"samples", json::array()}, {"kept", json::array()}, {"sweep", json::array()}};
  for (const Sample& sample : step.samples)
    line["samples"].push_back(toJson(sample));
  for (const KeptSample& sample : step.kept)
    line["kept"].push_back(toJson(sample));
  for (const SweepSample& sample : step.sweep)
    line["sweep"].push_back(toJson(sample));
  appendToFile(logFile(folder), line.dump() + "\n");
}

bool holdsLog(const std::filesystem::path& folder) {
  std::ifstream file(logFile(folder));
  std::string head;
  if (!std::getline(file, head)) return false;
  const json line = json::parse(head, nullptr, /*allow_exceptions=*/false);
  return line.is_object() && line.contains("log") && line.contains("experiment");
}

std::string digestOf(std::span<const std::byte> bytes) {
  Hash hash;
  hash.bytes(bytes);
  return hash.digits();
}

std::size_t readLog(const std::filesystem::path& folder, const std::string& fingerprint, Results& results) {
  const std::filesystem::path file = logFile(folder);
  if (!std::filesystem::exists(file)) return 0;
  const std::vector<std::byte> bytes = readFile(file, kMaxLogBytes);
  std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  std::size_t steps = 0;
  std::string whole;
  try {
    for (bool head = true; !text.empty(); head = false) {
      const std::size_t end = text.find('\n');
      if (end == std::string_view::npos) break;  // the line that an interruption cut off
      const json line = json::parse(text.substr(0, end));
      if (head) {
        if (line.at("log") != kLogVersion || line.at("experiment") != fingerprint)
          throw Error(ErrorCode::kUsage,
                      "holds another experiment (scene, path or options differ); choose another folder, or leave out "
                      "--resume to replace it",
                      folder);
      } else {
        append(results, stepFrom(line));
        ++steps;
      }
      whole += std::string(text.substr(0, end + 1));
      text.remove_prefix(end + 1);
    }
  } catch (const json::exception& error) {
    throw Error(ErrorCode::kMalformed, fmt::format("not a log of ours ({})", error.what()), file);
  }
  if (!text.empty()) writeFileAtomic(file, whole);
  return steps;
}

void append(Results& results, const Results& more) {
  results.samples.insert(results.samples.end(), more.samples.begin(), more.samples.end());
  results.kept.insert(results.kept.end(), more.kept.begin(), more.kept.end());
  results.sweep.insert(results.sweep.end(), more.sweep.begin(), more.sweep.end());
}

}  // namespace jalousie::compare
