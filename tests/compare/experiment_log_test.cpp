// The log of an experiment: results are read back, an interruption loses one line, other experiments are refused.
#include "compare/experiment_log.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "asset/scene_file.h"
#include "compare/configuration.h"
#include "compare/fingerprint.h"
#include "core/error.h"
#include "scene/scene_data.h"
#include "support/error_code.h"
#include "support/run_program.h"
#include "support/scenes.h"

namespace jalousie::compare {
namespace {

namespace fs = std::filesystem;
using test::codeOf;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr const char* kFingerprint = "0123456789abcdef";

std::string textOf(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

void writeText(const fs::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
}

/// Every figure another number, so that none can stand for another.
Sample fullSample(std::uint32_t frame, std::size_t configuration) {
  Sample sample;
  sample.frame = frame;
  sample.configuration = configuration;
  std::uint64_t next = 1000 * (frame + 1);
  render::FrameStatistics& s = sample.statistics;
  for (std::uint64_t* figure :
       {&s.objects, &s.culledFrustum, &s.culledOcclusion, &s.culledSmall, &s.occluders, &s.drawn, &s.drawnEarly,
        &s.drawnStale, &s.switches, &s.fading, &s.dropped, &s.draws, &s.triangles, &s.trianglesFinest})
    *figure = ++next;
  s.trianglesFinest = std::numeric_limits<std::uint64_t>::max();  // beyond what a double holds
  s.lodHistogram = {5, 0, 9007199254740993ULL};
  sample.frameMs = 1.0 / 3.0;
  sample.passes = {{"cull", 0.1}, {"draw", 1e-300}, {"draw", 2.5}};
  sample.error = ImageError{38.123456789012345, 0.1 + 0.2, 1.0 / 7.0, 1.0 / 3.0, 2.0 / 3.0};
  sample.lost = 3;
  sample.wrongPixels = 77;
  sample.visible = 77;
  sample.switched = 3;
  sample.temporal = 0.0123;
  return sample;
}

Results step() {
  Results results;
  results.samples = {fullSample(4, 0), fullSample(4, 1)};
  results.kept = {{4, 0, 0.1, 1.0 / 3.0, 0.7, 0.123}, {4, 1, 0.0, 0.0, 0.0}};
  results.sweep = {{1, 0.3F, 4, 123456789012ULL, 4.2, {40.1, 0.9, 0.05}}, {0, 64.0F, 9, 0, 0.0, {kInfinity, 1.0, 0.0}}};
  ObjectFigures whole{7, 3, true, 2, 0, 1234567890123ULL, 55, 1.0 / 3.0, 0.1, 12.25, OtherLevel{99, 0.05}};
  ObjectFigures patches{8, 3, true, 4, 6, 10, 1, {}, {}, 1e-9, OtherLevel{5, {}}};
  ObjectFigures lost{9, 1, false, 0, 0, 0, 0, {}, {}, 0.5, {}};
  results.objects = {{4, 1, 300, 20.5, 0.125, {whole, patches, lost}}, {9, 0, 0, 0.0, 0.0, {}}};
  return results;
}

void expectSame(const ObjectFigures& a, const ObjectFigures& b) {
  EXPECT_EQ(a.object, b.object);
  EXPECT_EQ(a.chain, b.chain);
  EXPECT_EQ(a.drawn, b.drawn);
  EXPECT_EQ(a.level, b.level);
  EXPECT_EQ(a.tessellation, b.tessellation);
  EXPECT_EQ(a.triangles, b.triangles);
  EXPECT_EQ(a.pixels, b.pixels);
  EXPECT_EQ(a.allowed, b.allowed);
  EXPECT_EQ(a.errorPixels, b.errorPixels);
  EXPECT_EQ(a.flip, b.flip);
  ASSERT_EQ(a.finer.has_value(), b.finer.has_value());
  if (!a.finer) return;
  EXPECT_EQ(a.finer->triangles, b.finer->triangles);
  EXPECT_EQ(a.finer->errorPixels, b.finer->errorPixels);
}

void expectSame(const ObjectsSample& a, const ObjectsSample& b) {
  EXPECT_EQ(a.frame, b.frame);
  EXPECT_EQ(a.configuration, b.configuration);
  EXPECT_EQ(a.listed, b.listed);
  EXPECT_EQ(a.flip, b.flip);
  EXPECT_EQ(a.flipOfBackground, b.flipOfBackground);
  ASSERT_EQ(a.rows.size(), b.rows.size());
  for (std::size_t i = 0; i < a.rows.size(); ++i)
    expectSame(a.rows[i], b.rows[i]);
}

void expectSame(const ImageError& a, const ImageError& b) {
  EXPECT_EQ(a.psnr, b.psnr);
  EXPECT_EQ(a.ssim, b.ssim);
  EXPECT_EQ(a.flip, b.flip);
  EXPECT_EQ(a.butteraugli, b.butteraugli);
}

void expectSame(const Sample& a, const Sample& b) {
  EXPECT_EQ(a.frame, b.frame);
  EXPECT_EQ(a.configuration, b.configuration);
  const render::FrameStatistics& s = a.statistics;
  const render::FrameStatistics& t = b.statistics;
  EXPECT_EQ(s.objects, t.objects);
  EXPECT_EQ(s.culledFrustum, t.culledFrustum);
  EXPECT_EQ(s.culledOcclusion, t.culledOcclusion);
  EXPECT_EQ(s.culledSmall, t.culledSmall);
  EXPECT_EQ(s.occluders, t.occluders);
  EXPECT_EQ(s.drawn, t.drawn);
  EXPECT_EQ(s.drawnEarly, t.drawnEarly);
  EXPECT_EQ(s.drawnStale, t.drawnStale);
  EXPECT_EQ(s.switches, t.switches);
  EXPECT_EQ(s.fading, t.fading);
  EXPECT_EQ(s.dropped, t.dropped);
  EXPECT_EQ(s.draws, t.draws);
  EXPECT_EQ(s.triangles, t.triangles);
  EXPECT_EQ(s.trianglesFinest, t.trianglesFinest);
  EXPECT_EQ(s.lodHistogram, t.lodHistogram);
  EXPECT_EQ(a.frameMs, b.frameMs);
  EXPECT_EQ(a.passes, b.passes);
  ASSERT_EQ(a.error.has_value(), b.error.has_value());
  if (a.error) expectSame(*a.error, *b.error);
  EXPECT_EQ(a.visible, b.visible);
  EXPECT_EQ(a.switched, b.switched);
  EXPECT_EQ(a.temporal, b.temporal);
  EXPECT_EQ(a.lost, b.lost);
  EXPECT_EQ(a.wrongPixels, b.wrongPixels);
}

void expectSame(const Results& a, const Results& b) {
  ASSERT_EQ(a.samples.size(), b.samples.size());
  for (std::size_t i = 0; i < a.samples.size(); ++i)
    expectSame(a.samples[i], b.samples[i]);
  ASSERT_EQ(a.kept.size(), b.kept.size());
  for (std::size_t i = 0; i < a.kept.size(); ++i) {
    EXPECT_EQ(a.kept[i].frame, b.kept[i].frame);
    EXPECT_EQ(a.kept[i].configuration, b.kept[i].configuration);
    EXPECT_EQ(a.kept[i].frozenMean, b.kept[i].frozenMean);
    EXPECT_EQ(a.kept[i].frozenLargest, b.kept[i].frozenLargest);
    EXPECT_EQ(a.kept[i].temporal, b.kept[i].temporal);
    EXPECT_EQ(a.kept[i].subject, b.kept[i].subject);
  }
  ASSERT_EQ(a.objects.size(), b.objects.size());
  for (std::size_t i = 0; i < a.objects.size(); ++i)
    expectSame(a.objects[i], b.objects[i]);
  ASSERT_EQ(a.sweep.size(), b.sweep.size());
  for (std::size_t i = 0; i < a.sweep.size(); ++i) {
    EXPECT_EQ(a.sweep[i].configuration, b.sweep[i].configuration);
    EXPECT_EQ(a.sweep[i].tau, b.sweep[i].tau);
    EXPECT_EQ(a.sweep[i].frame, b.sweep[i].frame);
    EXPECT_EQ(a.sweep[i].triangles, b.sweep[i].triangles);
    EXPECT_EQ(a.sweep[i].frameMs, b.sweep[i].frameMs);
    expectSame(a.sweep[i].error, b.sweep[i].error);
  }
}

class ExperimentLog : public testing::Test {
 protected:
  const fs::path& folder() const { return folder_.path(); }
  fs::path file() const { return folder_ / kLogName; }

  std::size_t read(Results& results) const { return readLog(folder(), kFingerprint, results); }
  std::optional<ErrorCode> readingFailsWith(const std::string& fingerprint = kFingerprint) const {
    Results results;
    return codeOf([&] { readLog(folder(), fingerprint, results); });
  }

 private:
  test::TemporaryFolder folder_;
};

TEST_F(ExperimentLog, FolderWithoutOneHasNoSteps) {
  Results results;
  EXPECT_EQ(read(results), 0U);
  EXPECT_TRUE(results.samples.empty());
  EXPECT_FALSE(fs::exists(file()));
}

TEST_F(ExperimentLog, NewOneHasNoSteps) {
  startLog(folder(), kFingerprint);
  Results results;
  EXPECT_EQ(read(results), 0U);
}

TEST_F(ExperimentLog, StepsComeBackAsTheyWere) {
  startLog(folder(), kFingerprint);
  appendLog(folder(), step());
  Results results;
  EXPECT_EQ(read(results), 1U);
  expectSame(results, step());
}

TEST_F(ExperimentLog, WhatASampleLacksIsStillAbsent) {
  Results bare;
  bare.samples = {fullSample(1, 0), fullSample(2, 0), fullSample(3, 0)};
  bare.samples[0].error.reset();
  bare.samples[0].visible.reset();
  bare.samples[0].switched.reset();
  bare.samples[0].temporal.reset();
  bare.samples[1].error->psnr = kInfinity;
  bare.samples[2].passes.clear();
  bare.samples[2].statistics.lodHistogram.clear();
  startLog(folder(), kFingerprint);
  appendLog(folder(), bare);
  Results results;
  EXPECT_EQ(read(results), 1U);
  expectSame(results, bare);
  ASSERT_EQ(results.samples.size(), 3U);
  EXPECT_FALSE(results.samples[0].error);
  EXPECT_TRUE(std::isinf(results.samples[1].error->psnr));
}

TEST_F(ExperimentLog, StepsKeepTheirOrder) {
  startLog(folder(), kFingerprint);
  Results all;
  for (std::uint32_t frame = 0; frame < 5; ++frame) {
    Results one;
    if (frame != 2) one.samples = {fullSample(frame, 0)};  // a step may hold nothing
    appendLog(folder(), one);
    append(all, one);
  }
  Results results;
  EXPECT_EQ(read(results), 5U);
  expectSame(results, all);
}

TEST_F(ExperimentLog, ReadingPutsStepsBehindWhatThereIs) {
  startLog(folder(), kFingerprint);
  appendLog(folder(), step());
  Results results = step();
  read(results);
  Results twice = step();
  append(twice, step());
  expectSame(results, twice);
}

TEST_F(ExperimentLog, StartReplacesTheOneThatIsThere) {
  startLog(folder(), kFingerprint);
  appendLog(folder(), step());
  startLog(folder(), kFingerprint);
  Results results;
  EXPECT_EQ(read(results), 0U);
  EXPECT_TRUE(results.samples.empty());
}

TEST_F(ExperimentLog, LineThatIsCutOffAnywhereIsDroppedAndTheLogGoesOn) {
  Results second;
  second.kept = {{5, 0, 0.25, 0.5, 0.125}};
  startLog(folder(), kFingerprint);
  appendLog(folder(), step());
  const std::string before = textOf(file());
  appendLog(folder(), second);
  const std::string whole = textOf(file());
  for (std::size_t size = before.size() + 1; size < whole.size(); ++size) {
    writeText(file(), whole.substr(0, size));
    Results results;
    ASSERT_EQ(read(results), 1U) << size;
    ASSERT_EQ(textOf(file()), before) << size;
    ASSERT_EQ(results.samples.size(), 2U) << size;
  }
  appendLog(folder(), second);
  EXPECT_EQ(textOf(file()), whole);
  Results results;
  EXPECT_EQ(read(results), 2U);
}

TEST_F(ExperimentLog, HeadThatIsCutOffHoldsNoSteps) {
  startLog(folder(), kFingerprint);
  const std::string head = textOf(file());
  for (std::size_t size = 0; size < head.size(); ++size) {
    writeText(file(), head.substr(0, size));
    Results results;
    ASSERT_EQ(read(results), 0U) << size;
  }
}

TEST_F(ExperimentLog, WholeLogIsNotRewritten) {
  startLog(folder(), kFingerprint);
  appendLog(folder(), step());
  const std::string text = textOf(file());
  const fs::file_time_type time = fs::file_time_type::clock::now() - std::chrono::hours(1);
  fs::last_write_time(file(), time);
  Results results;
  read(results);
  EXPECT_EQ(textOf(file()), text);
  EXPECT_EQ(fs::last_write_time(file()), time);
}

TEST_F(ExperimentLog, OfAnotherExperimentIsRefusedAndLeftAlone) {
  startLog(folder(), kFingerprint);
  appendLog(folder(), step());
  const std::string text = textOf(file()) + "{\"cut";
  writeText(file(), text);
  EXPECT_EQ(readingFailsWith("fedcba9876543210"), ErrorCode::kUsage);
  EXPECT_EQ(textOf(file()), text);
}

TEST_F(ExperimentLog, OfAnotherVersionIsRefused) {
  startLog(folder(), kFingerprint);
  std::string text = textOf(file());
  const std::size_t at = text.find("\"log\":4");
  ASSERT_NE(at, std::string::npos);
  writeText(file(), text.replace(at, 7, "\"log\":999"));
  EXPECT_EQ(readingFailsWith(), ErrorCode::kUsage);
}

TEST_F(ExperimentLog, GarbageIsMalformed) {
  for (const char* text : {"\n", "garbage\n", "[]\n", "5\n", "null\n", "{}\n", "{\"log\": 4}\n", "\xFF\xFE\n",
                           "{\"log\": 4, \"experiment\": \n\"0123456789abcdef\"}\n"}) {
    writeText(file(), text);
    EXPECT_EQ(readingFailsWith(), ErrorCode::kMalformed) << text;
  }
}

TEST_F(ExperimentLog, GarbageAmongTheStepsIsMalformed) {
  startLog(folder(), kFingerprint);
  appendLog(folder(), step());
  const std::string good = textOf(file());
  for (const char* line :
       {"garbage", "{}", "[]", "{\"samples\": [], \"kept\": []}", "{\"samples\": [{}], \"kept\": [], \"sweep\": []}",
        "{\"samples\": [], \"kept\": [{\"frame\": \"four\"}], \"sweep\": []}",
        "{\"samples\": [], \"kept\": [], \"sweep\": [{\"configuration\": 0}]}"}) {
    writeText(file(), good + line + "\n");
    EXPECT_EQ(readingFailsWith(), ErrorCode::kMalformed) << line;
  }
}

TEST_F(ExperimentLog, StepThatLosesAnyOfItsKeysIsMalformed) {
  Results results = step();
  results.samples.resize(1);
  results.kept.resize(1);
  results.sweep.resize(1);
  startLog(folder(), kFingerprint);
  appendLog(folder(), results);
  const std::string text = textOf(file());
  const std::size_t line = text.find('\n') + 1;
  std::size_t keys = 0;
  for (std::size_t colon = text.find("\":", line); colon != std::string::npos; colon = text.find("\":", colon + 2)) {
    const std::size_t quote = text.rfind('"', colon - 1);
    const std::string key = text.substr(quote + 1, colon - quote - 1);
    // What a sample may lack. Its error stands before its time, that of the sweep behind.
    if (key == "visible" || key == "visible_switched" || key == "temporal_flip" || key == "butteraugli" ||
        key == "flip_covered" || key == "lost" || key == "wrong_pixels" ||
        (key == "error" && quote < text.find("\"frame_ms\"", line)))
      continue;
    std::string broken = text;
    broken.insert(quote + 1, "x");
    writeText(file(), broken);
    EXPECT_EQ(readingFailsWith(), ErrorCode::kMalformed) << key;
    ++keys;
  }
  EXPECT_GT(keys, 30U);
}

TEST_F(ExperimentLog, AppendingWithoutAStartFails) {
  EXPECT_EQ(codeOf([&] { appendLog(folder(), step()); }), ErrorCode::kWriteFailed);
  EXPECT_EQ(codeOf([&] { startLog(folder() / "absent", kFingerprint); }), ErrorCode::kWriteFailed);
}

/// All that a fingerprint is made of.
struct Inputs {
  asset::SceneFile file = test::randomSpheres(12, 4.0F, 7);
  asset::Camera path;
  std::vector<Configuration> configurations = {{"default", "", {}, {}}, {"calm", "--calm", {}, {}}};
  Plan plan;

  Inputs() {
    file.meshes.push_back({"box", {test::box({1, 1, 1})}});
    file.chains.push_back({"box", {{static_cast<std::uint32_t>(file.meshes.size() - 1), 0.0F}}});
    test::addInstance(file, 1, {0, 1, 0}, glm::vec3(1));
    file.images.edit().push_back({2, 2, std::vector<std::uint8_t>(16, 100)});
    file.materials.back().baseTexture.emplace();
    path.track.translationTimes = {0.0F, 1.0F, 2.0F};
    path.track.translations = {{0, 0, 5}, {1, 0, 5}, {2, 1, 5}};
    path.track.rotationTimes = {0.0F, 2.0F};
    path.track.rotations = {{1, 0, 0, 0}, {0, 1, 0, 0}};
    plan.range = {0, 60, 1};
    plan.taus = {1.0F, 2.0F};
  }

  std::string reference() const { return referenceFingerprint(scene::buildScene(file), path, plan); }
  std::string experiment() const { return experimentFingerprint(scene::buildScene(file), path, configurations, plan); }
};

struct Change {
  const char* name;
  std::function<void(Inputs&)> make;
};

/// What the reference pictures depend on.
std::vector<Change> changesOfThePictures() {
  return {
      {"an instance moves", [](Inputs& i) { i.file.instances[3].worldFromObject[3].x += 0.001F; }},
      {"an instance shows another chain", [](Inputs& i) { i.file.instances[11].chain = 1; }},
      {"an instance more", [](Inputs& i) { i.file.instances.push_back(i.file.instances.front()); }},
      {"an instance less", [](Inputs& i) { i.file.instances.pop_back(); }},
      {"instances in another order", [](Inputs& i) { std::swap(i.file.instances[0], i.file.instances[1]); }},
      {"a vertex moves", [](Inputs& i) { i.file.meshes[0].primitives[0].positions[5].y += 0.001F; }},
      {"a vertex has another colour", [](Inputs& i) { i.file.meshes[0].primitives[0].colors[5].x = 0.0F; }},
      {"a triangle less", [](Inputs& i) { i.file.meshes[0].primitives[0].indices.resize(3); }},
      {"a triangle is turned",
       [](Inputs& i) {
         std::vector<std::uint32_t>& indices = i.file.meshes[0].primitives[0].indices;
         std::swap(indices[0], indices[1]);
       }},
      {"a level less", [](Inputs& i) { i.file.chains[0].levels.pop_back(); }},
      {"a level's error", [](Inputs& i) { i.file.chains[0].levels[2].errorObject *= 1.5F; }},
      {"a material", [](Inputs& i) { i.file.materials[0].baseColor.r += 0.01F; }},
      {"a texel", [](Inputs& i) { i.file.images.edit()[0].pixels[6] ^= 1U; }},
      {"a keyframe's place", [](Inputs& i) { i.path.track.translations.edit()[1].z += 0.001F; }},
      {"a keyframe's time", [](Inputs& i) { i.path.track.translationTimes.edit()[1] += 0.001F; }},
      {"a keyframe's rotation",
       [](Inputs& i) {
         i.path.track.rotations.edit()[1] = {0, 0, 1, 0};
       }},
      {"a rotation's time", [](Inputs& i) { i.path.track.rotationTimes.edit()[1] += 0.001F; }},
      {"a keyframe more",
       [](Inputs& i) {
         i.path.track.translationTimes.edit().push_back(3.0F);
         i.path.track.translations.edit().emplace_back(3, 1, 5);
       }},
      {"the rest pose", [](Inputs& i) { i.path.worldFromCamera[3].x = 1.0; }},
      {"the path's parent", [](Inputs& i) { i.path.worldFromParent[3].x = 1.0; }},
      {"the field of view", [](Inputs& i) { i.path.fovY += 0.01F; }},
      {"the near plane", [](Inputs& i) { i.path.zNear *= 2.0F; }},
      {"a far plane", [](Inputs& i) { i.path.zFar = 100.0F; }},
      {"the width", [](Inputs& i) { i.plan.width += 1; }},
      {"the height", [](Inputs& i) { i.plan.height += 1; }},
      {"width and height swapped", [](Inputs& i) { std::swap(i.plan.width, i.plan.height); }},
      {"the kind of reference", [](Inputs& i) { i.plan.reference = Reference::kFull; }},
  };
}

/// What the pictures do not depend on, and the experiment does.
std::vector<Change> changesOfTheExperiment() {
  return {
      {"a tau more", [](Inputs& i) { i.plan.taus.push_back(4.0F); }},
      {"another tau", [](Inputs& i) { i.plan.taus[1] = 3.0F; }},
      {"no sweep", [](Inputs& i) { i.plan.taus.clear(); }},
      {"the first frame", [](Inputs& i) { i.plan.range.first = 1; }},
      {"the last frame", [](Inputs& i) { i.plan.range.last = 59; }},
      {"the step", [](Inputs& i) { i.plan.range.step = 2; }},
      {"the lead", [](Inputs& i) { i.plan.lead += 1; }},
      {"the kept frames", [](Inputs& i) { i.plan.keep += 1; }},
      {"the baseline", [](Inputs& i) { i.plan.baseline = 1; }},
      {"the viewer's distance", [](Inputs& i) { i.plan.pixelsPerDegree += 1.0; }},
      {"whether masking is judged", [](Inputs& i) { i.plan.butteraugli = true; }},
      {"a configuration's options", [](Inputs& i) { i.configurations[1].commandLine = "--calm --tau 2"; }},
      {"a configuration's name", [](Inputs& i) { i.configurations[1].name = "calmer"; }},
      {"a configuration more",
       [](Inputs& i) {
         i.configurations.push_back({"hiz", "--mode hiz", {}, {}});
       }},
      {"a configuration less", [](Inputs& i) { i.configurations.pop_back(); }},
      {"the configurations' order", [](Inputs& i) { std::swap(i.configurations[0], i.configurations[1]); }},
      {"a letter from the name to the options",
       [](Inputs& i) {
         i.configurations[1].name = "cal";
         i.configurations[1].commandLine = "m--calm";
       }},
  };
}

std::vector<Change> operator+(std::vector<Change> a, const std::vector<Change>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

Inputs changed(const Change& change) {
  Inputs inputs;
  change.make(inputs);
  return inputs;
}

TEST(Fingerprints, AreSixteenHexadecimalDigits) {
  for (const std::string& digits : {Inputs().reference(), Inputs().experiment()}) {
    EXPECT_EQ(digits.size(), 16U);
    EXPECT_EQ(digits.find_first_not_of("0123456789abcdef"), std::string::npos) << digits;
  }
}

TEST(Fingerprints, EqualInputHasEqualOnes) {
  EXPECT_EQ(Inputs().reference(), Inputs().reference());
  EXPECT_EQ(Inputs().experiment(), Inputs().experiment());
  EXPECT_NE(Inputs().reference(), Inputs().experiment());
}

TEST(Fingerprints, OfTheReferenceChangesWithWhatItsPicturesShow) {
  std::set<std::string> seen = {Inputs().reference()};
  for (const Change& change : changesOfThePictures())
    EXPECT_TRUE(seen.insert(changed(change).reference()).second) << change.name;
}

TEST(Fingerprints, OfTheReferenceStaysWhereItsPicturesDo) {
  const std::string same = Inputs().reference();
  for (const Change& change : changesOfTheExperiment())
    EXPECT_EQ(changed(change).reference(), same) << change.name;
}

TEST(Fingerprints, OfTheExperimentChangesWithAllThatDecidesIt) {
  std::set<std::string> seen = {Inputs().experiment()};
  for (const Change& change : changesOfThePictures() + changesOfTheExperiment())
    EXPECT_TRUE(seen.insert(changed(change).experiment()).second) << change.name;
}

}  // namespace
}  // namespace jalousie::compare
