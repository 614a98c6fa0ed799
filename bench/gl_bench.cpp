// Turns errors and wrong results into one line and an exit code.
#include "gl_bench.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <numeric>
#include <stdexcept>
#include <vector>

#include "bench_head.h"
#include "cli/force_option.h"
#include "cli/program.h"
#include "core/error.h"
#include "core/output_files.h"
#include "core/standard_streams.h"
#include "platform/headless_context.h"
#include "render/frame_statistics.h"

namespace jalousie::bench {
namespace {

class WrongResult : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace

void require(bool right, const std::string& message) {
  if (!right) throw WrongResult(message);
}

void requireCounts(const render::FrameStatistics& statistics, const std::string& where) {
  const std::uint64_t culled = statistics.culledFrustum + statistics.culledOcclusion + statistics.culledSmall;
  // An object is neither where it is visible, but none of its cells is.
  const bool agree = statistics.cells > 0 ? culled + statistics.drawn <= statistics.objects
                                          : culled + statistics.drawn == statistics.objects;
  require(agree, fmt::format("{}: {} objects drawn and {} culled, of {}", where, statistics.drawn, culled,
                             statistics.objects));
  const std::uint64_t levels =
      std::accumulate(statistics.lodHistogram.begin(), statistics.lodHistogram.end(), std::uint64_t{0});
  require(levels == statistics.drawn,
          fmt::format("{}: {} objects have a level, but {} are drawn", where, levels, statistics.drawn));
  require(statistics.dropped == 0, fmt::format("{}: {} objects found no room in a list", where, statistics.dropped));
}

GlBench::GlBench(const char* name, const char* description, const char* examples)
    : name_(name), app_(description, name) {
  app_.get_formatter()->column_width(32);
  app_.add_option("--json", json_, "Write head and figures as JSON to this file; - for standard output, after the text")
      ->type_name("FILE");
  cli::addForceOption(app_, replace_);
  app_.footer(std::string(examples) + "\nExit code 1: a result is wrong.");
}

int GlBench::run(int argc, char** argv, const std::function<void(nlohmann::ordered_json& figures)>& body) {
  return cli::runProgram(name_.c_str(), [&] {
    if (!cli::parse(app_, argc, argv)) return 0;
    checkOutputs(std::vector<NamedFile>{{"--json", json_, OutputKind::kReport, true}}, {}, replace_);
    const platform::HeadlessContext context(/*debug=*/false);
    Head head = makeHead(name_, std::vector<std::string>(argv + 1, argv + argc));
    head.renderer = context.capabilities().renderer;
    head.version = context.capabilities().version;
    printOutput(toText(head) + "\n");
    nlohmann::ordered_json figures;
    try {
      body(figures);
    } catch (const WrongResult& wrong) {
      printError(fmt::format("{}: wrong result: {}", name_, wrong.what()));
      return kWrongResult;
    }
    const nlohmann::ordered_json json = {{"head", toJson(head)}, {"figures", figures}};
    if (!json_.empty())
      writeText(json_, json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n");
    return 0;
  });
}

}  // namespace jalousie::bench
