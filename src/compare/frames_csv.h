// frames.csv: the figures of every frame as a table.
#pragma once

#include <string>
#include <vector>

#include "compare/results.h"

namespace jalousie::compare {

struct Configuration;

/// One line per frame and configuration; columns in docs/compare.md. A pass or a level that some configuration has is a
/// column for all of them, empty or 0 where it did not occur.
std::string framesCsv(const Results& results, const std::vector<Configuration>& configurations);

}  // namespace jalousie::compare
