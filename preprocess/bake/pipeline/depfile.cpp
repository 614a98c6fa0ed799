// Escapes names as GCC does; Make and Ninja read these escapes.
#include "bake/pipeline/depfile.h"

#include "core/error.h"

namespace jalousie::bake {
namespace {

std::string escaped(const std::filesystem::path& path) {
  std::string result;
  for (const char c : path.string()) {
    if (c == '\n' || c == '\r')
      throw Error(ErrorCode::kUsage, "a name with a line break cannot stand in a depfile", path);
    if (c == ' ' || c == '#' || c == '\t') result += '\\';
    if (c == '$') result += '$';
    result += c;
  }
  return result;
}

}  // namespace

std::string depfileRule(const std::filesystem::path& output, const std::vector<std::filesystem::path>& files) {
  std::string rule = escaped(output) + ":";
  for (const std::filesystem::path& file : files)
    rule += " \\\n  " + escaped(file);
  return rule + "\n";
}

}  // namespace jalousie::bake
