// bench_head: prints the head of a benchmark as JSON, for benchmarks that are scripts.
//
//   bench_head NAME ARGUMENT...
#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bench_head.h"
#include "cli/program.h"
#include "core/standard_streams.h"

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "usage: bench_head NAME ARGUMENT...\n");
    return 2;
  }
  return jalousie::cli::runProgram("bench_head", [&] {
    const std::vector<std::string> arguments(argv + 2, argv + argc);
    const nlohmann::ordered_json head = toJson(jalousie::bench::makeHead(argv[1], arguments));
    jalousie::printOutput(head.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n");
    return 0;
  });
}
