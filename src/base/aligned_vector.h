// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// std::vector whose storage begins at a cache line, and at a huge page if it is large: contacts
// touch their partners in an order that the hardware cannot predict, and with pages of 4 kB the
// search for the page costs as much as the load itself. Nothing else stands in its cache lines:
// what a thread writes in every step, however small it is, must not share one with what others
// read, or all of them wait for each other. New elements of plain types are not set.

#ifndef TALUS_BASE_ALIGNED_VECTOR_H
#define TALUS_BASE_ALIGNED_VECTOR_H

#include <cstddef>
#include <new>
#include <utility>
#include <vector>

namespace Talus {

/// Throws std::bad_alloc. Memory of release_aligned() must come from allocate_aligned() with the
/// same number of bytes. Large blocks come from the system and go back to it at once: those of the
/// C library may stay resident, below others that are still in use.
void *allocate_aligned(std::size_t bytes);
void release_aligned(void *memory, std::size_t bytes) noexcept;

template <class T> struct AlignedAllocator {
  using value_type = T;
  AlignedAllocator() = default;
  template <class Other> AlignedAllocator(const AlignedAllocator<Other> &) noexcept {}
  T *allocate(std::size_t n) { return static_cast<T *>(allocate_aligned(n * sizeof(T))); }
  void deallocate(T *memory, std::size_t n) noexcept { release_aligned(memory, n * sizeof(T)); }
  /// Elements that a vector makes by itself, as resize() does, are left as the memory is: most
  /// arrays are filled right after, by several threads.
  template <class Element, class... Arguments>
  void construct(Element *element, Arguments &&...arguments)
  {
    if constexpr (sizeof...(Arguments) == 0)
      ::new (static_cast<void *>(element)) Element;
    else
      ::new (static_cast<void *>(element)) Element(std::forward<Arguments>(arguments)...);
  }
  bool operator==(const AlignedAllocator &) const { return true; }
  bool operator!=(const AlignedAllocator &) const { return false; }
};

template <class T> using AlignedVector = std::vector<T, AlignedAllocator<T>>;

/// Memory that every rebuild needs is released in between only above this size (bytes): the
/// operating system has to zero pages that are allocated again, which takes time where lists are
/// rebuilt often.
constexpr double release_threshold = 16 << 20;

/// Releases the memory of a vector.
template <class Vector> void release(Vector &v)
{
  Vector().swap(v);
}

/// Resizes a vector to `n` elements without keeping its content: the old storage is released before
/// the new one is allocated, so that rebuilds do not double the peak of memory. Reserves 3 % more,
/// for counts of pairs that grow from one rebuild to the next.
template <class Vector> void renew(Vector &v, std::size_t n)
{
  if (v.capacity() < n) {
    release(v);
    v.reserve(n + n / 32);
  }
  v.resize(n);
}

}    // namespace Talus

#endif
