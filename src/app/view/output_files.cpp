// Names of the files that the viewer writes.
#include "app/view/output_files.h"

#include <fmt/format.h>

#include <system_error>

namespace jalousie::app {

std::filesystem::path freshOutput(const std::filesystem::path& folder, const char* stem, const char* extension) {
  for (int number = 1;; ++number) {
    std::filesystem::path file = folder / fmt::format("{}-{:04}{}", stem, number, extension);
    std::error_code failed;
    if (!std::filesystem::exists(file, failed)) return file;
  }
}

}  // namespace jalousie::app
