// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "base/aligned_vector.h"

#include <cstdint>
#include <cstdlib>
#include <new>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace Talus {
namespace {
constexpr std::size_t cache_line = 64, huge_page = std::size_t{1} << 21;

std::size_t rounded_up(std::size_t bytes, std::size_t unit)
{
  return (bytes + unit - 1) / unit * unit;
}

bool is_large(std::size_t bytes)
{
  return bytes >= huge_page / 2;
}

#if defined(__linux__)
/* Mapped with room for one huge page more, of which what is before and behind the block is
   returned. */

void *map_large(std::size_t bytes)
{
  const std::size_t size = rounded_up(bytes, huge_page);
  if (size < bytes || size + huge_page < size) return nullptr;
  void *mapped =
      mmap(nullptr, size + huge_page, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (mapped == MAP_FAILED) return nullptr;
  const auto at = reinterpret_cast<std::uintptr_t>(mapped);
  const std::size_t before = rounded_up(at, huge_page) - at, behind = huge_page - before;
  char *const block = static_cast<char *>(mapped) + before;
  if (before) munmap(mapped, before);
  if (behind) munmap(block + size, behind);
#if defined(MADV_HUGEPAGE)
  madvise(block, size, MADV_HUGEPAGE);    // a wish only
#endif
  return block;
}
#else
void *map_large(std::size_t bytes)
{
  return std::aligned_alloc(huge_page, rounded_up(bytes, huge_page));
}
#endif
}    // namespace

/* Only what is written becomes resident, but a huge page at a time. */

void *allocate_aligned(std::size_t bytes)
{
  void *memory = is_large(bytes)
                     ? map_large(bytes)
                     : std::aligned_alloc(cache_line, rounded_up(bytes ? bytes : 1, cache_line));
  if (!memory) throw std::bad_alloc();
  return memory;
}

void release_aligned(void *memory, std::size_t bytes) noexcept
{
#if defined(__linux__)
  if (is_large(bytes)) {
    munmap(memory, rounded_up(bytes, huge_page));
    return;
  }
#endif
  std::free(memory);
}

}    // namespace Talus
