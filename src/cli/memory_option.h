// Options whose values are amounts of memory.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "core/memory_limit.h"

namespace CLI {
class App;
}

namespace jalousie::cli {

/// A check for options that take bytes, or a whole number with K, M, G or T (powers of 1024): it replaces the text by
/// the number of bytes. @param least  smallest value but for 0   @return  empty, or what is wrong with the text
std::function<std::string(std::string& text)> bytesOption(std::uint64_t least);

/// Declares --max-memory on a command; limit must outlive the parse.
void addMemoryOption(CLI::App& command, MemoryLimit& limit);

}  // namespace jalousie::cli
