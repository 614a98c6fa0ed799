// The #include edges of the source tree: which file includes which, and which units include each other in a circle.
#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace jalousie::test {

/// One file with the headers it includes, in quotes or angle brackets, as they stand in the source.
struct SourceFile {
  std::string path;  ///< from the root of the repository, with slashes
  std::vector<std::string> headers;
};

/// All .h and .cpp files below the given folders of `root`, in ascending order of their paths.
std::vector<SourceFile> readSources(const std::filesystem::path& root, const std::vector<std::string>& folders);

/// Candidates for the file that a header names, in the order in which the compiler looks: beside the including file,
/// then in the include folders of the project.
std::vector<std::string> candidatePaths(const std::string& includer, const std::string& header);

/// A unit is a header and its source: the path without its extension.
std::string unitOf(const std::string& path);

/// Node -> nodes it points to. A node that is only pointed to may be absent as a key.
using Graph = std::map<std::string, std::set<std::string>>;

/// Edges between the units of the given files, a unit's edges to itself left out.
Graph unitGraph(const std::vector<SourceFile>& files);

/// The strongly connected components of two nodes and more, each sorted, in ascending order.
std::vector<std::vector<std::string>> findCircles(const Graph& graph);

}  // namespace jalousie::test
