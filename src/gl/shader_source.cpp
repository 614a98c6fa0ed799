// A minimal preprocessor: #include and defines only, everything else is the GLSL compiler's.
#include "gl/shader_source.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.h"
#include "core/file.h"

namespace jalousie::gl {
namespace {

constexpr std::uint64_t kMaxShaderBytes = 1U << 20U;

/// The name between quotes if the line is an #include, else empty.
std::string_view includedName(std::string_view line) {
  constexpr std::string_view kInclude = "#include \"";
  if (!line.starts_with(kInclude)) return {};
  line.remove_prefix(kInclude.size());
  return line.substr(0, line.find('"'));
}

void expand(std::string_view name, std::span<const std::string_view> defines, const ShaderLibrary& library,
            ExpandedShader& result) {
  const std::size_t file = result.files.size();
  result.files.emplace_back(name);
  const std::string whole = library.text(name);
  std::string_view text = whole;
  for (int line = 1; !text.empty(); ++line) {
    const std::size_t end = std::min(text.find('\n'), text.size() - 1);
    const std::string_view current = text.substr(0, end + 1);
    text.remove_prefix(end + 1);
    if (current.starts_with("#version")) {
      result.text += current;
      for (const std::string_view define : defines) {
        const std::size_t equals = define.find('=');
        const bool hasValue = equals != std::string_view::npos;
        result.text +=
            fmt::format("#define {} {}\n", define.substr(0, equals), hasValue ? define.substr(equals + 1) : "1");
      }
      result.text += fmt::format("#line {} {}\n", line + 1, file);
    } else if (const std::string_view included = includedName(current); !included.empty()) {
      if (std::find(result.files.begin(), result.files.end(), included) != result.files.end()) {
        result.text += '\n';
        continue;
      }
      result.text += fmt::format("#line 1 {}\n", result.files.size());
      expand(included, defines, library, result);
      result.text += fmt::format("#line {} {}\n", line + 1, file);
    } else if (!result.text.empty()) {
      result.text += current;  // comments before #version are dropped: some compilers want it first
    }
  }
}

}  // namespace

std::string ShaderLibrary::text(std::string_view name) const {
  std::error_code failed;
  if (!folder_.empty() && std::filesystem::exists(folder_ / name, failed)) {
    const std::vector<std::byte> bytes = readFile(folder_ / name, kMaxShaderBytes);
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
  }
  for (const EmbeddedShader& shader : embeddedShaders())
    if (shader.name == name) return std::string(shader.text);
  throw Error(ErrorCode::kShader, fmt::format("no shader named '{}'", name));
}

ExpandedShader expandShader(std::string_view name, std::span<const std::string_view> defines,
                            const ShaderLibrary& library) {
  ExpandedShader result;
  expand(name, defines, library, result);
  if (!result.text.starts_with("#version"))
    throw Error(ErrorCode::kShader, fmt::format("shader '{}' has no #version line", name));
  return result;
}

}  // namespace jalousie::gl
