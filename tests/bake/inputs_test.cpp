// Folders, patterns and lists of inputs; paths of outputs; depfiles.
#include "bake/io/inputs.h"

#include <gtest/gtest.h>

#include <fstream>

#include "bake/pipeline/depfile.h"
#include "bake/pipeline/job_list.h"
#include "support/error_code.h"
#include "support/run_program.h"

namespace jalousie::bake {
namespace {

using test::codeOf;
using Paths = std::vector<std::string>;

class Inputs : public testing::Test {
 protected:
  Inputs() {
    for (const char* name : {"models/b.obj", "models/a.ply", "models/notes.txt", "models/city/c.gltf",
                             "models/city/deep/d.GLB", "models/.hidden.ply", "models/.git/e.ply", "models/[odd].ply"}) {
      std::filesystem::create_directories((folder_ / name).parent_path());
      std::ofstream(folder_ / name) << "x";
    }
    std::filesystem::create_symlink("a.ply", folder_ / "models/link.ply");
    std::filesystem::create_directory_symlink("city", folder_ / "models/linked");
  }
  std::string at(const std::string& name) const { return (folder_ / name).string(); }
  Paths find(const Paths& arguments, const std::string& except = {}) const {
    Paths result;
    for (const InputFile& input : findInputs(arguments, {except}))
      result.push_back(input.relative.string());
    return result;
  }
  const test::TemporaryFolder folder_;
};

TEST_F(Inputs, AFolderGivesItsMeshesSortedWithoutHiddenFilesAndLinks) {
  EXPECT_EQ(find({at("models")}), (Paths{"[odd].ply", "a.ply", "b.obj", "city/c.gltf", "city/deep/d.GLB"}));
  EXPECT_EQ(find({at("models/")}), find({at("models")}));
  EXPECT_EQ(find({at("models")}, at("models/city")), (Paths{"[odd].ply", "a.ply", "b.obj"}));
}

TEST_F(Inputs, PatternsMatchComponents) {
  EXPECT_EQ(find({at("models/*.ply")}), (Paths{"[odd].ply", "a.ply"}));
  EXPECT_EQ(find({at("models/?.*")}), (Paths{"a.ply", "b.obj"}));
  EXPECT_EQ(find({at("models/*/[c-d].gl*")}), (Paths{"city/c.gltf"}));
  EXPECT_EQ(find({at("models/**/*.G*")}), (Paths{"city/deep/d.GLB"}));
  EXPECT_EQ(find({at("models/**/c.gltf")}), (Paths{"city/c.gltf"}));
  EXPECT_EQ(find({at("mod*/**/a.ply")}), (Paths{"models/a.ply"}));
  EXPECT_EQ(find({at("models/[odd].ply")}), (Paths{"[odd].ply"})) << "a file of this name is no pattern";
}

TEST_F(Inputs, FilesStayInTheirOrderAndComeOnce) {
  EXPECT_EQ(find({at("models/b.obj"), at("models/notes.txt"), at("models/./b.obj"), at("models/*.obj")}),
            (Paths{"b.obj", "notes.txt"}));
  EXPECT_EQ(find({at("models/a.ply"), at("models/link.ply")}), (Paths{"a.ply", "link.ply"})) << "asked for by name";
  EXPECT_EQ(find({at("missing.ply")}), (Paths{"missing.ply"})) << "one missing file must not stop the others";
}

TEST_F(Inputs, ListedFilesKeepTheirFolders) {
  const auto place = [](const char* path) { return listedInputs({path})[0].relative.string(); };
  EXPECT_EQ(listedInputs({at("models/m[1].ply"), at("models/*.ply")}).size(), 2U) << "lists hold no patterns";
  EXPECT_EQ(place("models/./a.ply"), "models/a.ply");
  EXPECT_EQ(place("../a.ply"), "a.ply");
  EXPECT_EQ(place("/somewhere/a.ply"), "a.ply");
}

TEST_F(Inputs, NothingFoundIsAnError) {
  std::filesystem::create_directory(folder_ / "empty");
  EXPECT_EQ(codeOf([&] { find({at("empty")}); }), ErrorCode::kFileNotFound);
  EXPECT_EQ(codeOf([&] { find({at("models/*.xyz")}); }), ErrorCode::kFileNotFound);
  EXPECT_EQ(codeOf([&] { find({at("no/where/*.ply")}); }), ErrorCode::kFileNotFound);
}

TEST_F(Inputs, ResultsLieAtTheSamePlace) {
  const std::vector<BakeJob> jobs = jobsInto("out", "sheets", findInputs({at("models")}, {}), false);
  ASSERT_EQ(jobs.size(), 5U);
  EXPECT_EQ(jobs[3].output, "out/city/c.glb");
  EXPECT_EQ(jobs[3].sheet, "sheets/city/c.html");
  EXPECT_EQ(jobsInto("out", "", findInputs({at("models")}, {}), true)[2].output, "out/b.obj.glb");
}

TEST_F(Inputs, ResultsNeverCollideNorReplaceInputs) {
  std::ofstream(folder_ / "models/a.obj") << "x";
  EXPECT_EQ(codeOf([&] { jobsInto("out", "", findInputs({at("models")}, {}), false); }), ErrorCode::kUsage);
  EXPECT_EQ(codeOf([&] { jobsInto("out", "", findInputs({at("models")}, {}), true); }), std::nullopt);
  std::ofstream(folder_ / "models/x.glb") << "x";
  EXPECT_EQ(codeOf([&] { jobsInto(at("models"), "", findInputs({at("models/x.glb")}, {}), false); }),
            ErrorCode::kUsage);
}

TEST_F(Inputs, ListsHaveOnePathALine) {
  std::ofstream(folder_ / "list") << "a b.ply\r\n\nc.ply";
  EXPECT_EQ(readList(at("list")), (Paths{"a b.ply", "c.ply"}));
}

TEST(Depfile, NamesAreEscaped) {
  EXPECT_EQ(depfileRule("out dir/a.glb", {"in#1.gltf", "cost$.bin"}),
            "out\\ dir/a.glb: \\\n  in\\#1.gltf \\\n  cost$$.bin\n");
  EXPECT_EQ(codeOf([] { depfileRule("a\nb", {}); }), ErrorCode::kUsage);
}

}  // namespace
}  // namespace jalousie::bake
