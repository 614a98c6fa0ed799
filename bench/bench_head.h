// The head of every benchmark's output: what was measured, where, and with which program.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <utility>
#include <vector>

namespace jalousie::bench {

struct Head {
  std::string bench;     ///< name of the benchmark
  std::string options;   ///< of its command line
  std::string dateUtc;   ///< ISO 8601
  std::string commit;    ///< `git describe --always --dirty` at build time; "unknown" outside a repository
  std::string compiler;  ///< name and version
  std::string build;     ///< CMake's build type
  std::string renderer;  ///< GL_RENDERER; empty if the benchmark uses no OpenGL
  std::string version;   ///< GL_VERSION; likewise
};

/// The head of a benchmark that starts now. renderer and version are left empty.
/// @param arguments  of the command line, without the program
Head makeHead(const std::string& bench, const std::vector<std::string>& arguments);

/// Keys and values in a fixed order; empty values are left out.
std::vector<std::pair<std::string, std::string>> fieldsOf(const Head& head);

/// fieldsOf() as an object.
nlohmann::ordered_json toJson(const Head& head);

/// fieldsOf(), one line each.
std::string toText(const Head& head);

}  // namespace jalousie::bench
