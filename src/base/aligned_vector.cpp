// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "base/aligned_vector.h"

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
}    // namespace

/* Only what is written becomes resident, but a huge page at a time. */

void *allocate_aligned(std::size_t bytes)
{
  const std::size_t unit = bytes >= huge_page / 2 ? huge_page : cache_line;
  void *memory = std::aligned_alloc(unit, rounded_up(bytes ? bytes : 1, unit));
  if (!memory) throw std::bad_alloc();
#if defined(MADV_HUGEPAGE)
  if (unit == huge_page) madvise(memory, rounded_up(bytes, unit), MADV_HUGEPAGE);    // a wish only
#endif
  return memory;
}

void release_aligned(void *memory) noexcept
{
  std::free(memory);
}

}    // namespace Talus
