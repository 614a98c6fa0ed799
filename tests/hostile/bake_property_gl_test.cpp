// What the baker writes, inspect and render read, and the Khronos validator finds no kind of error in it that the input
// did not have: for every file of the hostile corpus and for seeded mutations of a document with everything.
// JALOUSIE_MUTANTS sets the number of mutations, JALOUSIE_FIRST_MUTANT the first seed.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>

#include "core/error.h"
#include "core/random.h"
#include "support/node.h"
#include "support/rich_gltf.h"
#include "support/run_program.h"
#include "support/source_root.h"

namespace jalousie {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
constexpr int kNoGpu = 9;

std::uint32_t numberFrom(const char* variable, std::uint32_t fallback) {
  const char* text = std::getenv(variable);
  return text == nullptr ? fallback : static_cast<std::uint32_t>(std::strtoul(text, nullptr, 10));
}

/// Bakes files and collects those that became results, with what is wrong about these.
class Property {
 public:
  /// @return  whether the file was baked
  bool bake(const fs::path& input, const std::vector<std::string>& options, const std::string& name) {
    const fs::path output = folder_ / (name + ".glb");
    std::vector<std::string> arguments = {input.string(), "-o", output.string(), "-q", "-j", "1"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const test::ProgramResult baked = test::runProgram(JALOUSIE_BAKE_PROGRAM, arguments);
    std::size_t lines = 0;  // that are no warnings
    std::istringstream text(baked.standardError);
    for (std::string line; std::getline(text, line);)
      lines += line.starts_with("jalousie-bake: warning: ") ? 0U : 1U;
    const bool refused = baked.exitCode >= 3 && baked.exitCode <= 7;
    EXPECT_TRUE(baked.exitCode == 0 || refused) << name << ": " << baked.exitCode << " " << baked.standardError;
    EXPECT_EQ(lines, baked.exitCode == 0 ? 0U : 1U) << name << ": " << baked.standardError;
    if (baked.exitCode != 0) return false;
    expectRead(test::runProgram(JALOUSIE_BAKE_PROGRAM, {"inspect", output.string(), "-q"}), name, "inspect");
    expectRendered(output, name);
    pairs_.emplace_back(input, output);
    return true;
  }

  /// Compares the errors that the validator finds in inputs and results. PLY and OBJ have none.
  void expectNoNewErrors() const {
    const std::optional<fs::path> node = test::findNode();
    const fs::path validator = test::kSourceRoot / "assets/fetched/gltf-validator";
    if (!node || !fs::exists(validator / "package.json"))
      GTEST_SKIP() << "the validator is not here; assets/fetch validator gets it from the npm registry";
    std::ofstream list(folder_ / "list");
    for (const auto& [input, output] : pairs_) {
      if (isGltf(input)) list << input.string() << "\n";
      list << output.string() << "\n";
    }
    list.close();
    const test::ProgramResult checked =
        test::runProgram(*node, {(test::kSourceRoot / "tests/hostile/validator_errors.mjs").string(),
                                 validator.string(), (folder_ / "list").string()});
    ASSERT_EQ(checked.exitCode, 0) << checked.standardError;
    const json errors = json::parse(checked.standardOutput);
    for (const auto& [input, output] : pairs_) {
      const auto before =
          isGltf(input) ? errors.at(input.string()).get<std::set<std::string>>() : std::set<std::string>();
      for (const std::string& code : errors.at(output.string()).get<std::set<std::string>>())
        EXPECT_TRUE(before.contains(code) || (code.starts_with("ACCESSOR_") && hidesValues(before)))
            << input.filename() << ": the result has " << code;
    }
  }

  const fs::path& folder() const { return folder_.path(); }

 private:
  static bool isGltf(const fs::path& file) { return file.extension() == ".glb" || file.extension() == ".gltf"; }

  /// Whether the validator did not read all accessors of a file, because their place or layout was wrong. The baker
  /// writes them to a right place, where the validator then sees what they hold.
  static bool hidesValues(const std::set<std::string>& errors) {
    return errors.contains("MESH_PRIMITIVE_ACCESSOR_WITHOUT_BYTESTRIDE") ||
           errors.contains("ACCESSOR_TOTAL_OFFSET_ALIGNMENT") || errors.contains("ARRAY_TYPE_MISMATCH");
  }

  static void expectRead(const test::ProgramResult& result, const std::string& name, const char* program) {
    EXPECT_EQ(result.exitCode, 0) << name << ": " << program << ": " << result.standardError;
  }

  void expectRendered(const fs::path& output, const std::string& name) {
    if (!hasGl_) return;
    const test::ProgramResult rendered =
        test::runProgram(JALOUSIE_PROGRAM, {"render", output.string(), "--stats-only", "--size", "64x64", "-q",
                                            "--json", (folder_ / "stats.json").string()});
    hasGl_ = rendered.exitCode != kNoGpu;
    // A valid scene may be larger than the limit on memory; the option says how to lift it.
    const bool isLarge = rendered.exitCode == static_cast<int>(ErrorCode::kLimit) &&
                         rendered.standardError.find("--max-memory lifts it") != std::string::npos;
    if (hasGl_ && !isLarge) expectRead(rendered, name, "render");
  }

  const test::TemporaryFolder folder_;
  std::vector<std::pair<fs::path, fs::path>> pairs_;  ///< input, result
  bool hasGl_ = true;
};

// Mutations ------------------------------------------------------------------------------------------------------

/// JSON pointers of every value below `value`.
void collectPointers(const json& value, const std::string& path, std::vector<std::string>& pointers) {
  for (const auto& [key, member] : value.items()) {
    std::string here = path;
    here.append("/").append(key);
    pointers.push_back(here);
    if (member.is_structured() && !key.starts_with("uri")) collectPointers(member, here, pointers);
  }
}

json oddNumber(Random& random, const json& old) {
  const json choices[] = {0,    1,     2,    -1,    3,     4,       7,      255,   65535,         5,
                          1e30, -1e30, 1e38, 1e300, 1e-30, 1e-300,  0.5,    -0.25, 2147483647,    4294967295U,
                          5120, 5121,  5123, 5125,  5126,  1.0e-45, 3.4e38, 0.0,   1099511627776, 6};
  if (random.below(3) == 0 && old.is_number_integer()) return old.get<std::int64_t>() + (random.below(2) == 0 ? 1 : -1);
  return choices[random.below(static_cast<std::uint32_t>(std::size(choices)))];
}

json oddValue(Random& random, const json& old) {
  const char* words[] = {"SCALAR",      "VEC2",         "VEC3",  "VEC4",     "MAT4",    "LINEAR",
                         "STEP",        "CUBICSPLINE",  "scale", "rotation", "weights", "translation",
                         "perspective", "orthographic", "",      "BLEND"};
  if (old.is_number()) return oddNumber(random, old);
  if (old.is_string()) return words[random.below(static_cast<std::uint32_t>(std::size(words)))];
  if (old.is_array() && !old.empty()) {
    json changed = old;
    const std::uint32_t at = random.below(static_cast<std::uint32_t>(old.size()));
    if (random.below(2) == 0) {
      changed.erase(at);
    } else {
      changed.push_back(old[at]);
    }
    return changed;
  }
  return random.below(2) == 0 ? json(nullptr) : json::array();
}

void mutateJson(Random& random, json& document) {
  std::vector<std::string> pointers;
  collectPointers(document, "", pointers);
  const json::json_pointer at(pointers[random.below(static_cast<std::uint32_t>(pointers.size()))]);
  const std::uint32_t kind = random.below(8);
  if (kind == 0 && document[at.parent_pointer()].is_object()) {
    document[at.parent_pointer()].erase(at.back());
  } else if (kind == 1) {
    document[at] = document[json::json_pointer(pointers[random.below(static_cast<std::uint32_t>(pointers.size()))])];
  } else {
    document[at] = oddValue(random, document[at]);
  }
}

void mutateBinary(Random& random, std::string& binary) {
  const std::uint32_t words[] = {0x7FC00000U, 0x7F800000U, 0xFF800000U, 0x7F7FFFFFU, 0xFF7FFFFFU, 0U,
                                 0x80000000U, 0xFFFFFFFFU, 0x3F800000U, 0x00000001U, 0x40000000U, 0x60000000U};
  const std::size_t at = std::size_t{random.below(static_cast<std::uint32_t>(binary.size() / 4))} * 4;
  if (random.below(3) == 0) {
    binary[at + random.below(4)] = static_cast<char>(random.below(256));
    return;
  }
  std::memcpy(&binary[at], &words[random.below(static_cast<std::uint32_t>(std::size(words)))], 4);
}

std::string mutant(std::uint32_t seed) {
  Random random(seed);
  test::RichGltf rich;
  for (std::uint32_t i = 0; i < 1 + random.below(2); ++i) {
    if (random.below(3) == 0) {
      mutateBinary(random, rich.binary);
    } else {
      mutateJson(random, rich.document);
    }
  }
  return rich.glb();
}

std::vector<std::string> optionsOf(std::uint32_t seed) {
  std::vector<std::string> options = {"--preset", seed % 3 == 0 ? "best" : "draft", "--levels", "3", "--samples",
                                      "100"};
  if (seed % 4 == 1 || seed % 4 == 3) options.emplace_back("--quantize");
  if (seed % 4 >= 2) options.emplace_back("--compress");
  if (seed % 5 == 0) options.insert(options.end(), {"--cells", "64"});
  return options;
}

TEST(BakeProperty, TheUndamagedDocumentBakesWithoutErrors) {
  Property property;
  const fs::path input = property.folder() / "rich.glb";
  std::ofstream(input, std::ios::binary) << test::RichGltf().glb();
  for (std::uint32_t seed = 0; seed < 12; ++seed)
    EXPECT_TRUE(property.bake(input, optionsOf(seed), "out" + std::to_string(seed)));
  property.expectNoNewErrors();
}

TEST(BakeProperty, MutationsOfADocumentWithEverything) {
  const std::uint32_t first = numberFrom("JALOUSIE_FIRST_MUTANT", 1);
  const std::uint32_t count = numberFrom("JALOUSIE_MUTANTS", 250);
  Property property;
  std::uint32_t baked = 0;
  for (std::uint32_t seed = first; seed < first + count; ++seed) {
    const std::string name = "mutant" + std::to_string(seed);
    const fs::path input = property.folder() / (name + "_in.glb");
    std::ofstream(input, std::ios::binary) << mutant(seed);
    baked += property.bake(input, optionsOf(seed), name) ? 1U : 0U;
  }
  if (count >= 100) {
    EXPECT_GT(baked, count / 8) << "most mutations must leave something to look at";
    EXPECT_LT(baked, count - count / 8) << "most mutations must be seen";
  }
  property.expectNoNewErrors();
}

TEST(BakeProperty, EveryFileOfTheHostileCorpus) {
  const std::optional<fs::path> node = test::findNode();
  if (!node) GTEST_SKIP() << "Node.js is not installed; it makes the corpus";
  const test::TemporaryFolder corpus;
  const test::ProgramResult made =
      test::runProgram(*node, {(test::kSourceRoot / "tests/hostile/make_corpus.mjs").string(), corpus.path().string()});
  ASSERT_EQ(made.exitCode, 0) << made.standardError;
  Property property;
  std::uint32_t baked = 0;
  for (const json& entry : json::parse(std::ifstream(corpus / "index.json"))) {
    const fs::path input = corpus / entry["input"].get<std::string>();
    const std::string name = entry["name"];
    const std::vector<std::string> draft = {"--preset", "draft", "--levels", "2"};
    baked += property.bake(input, draft, name) ? 1U : 0U;
  }
  EXPECT_GE(baked, 8U);
  property.expectNoNewErrors();
}

}  // namespace
}  // namespace jalousie
