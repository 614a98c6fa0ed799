// Bytes with an optional unit, as CLI11 reads them.
#include "cli/memory_option.h"

#include <CLI/CLI.hpp>

namespace jalousie::cli {

void addMemoryOption(CLI::App& command, MemoryLimit& limit) {
  CLI::Validator bytesWithUnit = CLI::AsSizeValue(false);
  bytesWithUnit.description("");
  command
      .add_option("--max-memory", limit.bytes,
                  "Refuse what would need more memory, on the host and on the GPU together, by an estimate made before "
                  "it is allocated; bytes or with K, M, G; 0: no limit")
      ->transform(bytesWithUnit)
      ->type_name("SIZE")
      ->default_str("2G");
}

}  // namespace jalousie::cli
