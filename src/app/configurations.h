// Ways to render that the program knows by name, and those of a file.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/render_options.h"

namespace jalousie::app {

/// A name, and the options of `jalousie render` that it stands for.
struct ConfigurationText {
  std::string name;
  std::string options;
};

/// @param list  names of sets and configurations, separated by commas, or the path of a file that ends in .json:
///              {"configurations": [{"name": "coarse", "options": "--tau 4"}, ...]}
/// What is named twice counts once. Errors: kUsage for an unknown name; kMalformed, kLimit and as readFile for a file.
std::vector<ConfigurationText> chosenConfigurations(const std::string& list);

/// "NAME=OPTIONS". Errors: kUsage.
ConfigurationText parseConfiguration(const std::string& text);

/// The options of one; camera and output have none. Errors: kUsage, naming the configuration.
RenderOptions optionsOf(const ConfigurationText& configuration);

/// All sets with what is in them, for --help.
std::string describeConfigurations();

}  // namespace jalousie::app
