// Reports a broken contract on stderr and aborts, so that a debugger or core dump sees the culprit's stack.
#include "core/check.h"

#include <cstdio>
#include <cstdlib>

namespace jalousie::detail {

void checkFailed(const char* expression, const char* file, int line, const CheckResult& result) {
  std::fflush(stdout);
  fmt::print(stderr, "{}:{}: check failed: {}{}{}\n", file, line, expression, result.operands.empty() ? "" : "  with ",
             result.operands);
  std::abort();
}

}  // namespace jalousie::detail
