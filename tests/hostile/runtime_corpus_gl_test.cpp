// The commands that draw, and jalousie-scatter, on every file of the corpus that they can take.
#include <gtest/gtest.h>

#include <functional>

#include "asset/image_io.h"
#include "support/corpus.h"

namespace jalousie {
namespace {

namespace fs = std::filesystem;
using Arguments = std::vector<std::string>;

/// A command of jalousie.
struct Command {
  std::function<Arguments(const std::string&)> arguments;  ///< for an input
  std::function<test::Verdict(const test::CorpusCase&)> verdictOf = [](const test::CorpusCase& file) {
    return file.runtime;
  };
  std::size_t step = 1;  ///< above 1: only every step-th of the broken files
};

class RuntimeCorpus : public test::CorpusTest {
 protected:
  test::ProgramResult run(const fs::path& program, const Arguments& arguments) const {
    return test::runProgram(program, arguments,
                            {.environment = {"ASAN_OPTIONS=quarantine_size_mb=16:detect_leaks=0", "LP_NUM_THREADS=1"}});
  }

  void expectModest(const test::ProgramResult& result) const {
    EXPECT_LT(result.cpuSeconds, 10.0);
    EXPECT_LT(result.peakBytes, 1ULL << 30U);
    if (result.exitCode != 0) {
      EXPECT_TRUE(fs::is_empty(outputs_.path())) << "something was left behind";
    }
    for (const auto& entry : fs::directory_iterator(outputs_.path()))
      fs::remove_all(entry.path());
  }

  /// Runs a command of jalousie on the glTF files.
  void expectVerdicts(const Command& command) const {
    std::size_t files = 0;
    for (std::size_t i = 0; i < cases_.size(); ++i) {
      const test::CorpusCase& file = cases_[i];
      const test::Verdict verdict = command.verdictOf(file);
      const bool chosen = i % command.step == 0 || verdict.code == 0 || file.runtime.code != file.baker.code;
      if (!file.isGltf() || !chosen) continue;
      SCOPED_TRACE(file.name);
      const test::ProgramResult result = run(JALOUSIE_PROGRAM, command.arguments(file.input.string()));
      if (result.exitCode == 9) GTEST_SKIP() << "no OpenGL here: " << result.standardError;
      expectVerdict(result, file, verdict);
      expectModest(result);
      ++files;
    }
    EXPECT_GE(files, 300U / command.step);
  }
  std::string output(const char* name) const { return (outputs_ / name).string(); }

  test::TemporaryFolder outputs_;
};

TEST_F(RuntimeCorpus, Render) {
  expectVerdicts({.arguments = [&](const std::string& input) {
    return Arguments{"render", input, "--stats-only", "--size", "64x64", "--json", output("stats.json"), "-q"};
  }});
}

TEST_F(RuntimeCorpus, Record) {
  const auto arguments = [&](const std::string& input) {
    return Arguments{"record", input, "--frames", "3", "-o", output("path.glb"), "-q"};
  };
  const auto verdictOf = [](const test::CorpusCase& file) {
    const bool isEmpty = file.name == "valid-scene-empty";  // points and lines are something to look at
    return isEmpty ? test::Verdict{6, "the scene is empty"} : file.runtime;
  };
  expectVerdicts({.arguments = arguments, .verdictOf = verdictOf});
}

TEST_F(RuntimeCorpus, Compare) {
  const auto valid = std::find_if(cases_.begin(), cases_.end(),
                                  [](const test::CorpusCase& file) { return file.name == "valid-everything"; });
  ASSERT_NE(valid, cases_.end());
  const test::TemporaryFolder folder;
  const std::string path = (folder / "path.glb").string();
  ASSERT_EQ(run(JALOUSIE_PROGRAM, {"record", valid->input.string(), "--frames", "3", "-o", path, "-q"}).exitCode, 0);
  const auto arguments = [&](const std::string& input) {
    Arguments words = {"compare", input, "-o", output("report"), "--force", "-q", "--path", path, "--frames", "0:0:1"};
    for (const char* word : {"--size", "64x64", "--configs", "frustum", "--lead", "0", "--keep", "0"})
      words.emplace_back(word);
    return words;
  };
  expectVerdicts({.arguments = arguments, .step = 7});
}

TEST_F(RuntimeCorpus, Scatter) {
  for (const test::CorpusCase& file : cases_) {
    if (!file.isGltf()) continue;
    SCOPED_TRACE(file.name);
    const test::ProgramResult result =
        run(JALOUSIE_SCATTER_PROGRAM, {file.input.string(), "-o", output("scene.glb"), "--count", "3", "-q"});
    EXPECT_TRUE(result.exitCode == 0 || (result.exitCode >= 3 && result.exitCode <= 7)) << result.exitCode;
    // It copies less than the other programs read, and needs a mesh with a size.
    const bool own = result.exitCode == 6 || file.runtime.code == 0 || file.baker.code == 0;
    expectVerdict(result, file, own ? test::Verdict{result.exitCode, ""} : file.runtime);
    expectModest(result);
  }
}

/// Bytes of the picture that a corpus file embeds as a data URI; empty if it has none.
std::string embeddedPicture(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  const std::string text(std::istreambuf_iterator<char>(in), {});
  const std::string marker = "data:image/png;base64,";
  const std::size_t at = text.find(marker);
  if (at == std::string::npos) return {};
  const std::string alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  std::uint32_t held = 0;
  int bits = 0;
  for (std::size_t i = at + marker.size(); i < text.size(); ++i) {
    const std::size_t digit = alphabet.find(text[i]);
    if (digit == std::string::npos) break;
    held = held << 6U | static_cast<std::uint32_t>(digit);
    bits += 6;
    if (bits < 8) continue;
    bits -= 8;
    bytes += static_cast<char>(held >> static_cast<unsigned>(bits) & 255U);
  }
  return bytes;
}

TEST_F(RuntimeCorpus, PicturesForDiffAndImportance) {
  const test::TemporaryFolder folder;
  const auto good = std::find_if(cases_.begin(), cases_.end(),
                                 [](const test::CorpusCase& file) { return file.name == "valid-everything"; });
  ASSERT_NE(good, cases_.end());
  const fs::path reference = folder / "reference.png";
  asset::savePng({16, 16, std::vector<std::uint8_t>(1024, 90)}, reference);
  std::size_t pictures = 0;
  for (const test::CorpusCase& file : cases_) {
    if (!file.name.starts_with("image-") || file.name.starts_with("image-uri")) continue;
    SCOPED_TRACE(file.name);
    const std::string bytes = embeddedPicture(file.input);
    ASSERT_FALSE(bytes.empty());
    const fs::path picture = folder / (file.name + ".png");
    std::ofstream(picture, std::ios::binary) << bytes;
    const test::CorpusCase named{file.name, picture, file.runtime, file.runtime};
    std::string reason = file.runtime.reason;
    if (reason.starts_with("image 0: ")) reason = reason.substr(9);  // here the picture is the file itself
    for (const Arguments& arguments :
         {Arguments{"diff", reference.string(), picture.string(), "-o", output("map.png"), "--json",
                    output("diff.json")},
          Arguments{"render", good->input.string(), "--stats-only", "--size", "64x64", "--importance", picture.string(),
                    "--json", output("stats.json"), "-q"}}) {
      const test::ProgramResult result = run(JALOUSIE_PROGRAM, arguments);
      expectVerdict(result, named, {file.runtime.code, reason});
      expectModest(result);
    }
    ++pictures;
  }
  EXPECT_GE(pictures, 15U);
}

}  // namespace
}  // namespace jalousie
