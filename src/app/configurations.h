// Configurations of `jalousie compare`: built-in ones, those of a file and those of the command line.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/render_options.h"

namespace jalousie::app {

/// A name and options of `jalousie render`.
struct ConfigurationText {
  std::string name;
  std::string options;
};

/// Parses the value of --configs.
/// @param list  names of sets and configurations, separated by commas; a configuration that is named twice counts once.
///              Or the path of a file that ends in .json: {"configurations": [{"name": "coarse", "options": "--tau
///              4"}]}
/// Errors: kUsage for an unknown name or an empty list; kMalformed, kLimit and as readFile for a file.
std::vector<ConfigurationText> chosenConfigurations(const std::string& list);

/// "NAME=OPTIONS". Errors: kUsage.
ConfigurationText parseConfiguration(const std::string& text);

/// Parses a configuration's options: those that choose the method, without camera and output. Errors: kUsage; the
/// message names the configuration.
RenderOptions optionsOf(const ConfigurationText& configuration);

/// All built-in configurations and sets, for --help.
std::string describeConfigurations();

}  // namespace jalousie::app
