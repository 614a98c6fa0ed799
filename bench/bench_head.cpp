// Collects the facts of the build and of the command line.
#include "bench_head.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <ctime>
#include <nlohmann/json.hpp>

#include "bench_commit.h"

namespace jalousie::bench {

Head makeHead(const std::string& bench, const std::vector<std::string>& arguments) {
  Head head;
  head.bench = bench;
  head.options = fmt::format("{}", fmt::join(arguments, " "));
  head.dateUtc = fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)));
  head.commit = JALOUSIE_BENCH_COMMIT;
  head.compiler = JALOUSIE_BENCH_COMPILER;
  head.build = JALOUSIE_BENCH_BUILD;
  return head;
}

std::vector<std::pair<std::string, std::string>> fieldsOf(const Head& head) {
  std::vector<std::pair<std::string, std::string>> fields = {{"bench", head.bench},       {"options", head.options},
                                                             {"date_utc", head.dateUtc},  {"commit", head.commit},
                                                             {"compiler", head.compiler}, {"build", head.build},
                                                             {"renderer", head.renderer}, {"gl_version", head.version}};
  std::erase_if(fields, [](const auto& field) { return field.second.empty(); });
  return fields;
}

nlohmann::ordered_json toJson(const Head& head) {
  nlohmann::ordered_json json;
  for (const auto& [key, value] : fieldsOf(head))
    json[key] = value;
  return json;
}

std::string toText(const Head& head) {
  std::string text;
  for (const auto& [key, value] : fieldsOf(head))
    text += fmt::format("{:<11} {}\n", key, value);
  return text;
}

}  // namespace jalousie::bench
