// Checks of option values that CLI11 lacks.
#pragma once

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <string>

namespace jalousie::cli {

/// A number in [least, most]; unlike CLI::Range it refuses NaN.
inline CLI::Validator inRange(double least, double most) {
  const std::string range = fmt::format("{}..{}", least, most);
  return {[least, most, range](std::string& text) {
            double value = 0.0;
            const bool inside = CLI::detail::lexical_cast(text, value) && value >= least && value <= most;
            return inside ? std::string() : fmt::format("Value {} not in range {}", text, range);
          },
          range};
}

/// A finite number above 0; CLI::PositiveNumber says its limit in 309 digits.
inline CLI::Validator positive() {
  return {[](std::string& text) {
            double value = 0.0;
            const bool fits = CLI::detail::lexical_cast(text, value) && value > 0.0 && std::isfinite(value);
            return fits ? std::string() : fmt::format("Value {} is no number above 0", text);
          },
          "above 0"};
}

}  // namespace jalousie::cli
