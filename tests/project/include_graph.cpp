// Reads #include lines and finds strongly connected components (Tarjan 1972).
#include "project/include_graph.h"

#include <algorithm>
#include <fstream>

namespace jalousie::test {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> headersOf(const fs::path& file) {
  std::vector<std::string> headers;
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);) {
    const std::size_t hash = line.find_first_not_of(" \t");
    if (hash == std::string::npos || line.compare(hash, 8, "#include") != 0) continue;
    const std::size_t open = line.find_first_of("\"<", hash);
    const std::size_t close = line.find_first_of("\">", open + 1);
    if (open != std::string::npos && close != std::string::npos)
      headers.push_back(line.substr(open + 1, close - open - 1));
  }
  return headers;
}

/// Visits every node once; a component is complete when its first node is left.
class ComponentSearch {
 public:
  explicit ComponentSearch(const Graph& graph) : graph_(graph) {}

  std::vector<std::vector<std::string>> run() {
    for (const auto& [node, targets] : graph_)
      if (!order_.contains(node)) visit(node);
    std::sort(circles_.begin(), circles_.end());
    return std::move(circles_);
  }

 private:
  /// @return  the lowest number of a node on the path that can be reached
  std::size_t visit(const std::string& node) {
    const std::size_t number = order_.size();
    order_[node] = number;
    path_.push_back(node);
    onPath_.insert(node);
    std::size_t lowest = number;
    if (const auto found = graph_.find(node); found != graph_.end()) {
      for (const std::string& target : found->second) {
        if (!order_.contains(target)) {
          lowest = std::min(lowest, visit(target));
        } else if (onPath_.contains(target)) {
          lowest = std::min(lowest, order_.at(target));
        }
      }
    }
    if (lowest == number) closeComponent(node);
    return lowest;
  }

  void closeComponent(const std::string& first) {
    std::vector<std::string> component;
    do {
      component.push_back(path_.back());
      onPath_.erase(path_.back());
      path_.pop_back();
    } while (component.back() != first);
    std::sort(component.begin(), component.end());
    if (component.size() > 1) circles_.push_back(std::move(component));
  }

  const Graph& graph_;
  std::map<std::string, std::size_t> order_;
  std::vector<std::string> path_;
  std::set<std::string> onPath_;
  std::vector<std::vector<std::string>> circles_;
};

}  // namespace

std::vector<SourceFile> readSources(const fs::path& root, const std::vector<std::string>& folders) {
  std::vector<SourceFile> files;
  for (const std::string& folder : folders) {
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root / folder)) {
      const std::string extension = entry.path().extension().string();
      if (extension != ".h" && extension != ".cpp") continue;
      files.push_back({entry.path().lexically_relative(root).generic_string(), headersOf(entry.path())});
    }
  }
  std::sort(files.begin(), files.end(), [](const SourceFile& a, const SourceFile& b) { return a.path < b.path; });
  return files;
}

std::vector<std::string> candidatePaths(const std::string& includer, const std::string& header) {
  std::vector<std::string> paths = {(fs::path(includer).parent_path() / header).lexically_normal().generic_string()};
  for (const char* root : {"src", "preprocess", "shaders", "tests"})
    paths.push_back((fs::path(root) / header).lexically_normal().generic_string());
  return paths;
}

std::string unitOf(const std::string& path) {
  return fs::path(path).replace_extension().generic_string();
}

Graph unitGraph(const std::vector<SourceFile>& files) {
  std::set<std::string> known;
  for (const SourceFile& file : files)
    known.insert(file.path);
  Graph graph;
  for (const SourceFile& file : files) {
    std::set<std::string>& targets = graph[unitOf(file.path)];
    for (const std::string& header : file.headers) {
      const std::vector<std::string> candidates = candidatePaths(file.path, header);
      const auto found = std::find_if(candidates.begin(), candidates.end(),
                                      [&](const std::string& path) { return known.contains(path); });
      if (found != candidates.end() && unitOf(*found) != unitOf(file.path)) targets.insert(unitOf(*found));
    }
  }
  return graph;
}

std::vector<std::vector<std::string>> findCircles(const Graph& graph) {
  return ComponentSearch(graph).run();
}

}  // namespace jalousie::test
