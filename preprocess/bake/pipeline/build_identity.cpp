// Reads the build IDs that linkers write; a library without a build ID is hashed.
#include "bake/pipeline/build_identity.h"

#include <elf.h>
#include <fmt/format.h>
#include <link.h>

#include <cstring>
#include <set>
#include <string_view>

#include "bake/pipeline/digest.h"
#include "core/error.h"
#include "core/file.h"

namespace jalousie::bake {
namespace {

constexpr std::uint64_t kMaxLibraryBytes = 1ULL << 30U;

std::size_t aligned(std::size_t size) {
  return (size + 3) / 4 * 4;
}

/// The NT_GNU_BUILD_ID note of a loaded object as digits; empty if it has none.
std::string buildId(const dl_phdr_info& object) {
  for (std::size_t i = 0; i < object.dlpi_phnum; ++i) {
    if (object.dlpi_phdr[i].p_type != PT_NOTE) continue;
    const char* note = reinterpret_cast<const char*>(object.dlpi_addr + object.dlpi_phdr[i].p_vaddr);
    const char* end = note + object.dlpi_phdr[i].p_memsz;
    while (static_cast<std::size_t>(end - note) >= sizeof(ElfW(Nhdr))) {
      ElfW(Nhdr) header;
      std::memcpy(&header, note, sizeof header);
      const char* name = note + sizeof header;
      const char* data = name + aligned(header.n_namesz);
      if (header.n_type == NT_GNU_BUILD_ID && header.n_namesz == 4 && std::memcmp(name, "GNU", 4) == 0)
        return sha256(std::string_view(data, header.n_descsz));
      note = data + aligned(header.n_descsz);
    }
  }
  return {};
}

int visit(dl_phdr_info* object, std::size_t, void* user) {
  const std::string_view name = object->dlpi_name;
  if (name.find("linux-vdso") != std::string_view::npos) return 0;  // part of the kernel; it does no arithmetic of ours
  std::string id = buildId(*object);
  if (id.empty()) {
    try {
      id = sha256(readFile(name.empty() ? "/proc/self/exe" : std::string(name), kMaxLibraryBytes));
    } catch (const Error&) {
      id = name;
    }
  }
  static_cast<std::set<std::string>*>(user)->insert(id);
  return 0;
}

}  // namespace

std::string buildIdentity() {
  std::set<std::string> ids;  // ordered: the order in memory is arbitrary
  ::dl_iterate_phdr(visit, &ids);
  std::string text = kVersion;
  for (const std::string& id : ids)
    text += "\n" + id;
  return text;
}

}  // namespace jalousie::bake
