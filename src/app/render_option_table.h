// The options of `jalousie render` that choose a picture, once: the command line, the viewer's panel and the command
// that the viewer copies all read this table.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "app/render_options.h"

namespace CLI {
class App;
}

namespace jalousie::app {

/// A value with names: one row of a table of src/policy, or one of two.
struct ChoiceValue {
  std::string (*get)(const RenderOptions&);            ///< its name; empty where nothing is chosen
  void (*set)(RenderOptions&, std::string_view name);  ///< @pre one of names, or empty where that may be (checked)
  std::vector<std::string> names;
};
/// Where a value lies in the options, and its range. `of` lends the value.
struct NumberValue {
  float& (*of)(RenderOptions&);
  float least, most;
};
struct MaybeNumberValue {  ///< absent: the method decides
  std::optional<float>& (*of)(RenderOptions&);
  float least, most;
};
struct CountValue {
  std::uint32_t& (*of)(RenderOptions&);
  std::uint32_t least, most;
};
struct MaybeCountValue {  ///< absent: no limit
  std::optional<std::uint32_t>& (*of)(RenderOptions&);
  std::uint32_t least, most;
};
struct FlagValue {
  bool& (*of)(RenderOptions&);
};
struct TextValue {  ///< empty: absent
  std::string& (*of)(RenderOptions&);
  const char* type;
};
struct FileValue {
  std::filesystem::path& (*of)(RenderOptions&);
  const char* type;
};
using OptionValue = std::variant<ChoiceValue, NumberValue, MaybeNumberValue, CountValue, MaybeCountValue, FlagValue,
                                 TextValue, FileValue>;

/// What an option is about; the panel has a section for each.
enum class OptionGroup { kCulling, kDetail, kDrawing, kView };

struct RenderOption {
  const char* name;   ///< "--tau"
  const char* label;  ///< for people: "error budget"
  const char* unit;   ///< "pixels"; empty where there is none
  std::string help;   ///< what it does
  OptionGroup group;
  OptionValue value;
  std::string needs = {};                           ///< what it goes with, for the refusal: "--detail tessellation"
  bool (*applies)(const RenderOptions&) = nullptr;  ///< null: always
};

/// All of them, in the order of --help.
std::span<const RenderOption> renderOptionTable();
/// @pre the name is in the table (checked)
const RenderOption& renderOption(std::string_view name);

/// Help text with the unit behind it.
std::string optionHelp(const RenderOption& option);
/// Whether it goes with the other options.
bool applies(const RenderOption& option, const RenderOptions& options);
/// Whether it was said on the command line, or has another value than a fresh RenderOptions.
bool isSet(const RenderOption& option, const RenderOptions& options);
/// Value as the command line takes it; empty for a flag and for what is absent.
std::string valueText(const RenderOption& option, const RenderOptions& options);
/// Puts back the value of a fresh RenderOptions.
void reset(const RenderOption& option, RenderOptions& options);
/// Resets what does not apply, until nothing changes.
void dropInapplicable(RenderOptions& options);

/// Declares an option on a subcommand; options must outlive the parse.
void addToCommandLine(CLI::App& command, const RenderOption& option, RenderOptions& options);

}  // namespace jalousie::app
