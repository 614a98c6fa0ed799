// Signals, standard streams, exceptions and CLI11.
#include "cli/program.h"

#include <fmt/format.h>
#include <signal.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <exception>
#include <new>
#include <sstream>
#include <string_view>

#include "core/error.h"
#include "core/interruption.h"
#include "core/standard_streams.h"

namespace jalousie::cli {
namespace {

constexpr const char* kExitCodes =
    "Exit codes: 0 done, 2 command line, 3 file not found, 4 cannot be read, 5 malformed, 6 not supported, 7 over a "
    "limit,\n8 cannot be written, 9 no OpenGL 4.5 or no display, 10 a shader does not build, 11 some files of a batch "
    "failed,\n70 a defect, 129, 130, 143 interrupted by SIGHUP, SIGINT, SIGTERM. A failure prints one line on standard "
    "error;\nan existing file that could not be replaced is unchanged.";

/// The deepest subcommand that was given, else the program.
const CLI::App& chosenCommand(const CLI::App& program) {
  const CLI::App* command = &program;
  while (!command->get_subcommands().empty())
    command = command->get_subcommands().front();
  return *command;
}

std::string commandName(const CLI::App& program) {
  const CLI::App& chosen = chosenCommand(program);
  if (&chosen != &program) return program.get_name() + " " + chosen.get_name();
  const bool hasCommands = !program.get_subcommands([](const CLI::App*) { return true; }).empty();
  return program.get_name() + (hasCommands ? " COMMAND" : "");
}

/// Ends the help of a command and of its subcommands with the exit codes.
void addExitCodes(CLI::App& command) {
  std::string footer = command.get_footer();
  footer.erase(footer.find_last_not_of('\n') + 1);
  command.footer(footer + (footer.empty() ? "" : "\n\n") + kExitCodes);
  for (CLI::App* subcommand : command.get_subcommands([](const CLI::App*) { return true; }))
    addExitCodes(*subcommand);
}

void refuseEmptyValues(const CLI::App& command) {
  for (const CLI::Option* option : command.get_options())
    if (option->get_type_size() > 0 && std::any_of(option->results().begin(), option->results().end(),
                                                   [](const std::string& value) { return value.empty(); }))
      throw Error(ErrorCode::kUsage, fmt::format("{}: the value is empty", option->get_name()));
}

}  // namespace

int runProgram(const char* name, const std::function<int()>& body) {
  openStandardStreams();
  ::signal(SIGPIPE, SIG_IGN);  // a write to a pipe without reader is an error like any other
  endOnInterruptions(name);
  const auto fail = [name](ErrorCode code, std::string_view reason) {
    if (!outputReaderIsGone()) printError(fmt::format("{}: {}", name, reason));
    return static_cast<int>(code);
  };
  try {
    try {
      const int code = body();
      flushOutput();
      return code;
    } catch (const Error&) {
      throw;
    } catch (const std::exception&) {
      if (std::ferror(stdout) != 0) flushOutput();  // what fmt::print throws says less
      throw;
    }
  } catch (const Error& error) {
    return fail(error.code(), error.what());
  } catch (const std::bad_alloc&) {
    return fail(ErrorCode::kLimit, "out of memory");
  } catch (const std::exception& error) {
    return fail(ErrorCode::kInternal, "internal error: " + oneLine(error.what()));
  }
}

void withFile(const std::filesystem::path& file, const std::function<void()>& task) {
  try {
    task();
  } catch (const Error& error) {
    if (!error.file().empty() || error.code() == ErrorCode::kUsage) throw;
    throw Error(error.code(), error.what(), file);
  } catch (const std::bad_alloc&) {
    throw Error(ErrorCode::kLimit, "out of memory", file);
  }
}

namespace {

/// What was wrong with the command line. CLI11 says "Could not convert: --size = 10x".
std::string reasonOf(const CLI::ParseError& error) {
  const std::string reason = error.what();
  const std::string prefix = "Could not convert: ";
  const std::size_t equals = reason.find(" = ");
  if (!reason.starts_with(prefix) || equals == std::string::npos) return reason;
  return fmt::format("{}: {} is no such value", reason.substr(prefix.size(), equals - prefix.size()),
                     reason.substr(equals + 3));
}

}  // namespace

bool parse(CLI::App& program, int argc, const char* const* argv) {
  addExitCodes(program);
  try {
    program.parse(argc, argv);
    refuseEmptyValues(program);
    refuseEmptyValues(chosenCommand(program));
    return true;
  } catch (const CLI::Success& answer) {
    std::ostringstream text;
    program.exit(answer, text, text);
    printOutput(text.str());
    return false;
  } catch (const CLI::ParseError& error) {
    throw Error(ErrorCode::kUsage, fmt::format("{} (see {} --help)", reasonOf(error), commandName(program)));
  } catch (const Error& error) {
    throw Error(error.code(), fmt::format("{} (see {} --help)", error.what(), commandName(program)));
  }
}

void parse(CLI::App& program, const std::string& options) {
  try {
    program.parse(options);
  } catch (const CLI::ParseError& error) {
    throw Error(ErrorCode::kUsage, error.what());
  }
  refuseEmptyValues(program);
}

}  // namespace jalousie::cli
