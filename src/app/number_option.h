// Options that take a number, shown by --help as NAME LEAST..MOST=DEFAULT.
#pragma once

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <string>

#include "cli/option_checks.h"

namespace jalousie::app {

/// Values that an option accepts, both ends included.
struct NumberRange {
  double least;
  double most;

  std::string text() const { return fmt::format("{}..{}", least, most); }
};

/// Checks an option's number and shows range and default in --help. @param standard  the default
template <class Number>
CLI::Option* limit(CLI::Option* option, NumberRange range, Number standard) {
  return option->check(cli::inRange(range.least, range.most).description(""))
      ->type_name(range.text())
      ->default_str(fmt::format("{:g}", static_cast<double>(standard)));
}

/// Adds an option whose default is the target's value. target must outlive the parse.
template <class Number>
CLI::Option* addNumber(CLI::App& command, const char* name, Number& target, NumberRange range, const char* help) {
  return limit(command.add_option(name, target, help), range, target);
}

}  // namespace jalousie::app
