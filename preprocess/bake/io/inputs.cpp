// Finds files and sorts them, so that the order of the file system does not matter.
#include "bake/io/inputs.h"

#include <fmt/format.h>
#include <fnmatch.h>

#include <algorithm>
#include <iostream>
#include <set>
#include <system_error>

#include "bake/io/import.h"
#include "core/error.h"
#include "core/file.h"

namespace jalousie::bake {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kMaxListBytes = 256ULL << 20U;

bool isPattern(const std::string& text) {
  return text.find_first_of("*?[") != std::string::npos;
}

/// Whether the components of a path match those of a pattern, where ** stands for any number of folders.
bool matches(fs::path::const_iterator part, const fs::path::const_iterator& end, fs::path::const_iterator pattern,
             const fs::path::const_iterator& patternEnd) {
  if (pattern == patternEnd) return part == end;
  if (*pattern == "**") {
    for (;; ++part) {
      if (matches(part, end, std::next(pattern), patternEnd)) return true;
      if (part == end) return false;
    }
  }
  return part != end && ::fnmatch(pattern->c_str(), part->c_str(), FNM_PERIOD) == 0 &&
         matches(std::next(part), end, std::next(pattern), patternEnd);
}

class Finder {
 public:
  explicit Finder(const std::vector<fs::path>& except) {
    for (const fs::path& folder : except)
      if (!folder.empty()) except_.insert(canonicalPath(folder));
  }

  void add(const std::string& argument) {
    std::error_code failed;
    if (fs::is_directory(argument, failed)) return walk(argument, fs::path());
    if (!fs::exists(argument, failed) && isPattern(argument)) return match(argument);
    take(argument, fs::path(argument).filename());
  }

  std::vector<InputFile> finish() { return std::move(files_); }

 private:
  void take(const fs::path& path, const fs::path& relative) {
    if (seen_.insert(fs::absolute(path).lexically_normal()).second) files_.push_back({path, relative});
  }

  /// Files below a folder, all of a known kind or those whose relative path matches a pattern.
  void walk(const fs::path& folder, const fs::path& pattern) {
    const auto depth = static_cast<int>(std::distance(pattern.begin(), pattern.end()));
    const bool bounded = !pattern.empty() && std::find(pattern.begin(), pattern.end(), "**") == pattern.end();
    std::vector<fs::path> found;
    try {
      for (auto at = fs::recursive_directory_iterator(folder); at != fs::recursive_directory_iterator(); ++at) {
        if (bounded && at.depth() + 1 >= depth) at.disable_recursion_pending();
        const bool hidden = at->path().filename().string().starts_with('.');
        if (at->is_symlink() || hidden || (at->is_directory() && except_.contains(canonicalPath(at->path())))) {
          at.disable_recursion_pending();
        } else if (at->is_regular_file()) {
          const fs::path relative = at->path().lexically_relative(folder);
          const bool wanted = pattern.empty()
                                  ? isImportable(relative)
                                  : matches(relative.begin(), relative.end(), pattern.begin(), pattern.end());
          if (wanted) found.push_back(relative);
        }
      }
    } catch (const fs::filesystem_error& error) {
      throw Error(ErrorCode::kFileUnreadable, "a folder in it cannot be read: " + error.code().message(),
                  error.path1().empty() ? folder : error.path1());
    }
    if (found.empty())
      throw Error(ErrorCode::kFileNotFound,
                  pattern.empty() ? "no .ply, .obj, .stl, .gltf or .glb file in this folder" : "no file matches",
                  pattern.empty() ? folder : folder / pattern);
    std::sort(found.begin(), found.end());
    for (const fs::path& relative : found)
      take(folder == "." ? relative : folder / relative, relative);
  }

  void match(const std::string& argument) {
    const fs::path whole = argument;
    fs::path folder;
    fs::path pattern;
    for (const fs::path& part : whole) {
      if (pattern.empty() && !isPattern(part.string())) {
        folder /= part;
      } else {
        pattern /= part;
      }
    }
    std::error_code absent;
    if (folder.empty()) folder = ".";
    if (!fs::is_directory(folder, absent)) throw Error(ErrorCode::kFileNotFound, "no file matches", whole);
    walk(folder, pattern);
  }

  std::set<fs::path> except_;
  std::set<fs::path> seen_;
  std::vector<InputFile> files_;
};

}  // namespace

fs::path canonicalPath(const fs::path& path) {
  std::error_code failed;
  const fs::path result = fs::weakly_canonical(path, failed);
  return failed ? path.lexically_normal() : result;
}

std::vector<InputFile> findInputs(const std::vector<std::string>& arguments, const std::vector<fs::path>& except) {
  Finder finder(except);
  for (const std::string& argument : arguments)
    finder.add(argument);
  return finder.finish();
}

std::vector<InputFile> listedInputs(const std::vector<std::string>& files) {
  std::vector<InputFile> result;
  std::set<fs::path> seen;
  for (const fs::path file : files) {
    const fs::path place = file.lexically_normal();
    const bool isInside = place.is_relative() && !place.empty() && *place.begin() != "..";
    if (seen.insert(place).second) result.push_back({file, isInside ? place : place.filename()});
  }
  return result;
}

std::vector<std::string> readList(const fs::path& file) {
  std::string text;
  if (file == "-") {
    text.assign(std::istreambuf_iterator<char>(std::cin), {});
  } else {
    const std::vector<std::byte> bytes = readFile(file, kMaxListBytes);
    text.assign(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  }
  std::vector<std::string> lines;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    std::string line = text.substr(at, end - at);
    if (line.ends_with('\r')) line.pop_back();
    if (!line.empty()) lines.push_back(std::move(line));
    at = end + 1;
  }
  return lines;
}

}  // namespace jalousie::bake
