// The corpus of broken files (make_corpus.mjs), made once for each test program that uses it.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "support/node.h"
#include "support/run_program.h"

namespace jalousie::test {

/// What a program owes for a file.
struct Verdict {
  int code = 0;        ///< of the exit
  std::string reason;  ///< part of the message; empty where the code is 0
};

struct CorpusCase {
  std::string name;
  std::filesystem::path input;
  Verdict baker;
  Verdict runtime;  ///< of the commands that draw
  bool isGltf() const { return input.extension() == ".glb" || input.extension() == ".gltf"; }
};

class CorpusTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    const std::optional<std::filesystem::path> node = findNode();
    if (!node) return;
    folder_ = new TemporaryFolder();
    const std::filesystem::path maker = std::filesystem::path(JALOUSIE_SOURCE_DIR) / "tests/hostile/make_corpus.mjs";
    const ProgramResult made = runProgram(*node, {maker.string(), folder_->path().string()});
    ASSERT_EQ(made.exitCode, 0) << made.standardError;
    const auto verdict = [](const nlohmann::json& entry) {
      return Verdict{entry["code"], entry["reason"].is_null() ? "" : entry["reason"].get<std::string>()};
    };
    for (const nlohmann::json& entry : nlohmann::json::parse(std::ifstream(*folder_ / "index.json")))
      cases_.push_back(
          {entry["name"], *folder_ / entry["input"].get<std::string>(), verdict(entry), verdict(entry["runtime"])});
  }
  static void TearDownTestSuite() {
    delete folder_;
    folder_ = nullptr;
    cases_.clear();
  }
  void SetUp() override {
    if (folder_ == nullptr) GTEST_SKIP() << "Node.js is not installed; it makes the corpus";
  }

  /// Arguments of the baker. @param output  a file
  static std::vector<std::string> bakeArguments(const CorpusCase& file, const std::filesystem::path& output) {
    return {file.input.string(), "-o", output.string(), "-q", "--preset", "draft", "--levels", "2"};
  }

  static std::size_t linesOf(const std::string& text) {
    return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
  }

  /// Expects the code; and for a failure one line that names the file and the reason, and nothing on standard output.
  static void expectVerdict(const ProgramResult& result, const CorpusCase& file, const Verdict& verdict) {
    EXPECT_EQ(result.exitCode, verdict.code) << result.standardError;
    if (verdict.code == 0 || result.exitCode == 0) return;
    EXPECT_EQ(linesOf(result.standardError), 1U) << result.standardError;
    EXPECT_EQ(result.standardOutput, "");
    EXPECT_NE(result.standardError.find(file.input.filename().string()), std::string::npos) << result.standardError;
    EXPECT_NE(result.standardError.find(verdict.reason), std::string::npos)
        << result.standardError << "lacks: " << verdict.reason;
  }

  static inline TemporaryFolder* folder_ = nullptr;
  static inline std::vector<CorpusCase> cases_;
};

}  // namespace jalousie::test
