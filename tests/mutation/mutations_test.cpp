// The list of mutations fits the source: scripts/test --mutate takes too long for every run, this does not.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>

#include "support/source_root.h"

namespace jalousie {
namespace {

namespace fs = std::filesystem;

std::string textOf(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

std::size_t countOf(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
    ++count;
  return count;
}

/// Every CMakeLists.txt below tests, which name the test programs.
std::string testPrograms() {
  std::string text;
  for (const fs::directory_entry& entry : fs::directory_iterator(test::kSourceRoot / "tests"))
    text += textOf(entry.path() / "CMakeLists.txt");
  return text;
}

TEST(Mutations, EachChangesOnePlaceAndNamesATestProgram) {
  const nlohmann::json mutations = nlohmann::json::parse(textOf(test::kSourceRoot / "tests/mutation/mutations.json"));
  const std::string programs = testPrograms();
  std::set<std::string> names;
  for (const nlohmann::json& mutation : mutations) {
    const std::string name = mutation.at("name");
    SCOPED_TRACE(name);
    EXPECT_TRUE(names.insert(name).second) << "two mutations have this name";
    const std::string from = mutation.at("from");
    EXPECT_NE(from, mutation.at("to").get<std::string>());
    EXPECT_EQ(countOf(textOf(test::kSourceRoot / mutation.at("file").get<std::string>()), from), 1U) << from;
    EXPECT_EQ(countOf(programs, "jalousie_add_test(" + mutation.at("target").get<std::string>() + "\n"), 1U);
    EXPECT_FALSE(mutation.at("tests").get<std::string>().empty());
    EXPECT_FALSE(mutation.at("breaks").get<std::string>().empty());
  }
  EXPECT_GE(names.size(), 40U);
}

}  // namespace
}  // namespace jalousie
