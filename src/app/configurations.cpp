// Tables of the built-in configurations and sets, and the reader of configuration files.
#include "app/configurations.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <string_view>

#include "app/option_values.h"
#include "app/render_command_line.h"
#include "cli/program.h"
#include "core/error.h"
#include "core/file.h"

namespace jalousie::app {
namespace {

struct BuiltIn {
  const char* name;
  const char* options;
};
constexpr BuiltIn kBuiltIns[] = {
    {"frustum", "--mode frustum --lod pixel-error --cells off"},
    {"frustum-finest", "--mode frustum --lod finest --cells off"},
    {"hom", "--mode hom --lod finest --cells off"},
    {"hom-depth", "--mode hom-depth --lod pixel-error --cells off"},
    {"hom+lv", "--mode hom --lod linear --lv thesis --cells off"},
    {"hom+lv-tessellation", "--mode hom --lod linear --lv thesis --detail tessellation"},
    {"hiz", "--mode hiz --lod pixel-error --cells off"},
    {"hiz-cells", "--mode hiz --lod pixel-error"},
    {"hiz-coverage", "--mode hiz --lod coverage --cells off"},
    {"hiz-lv-error", "--mode hiz --lod lv-error --cells off"},
    {"query-wait", "--mode query-wait --lod pixel-error --cells off"},
    {"query-batch", "--mode query-batch --lod pixel-error --cells off"},
    {"chc-flat", "--mode chc-flat --lod pixel-error --cells off"},
    {"chc", "--mode chc --lod pixel-error --cells off"},
    {"chc++", "--mode chc++ --lod pixel-error --cells off"},
    {"nested-grid", "--mode nested-grid --lod pixel-error --cells off"},
    {"eye-siding", "--mode eye-siding --lod pixel-error --cells off"},
    {"eye-siding-single", "--mode eye-siding --query-units single --lod pixel-error --cells off"},
    {"eye-siding-planes", "--mode eye-siding --plane-depth 16 --lod pixel-error --cells off"},
    {"query-conditional", "--mode query-conditional --lod pixel-error --cells off"},
    {"query-buffer", "--mode query-buffer --lod pixel-error --cells off"},
    {"faces-mask", "--mode hiz --lod pixel-error --backface mask"},
    {"faces-cluster", "--mode hiz --lod pixel-error --backface cluster"},
    {"faces-tree", "--mode hiz --lod pixel-error --backface tree"},
    {"faces-cone", "--mode hiz --lod pixel-error --backface cone"},
    {"planar", "--mode planar --lod pixel-error --cells off"},
    {"solid", "--mode solid --lod pixel-error --cells off"},
    {"portals", "--mode portals --lod pixel-error --cells off"},
    {"default", ""},
    {"calm", "--calm"},
    {"discrete", "--detail discrete"},
    {"tessellation", "--detail tessellation"},
};

struct Set {
  const char* name;
  const char* members;
  const char* description;
};
constexpr Set kSets[] = {
    {"standard", "frustum,hiz,default", "the default and its two baselines"},
    {"thesis", "frustum-finest,hom,hom+lv,hom+lv-tessellation", "the methods of Kristmann 2022, Fig. 4.6 to 4.10"},
    {"ab", "discrete,tessellation", "LOD chain and Phong tessellation with the same error budget"},
    {"queries",
     "frustum,hiz,query-wait,query-batch,chc-flat,chc,chc++,nested-grid,eye-siding,eye-siding-single,"
     "eye-siding-planes,query-conditional,query-buffer",
     "the methods on occlusion queries with frustum culling and two-phase culling"},
    {"faces", "hiz-cells,faces-mask,faces-cluster,faces-tree,faces-cone",
     "the tests of back faces and the same without, by pixel error"},
    {"object-space", "frustum,hiz,planar,solid,portals",
     "the methods that know their occluders before the frame with frustum culling and two-phase culling"},
    {"all", "frustum,hom-depth,hiz,hiz-cells,hiz-coverage,hiz-lv-error,default,calm,hom+lv,tessellation",
     "one configuration of each kind"},
};

constexpr std::uint64_t kMaxFileBytes = 1U << 20U;

/// Adds a configuration, or all members of a set, unless it is already chosen. Errors: kUsage for an unknown name.
void add(std::vector<ConfigurationText>& chosen, const std::string& name) {
  for (const Set& set : kSets) {
    if (name != set.name) continue;
    for (const std::string& member : split(set.members, ','))
      add(chosen, member);
    return;
  }
  const auto* const known =
      std::find_if(std::begin(kBuiltIns), std::end(kBuiltIns), [&](const BuiltIn& b) { return name == b.name; });
  if (known == std::end(kBuiltIns))
    throw Error(ErrorCode::kUsage,
                fmt::format("no configuration or set has the name \"{}\" (see jalousie compare --help)", name));
  const bool twice =
      std::any_of(chosen.begin(), chosen.end(), [&](const ConfigurationText& c) { return c.name == name; });
  if (!twice) chosen.push_back({known->name, known->options});
}

/// Refuses members with other names: a mistyped one would be taken for an absent one.
void requireKeys(const nlohmann::json& object, std::initializer_list<std::string_view> known,
                 const std::filesystem::path& file) {
  if (!object.is_object()) return;  // the reader says what it expects
  for (const auto& [key, value] : object.items())
    if (std::find(known.begin(), known.end(), key) == known.end())
      throw Error(ErrorCode::kMalformed,
                  fmt::format("\"{}\" is unknown; expected \"{}\"", oneLine(key), fmt::join(known, "\", \"")), file);
}

std::vector<ConfigurationText> readConfigurations(const std::filesystem::path& file) {
  const std::vector<std::byte> bytes = readFile(file, kMaxFileBytes);
  std::vector<ConfigurationText> result;
  try {
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    const nlohmann::json root = nlohmann::json::parse(text);
    requireKeys(root, {"configurations"}, file);
    for (const nlohmann::json& entry : root.at("configurations")) {
      requireKeys(entry, {"name", "options"}, file);
      result.push_back({entry.at("name").get<std::string>(), entry.value("options", std::string())});
    }
  } catch (const nlohmann::json::exception& error) {
    throw Error(
        ErrorCode::kMalformed,
        fmt::format("expected {{\"configurations\": [{{\"name\": ..., \"options\": ...}}]}} ({})", error.what()), file);
  }
  return result;
}

}  // namespace

std::vector<ConfigurationText> chosenConfigurations(const std::string& list) {
  std::vector<ConfigurationText> chosen;
  if (list.ends_with(".json")) {
    chosen = readConfigurations(list);
  } else {
    for (const std::string& name : split(list, ','))
      add(chosen, name);
  }
  if (chosen.empty()) throw Error(ErrorCode::kUsage, "no configuration is chosen", list);
  return chosen;
}

ConfigurationText parseConfiguration(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0)
    throw Error(ErrorCode::kUsage, fmt::format("--config {}: expected NAME=OPTIONS", text));
  return {text.substr(0, equals), text.substr(equals + 1)};
}

RenderOptions optionsOf(const ConfigurationText& configuration) {
  RenderOptions options;
  CLI::App parser;
  parser.set_help_flag();
  addMethodOptions(parser, options);
  try {
    cli::parse(parser, configuration.options);
    options.statsOnly = true;  // the experiment saves the pictures, so --output is not required
    options.finish();
  } catch (const Error& error) {
    throw Error(error.code(), fmt::format("configuration \"{}\": {}", configuration.name, error.what()));
  }
  options.frameOptions.skipDraw = false;
  return options;
}

std::string describeConfigurations() {
  std::string text = "Configurations and their options of `jalousie render`:\n";
  for (const BuiltIn& b : kBuiltIns)
    text += fmt::format("  {:<21} {}\n", b.name, *b.options == '\0' ? "(the defaults)" : b.options);
  text += "Sets:\n";
  for (const Set& set : kSets)
    text += fmt::format("  {:<21} {}: {}\n", set.name, set.description, fmt::join(split(set.members, ','), ", "));
  return text;
}

}  // namespace jalousie::app
