// What the command lines of all programs share: how a program starts and ends, and how options are parsed.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

namespace CLI {
class App;
}

namespace jalousie::cli {

/// Runs the body of main and ends every program alike. Standard output is flushed and checked at the end; a write that
/// failed gives kWriteFailed. An exception becomes one line on standard error and an exit code: the code of an Error,
/// kLimit where memory ran out, else kInternal. Nothing is printed if standard output is a pipe that nobody reads any
/// more. SIGHUP, SIGINT and SIGTERM: see core/interruption.h.
/// @param name  of the program, before each line   @return  exit code
int runProgram(const char* name, const std::function<int()>& body);

/// Runs a part of a program. Failures without a file get this one. Memory that runs out in spite of all estimates is a
/// kLimit of this file.
void withFile(const std::filesystem::path& file, const std::function<void()>& task);

/// Parses a command line; every help then ends with the exit codes. No option and no positional may have an empty
/// value: it would be taken for an absent one, and no file has an empty name.
/// @return  false if --help or --version was answered on standard output
/// Errors: kUsage, with a message that names the --help of the command; kWriteFailed.
bool parse(CLI::App& program, int argc, const char* const* argv);

/// Parses options that stand in one text, such as those of a configuration. Errors: kUsage, as parse.
void parse(CLI::App& program, const std::string& options);

}  // namespace jalousie::cli
