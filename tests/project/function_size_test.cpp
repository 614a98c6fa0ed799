// Length and parameter count of every function in C++ and GLSL, as universal-ctags reads them.
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "project/source_files.h"
#include "support/run_program.h"

namespace jalousie {
namespace {

namespace fs = std::filesystem;

constexpr int kMostLines = 49;      ///< from the line of the name to the closing brace
constexpr int kMostParameters = 5;  ///< constructors included

struct Function {
  std::string file;
  std::string name;
  int line = 0;
  int lines = 0;  ///< 0: a declaration
  int parameters = 0;
};

/// A function that may exceed one of the limits. Entries leave this table and none enters it, except functions whose
/// signature another library gives.
struct Exception {
  const char* file;
  const char* name;
  int lines;       ///< of the function, 0: within the limit
  int parameters;  ///< of the function, 0: within the limit
  const char* reason;
};

constexpr Exception kExceptions[] = {
    {"src/gl/debug_log.h", "receive", 0, 7, "declared as GLDEBUGPROC"},
    {"src/gl/debug_log.cpp", "receive", 0, 7, "declared as GLDEBUGPROC"},
    {"src/asset/gltf_model.cpp", "keepEncoded", 0, 9, "declared as tinygltf::LoadImageDataFunction"},
};

/// Parameters in a signature such as "(int a,std::map<int,int> b)".
int countParameters(const std::string& signature) {
  const std::size_t open = signature.find('(');
  const std::size_t close = signature.rfind(')');
  if (open == std::string::npos || close == std::string::npos) return 0;
  const std::string inside = signature.substr(open + 1, close - open - 1);
  if (inside.find_first_not_of(' ') == std::string::npos || inside == "void") return 0;
  int depth = 0;
  int count = 1;
  for (const char c : inside) {
    depth += c == '(' || c == '[' || c == '{' || c == '<' ? 1 : 0;
    depth -= c == ')' || c == ']' || c == '}' || c == '>' ? 1 : 0;
    count += c == ',' && depth == 0 ? 1 : 0;
  }
  return count;
}

/// Definitions and declarations in the files. GLSL is read as C++.
std::vector<Function> functionsOf(const std::vector<std::string>& files, const fs::path& folder) {
  std::vector<std::string> arguments = {"ctags",
                                        "--quiet",
                                        "--options=NONE",
                                        "--languages=C++",
                                        "--langmap=C++:+.h.glsl.comp.vert.frag.tesc.tese",
                                        "--kinds-C++=fp",
                                        "--fields=+neKS",
                                        "--output-format=json",
                                        "--sort=no",
                                        "-f",
                                        "-"};
  arguments.insert(arguments.end(), files.begin(), files.end());
  const test::ProgramResult result = test::runProgram("/usr/bin/env", arguments, {.folder = folder});
  EXPECT_EQ(result.exitCode, 0) << "universal-ctags is missing (scripts/setup installs it) or failed: "
                                << result.standardError;
  std::vector<Function> functions;
  std::istringstream lines(result.standardOutput);
  for (std::string line; std::getline(lines, line);) {
    const nlohmann::json tag = nlohmann::json::parse(line);
    if (tag.value("_type", "") != "tag") continue;
    Function function{tag["path"], tag["name"], tag["line"], 0, countParameters(tag.value("signature", "()"))};
    if (function.name.starts_with("__anon")) function.name = "lambda";
    if (tag["kind"] == "function") {
      EXPECT_TRUE(tag.contains("end")) << function.file << ": ctags finds no end of " << function.name;
      function.lines = tag.value("end", function.line) - function.line + 1;
    }
    functions.push_back(function);
  }
  return functions;
}

/// What breaks a limit and is not in the table, one line each; and table entries that match nothing any more.
std::vector<std::string> violations(const std::vector<Function>& functions, std::span<const Exception> exceptions) {
  std::vector<std::string> found;
  std::set<const Exception*> unused;
  for (const Exception& exception : exceptions)
    unused.insert(&exception);
  for (const Function& function : functions) {
    const bool isLong = function.lines > kMostLines;
    const bool isWide = function.parameters > kMostParameters;
    if (!isLong && !isWide) continue;
    const auto exception = std::find_if(exceptions.begin(), exceptions.end(), [&](const Exception& e) {
      return e.file == function.file && e.name == function.name && (!isLong || e.lines == function.lines) &&
             (!isWide || e.parameters == function.parameters);
    });
    if (exception == exceptions.end()) {
      found.push_back(function.file + ":" + std::to_string(function.line) + ": " + function.name + ": " +
                      std::to_string(function.lines) + " lines, " + std::to_string(function.parameters) +
                      " parameters");
    } else {
      unused.erase(&*exception);
    }
  }
  for (const Exception* exception : unused)
    found.push_back(std::string("the table of exceptions names ") + exception->file + ": " + exception->name +
                    ", which is within the limits, has other numbers or is gone");
  return found;
}

TEST(FunctionSize, EveryFunctionIsShortAndTakesFewParameters) {
  const std::vector<Function> functions =
      functionsOf(test::sourceFiles({"src", "preprocess", "bench", "shaders"}), JALOUSIE_SOURCE_DIR);
  EXPECT_GT(functions.size(), 1500U);
  for (const std::string& violation : violations(functions, kExceptions))
    ADD_FAILURE() << violation;
}

class FunctionSizeCheck : public testing::Test {
 protected:
  std::vector<Function> functionsIn(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
    return functionsOf({name}, folder_.path());
  }
  static std::string body(int lines) {
    std::string text;
    for (int i = 0; i < lines; ++i)
      text += "  step(" + std::to_string(i) + ");\n";
    return text;
  }

 private:
  test::TemporaryFolder folder_;
};

TEST_F(FunctionSizeCheck, FindsLongFunctionsInCppAndGlsl) {
  const std::string signature = "namespace a {\nvoid longOne() {\n";
  EXPECT_EQ(violations(functionsIn("x.cpp", signature + body(47) + "}\n}\n"), {}).size(), 0U);
  const std::vector<Function> functions = functionsIn("x.cpp", signature + body(48) + "}\n}\n");
  ASSERT_EQ(violations(functions, {}).size(), 1U);
  EXPECT_EQ(functions.front().lines, 50);
  const std::string head = "#version 450 core\nlayout(local_size_x = 64) in;\n#include \"lib/lod.glsl\"\n";
  EXPECT_EQ(violations(functionsIn("x.comp", head + "void main() {\n" + body(60) + "}\n"), {}).size(), 1U);
}

TEST_F(FunctionSizeCheck, CountsALambdaAlsoInItsFunctionAndNoBraceOfAString) {
  const std::vector<Function> functions =
      functionsIn("x.cpp",
                  "template <class T>\nT f(T x) {\n  const auto g = [&](int y) {\n    return x + y;\n  };\n"
                  "  text(R\"(} { \")\");\n  return g(1);\n}\nint after() { return 1; }\n");
  std::map<std::string, int> lines;
  for (const Function& function : functions)
    lines[function.name] = function.lines;
  EXPECT_EQ(lines, (std::map<std::string, int>{{"f", 7}, {"lambda", 3}, {"after", 1}}));
}

TEST_F(FunctionSizeCheck, FindsWideFunctionsConstructorsAndDeclarations) {
  EXPECT_EQ(countParameters("()"), 0);
  EXPECT_EQ(countParameters("(void)"), 0);
  EXPECT_EQ(countParameters("(std::map<int,int> a,std::function<void (int,int)> b = {},const int (& c)[2])"), 3);
  const std::string six = "(int a, int b, int c, int d, int e, int f)";
  const std::vector<Function> functions =
      functionsIn("x.h", "struct S {\n  S" + six + ";\n  virtual void p" + six +
                             " = 0;\n  void five(int, int, int, int, int);\n};\n" + "inline S::S" + six +
                             " {}\nvec3 g" + six + " {\n  return vec3(0);\n}\n");
  EXPECT_EQ(violations(functions, {}).size(), 4U);
}

TEST_F(FunctionSizeCheck, ExceptionsHoldForOneFunctionAndItsNumbersOnly) {
  const std::vector<Function> functions = {{"a.cpp", "f", 1, 60, 7}};
  EXPECT_EQ(violations(functions, std::array{Exception{"a.cpp", "f", 60, 7, ""}}).size(), 0U);
  EXPECT_EQ(violations(functions, std::array{Exception{"a.cpp", "f", 60, 0, ""}}).size(), 2U)
      << "and the entry is stale";
  EXPECT_EQ(violations(functions, std::array{Exception{"b.cpp", "f", 60, 7, ""}}).size(), 2U);
  EXPECT_EQ(violations({}, std::array{Exception{"a.cpp", "f", 60, 7, ""}}).size(), 1U) << "a stale entry";
}

}  // namespace
}  // namespace jalousie
