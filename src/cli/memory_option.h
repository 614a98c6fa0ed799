// --max-memory of the programs that estimate their memory.
#pragma once

#include "core/memory_limit.h"

namespace CLI {
class App;
}

namespace jalousie::cli {

/// Declares --max-memory on a command; limit must outlive the parse.
void addMemoryOption(CLI::App& command, MemoryLimit& limit);

}  // namespace jalousie::cli
