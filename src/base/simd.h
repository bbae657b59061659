// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The vectors of the contact code (base/vectors.h), what laws and geometry do with them, and their
// way from and to memory. The same source serves SSE2, AVX2, AVX-512 and NEON.
//
//   Vec4  one Record: the four numbers of one particle
//   Vec8  one number of eight contacts; laws are templates over Real = double or Vec8
//
// Everything here rounds as IEEE 754 prescribes, so results do not depend on the lane or on the
// width of the machine's registers (build with -ffp-contract=off).

#ifndef TALUS_BASE_SIMD_H
#define TALUS_BASE_SIMD_H

#include "base/vectors.h"

#include <cmath>
#include <cstdint>

namespace Talus {

inline constexpr int lanes = 8;

/// The same number in every lane.
template <class Real> inline Real splat(double value)
{
  return value - Real{};    // not +, which would turn -0 into 0 and stay in the code
}

template <class Real> inline Real magnitude(Real a)
{
  return select(a < splat<Real>(0.0), -a, a);
}

/// A function of the C library, or of our own, for every lane.
template <class Vector, class Function>
TALUS_INLINE Vector for_each_lane(Vector a, Function function)
{
  for (int k = 0; k < width_of<Vector>; k++) a[k] = function(a[k]);
  return a;
}

inline double hyperbolic_tangent(double a)
{
  return std::tanh(a);
}
template <class Vector> inline Vector hyperbolic_tangent(Vector a)
{
  return for_each_lane(a, [](double one) { return hyperbolic_tangent(one); });
}

/// Fifth root of a number >= 0, to two units in the last place.
inline double fifth_root(double a)
{
  return a > 0.0 ? std::pow(a, 0.2) : 0.0;
}
template <class Vector> inline Vector fifth_root(Vector a)
{
  return for_each_lane(a, [](double one) { return fifth_root(one); });
}

/// One of two, without a branch, which processors could not predict.
template <class Vector> TALUS_INLINE Vector chosen(bool condition, Vector one, Vector other)
{
  typedef bool_of<Vector> Bits;
  const Bits mask = Bits{} - static_cast<std::int64_t>(condition);
  return (Vector) (((Bits) one & mask) | ((Bits) other & ~mask));
}
template <class Half>
TALUS_INLINE DoubleWidth<Half> chosen(bool condition, DoubleWidth<Half> one,
                                      DoubleWidth<Half> other)
{
  return {chosen(condition, one.low, other.low), chosen(condition, one.high, other.high)};
}

/// The vector, or zero: no branch, which processors could not predict.
TALUS_INLINE Vec4 kept_if(bool condition, Vec4 vector)
{
  return chosen(condition, vector, Vec4{});
}

/// One of two addresses, without a branch.
template <class T> TALUS_INLINE const T *chosen(bool condition, const T *one, const T *other)
{
  const std::uintptr_t mask = std::uintptr_t{0} - static_cast<std::uintptr_t>(condition);
  const auto address = (reinterpret_cast<std::uintptr_t>(one) & mask) |
                       (reinterpret_cast<std::uintptr_t>(other) & ~mask);
  return reinterpret_cast<const T *>(address);
}

/// Loads and stores; `address` must be aligned to the size of the vector. Vectors of the machine
/// may overlay arrays of their numbers.
template <class Vector> struct Memory {
  using Number = number_of<Vector>;
  typedef Vector Overlay __attribute__((may_alias));
  typedef Vector Anywhere __attribute__((may_alias, aligned(alignof(Number))));

  TALUS_INLINE static Vector load(const Number *a) { return *reinterpret_cast<const Overlay *>(a); }
  TALUS_INLINE static void store(Number *a, Vector v) { *reinterpret_cast<Overlay *>(a) = v; }
  /// At any address of a number.
  TALUS_INLINE static Vector load_anywhere(const Number *a)
  {
    return *reinterpret_cast<const Anywhere *>(a);
  }
  TALUS_INLINE static void store_anywhere(Number *a, Vector v)
  {
    *reinterpret_cast<Anywhere *>(a) = v;
  }
};

template <class Half> struct Memory<DoubleWidth<Half>> {
  using Number = number_of<Half>;
  using Part = Memory<Half>;
  static constexpr int width = width_of<Half>;

  TALUS_INLINE static DoubleWidth<Half> load(const Number *a)
  {
    return {Part::load(a), Part::load(a + width)};
  }
  TALUS_INLINE static void store(Number *a, DoubleWidth<Half> v)
  {
    Part::store(a, v.low);
    Part::store(a + width, v.high);
  }
  TALUS_INLINE static DoubleWidth<Half> load_anywhere(const Number *a)
  {
    return {Part::load_anywhere(a), Part::load_anywhere(a + width)};
  }
  TALUS_INLINE static void store_anywhere(Number *a, DoubleWidth<Half> v)
  {
    Part::store_anywhere(a, v.low);
    Part::store_anywhere(a + width, v.high);
  }
};

TALUS_INLINE Vec4 load4(const double *address)
{
  return Memory<Vec4>::load(address);
}

TALUS_INLINE Vec8 load8(const double *address)
{
  return Memory<Vec8>::load(address);
}

template <class Vector> TALUS_INLINE void store(number_of<Vector> *address, Vector value)
{
  Memory<Vector>::store(address, value);
}

/// Which numbers of a vector of four go side by side for each choice of them, as bytes.
struct ChosenBytes {
  std::uint8_t from[16][16] = {};
  std::uint8_t count[16] = {};

  constexpr ChosenBytes()
  {
    for (int bits = 0; bits < 16; bits++)
      for (int k = 0; k < 4; k++)
        if (bits >> k & 1) {
          for (int byte = 0; byte < 4; byte++)
            from[bits][4 * count[bits] + byte] = static_cast<std::uint8_t>(4 * k + byte);
          count[bits]++;
        }
  }
};
alignas(16) inline constexpr ChosenBytes chosen_bytes{};

/// Stores the integers whose bits are set side by side, and returns their number. Writes all places
/// of the vector in any case: no branch, which processors could not predict.
template <class Vector>
TALUS_INLINE int store_chosen(number_of<Vector> *to, unsigned bits, Vector values)
{
  static_assert(sizeof(number_of<Vector>) == 4);
  // compressed in a register: to compress into memory takes some processors a hundred cycles
#if defined(__AVX512VL__)
  if constexpr (sizeof(Vector) == 64) {
    const auto mask = static_cast<__mmask16>(bits);
    _mm512_storeu_si512(to, _mm512_maskz_compress_epi32(mask, (__m512i) values));
    return __builtin_popcount(mask);
  } else if constexpr (sizeof(Vector) == 32) {
    const auto mask = static_cast<__mmask8>(bits);
    _mm256_storeu_si256(reinterpret_cast<__m256i *>(to),
                        _mm256_maskz_compress_epi32(mask, (__m256i) values));
    return __builtin_popcount(mask);
  }
#elif defined(__AVX2__)
  if constexpr (sizeof(Vector) == 32) {
    typedef VectorOf<number_of<Vector>, 4> Half;
    const int low = store_chosen(to, bits, (Half) _mm256_castsi256_si128((__m256i) values));
    return low +
           store_chosen(to + low, bits >> 4, (Half) _mm256_extracti128_si256((__m256i) values, 1));
  }
#endif
#if defined(__SSSE3__)
  if constexpr (sizeof(Vector) == 16) {
    const auto *from = reinterpret_cast<const __m128i *>(chosen_bytes.from[bits & 15U]);
    _mm_storeu_si128(reinterpret_cast<__m128i *>(to),
                     _mm_shuffle_epi8((__m128i) values, _mm_load_si128(from)));
    return chosen_bytes.count[bits & 15U];
  }
#elif defined(__aarch64__)
  if constexpr (sizeof(Vector) == 16) {
    const uint8x16_t from = vld1q_u8(chosen_bytes.from[bits & 15U]);
    Memory<Vector>::store_anywhere(to, (Vector) vqtbl1q_u8((uint8x16_t) values, from));
    return chosen_bytes.count[bits & 15U];
  }
#endif
  int count = 0;
  for (int k = 0; k < width_of<Vector>; k++) {
    to[count] = values[k];
    count += static_cast<int>(bits >> k & 1U);
  }
  return count;
}
template <class Half>
TALUS_INLINE int store_chosen(number_of<Half> *to, unsigned bits, DoubleWidth<Half> values)
{
  const int low = store_chosen(to, bits, values.low);
  return low + store_chosen(to + low, bits >> width_of<Half>, values.high);
}

/// Stores first + k for every bit k of the lower eight, side by side, and returns their number.
/// Writes eight places in any case.
TALUS_INLINE int store_places(std::uint32_t *to, std::uint32_t first, unsigned bits)
{
  return store_chosen(to, bits, counting<VectorOf<std::uint32_t, 8>>() + first);
}

/// Which of eight integers is the wanted one; the first of them, or 8 if none is.
TALUS_INLINE int find_of_eight(const std::int32_t *values, std::int32_t wanted)
{
  const auto eight = Memory<VectorOf<std::int32_t, 8>>::load_anywhere(values);
  return __builtin_ctz(bits_of(eight == wanted) | 1U << 8);
}

/// For data that another core reads next: a non-temporal store, which does not load the cache line
/// first. If the cores are far from each other, that load takes as long as hundreds of additions.
/// Such stores may become visible late: call streams_are_done() before another thread reads them.
TALUS_INLINE void stream(double *address, Vec4 value)
{
#if defined(__AVX__)
  _mm256_stream_pd(address, (__m256d) value);
#else
  store(address, value);
#endif
}
TALUS_INLINE void stream(float *address, Float8 value)
{
#if defined(__AVX__)
  _mm256_stream_ps(address, (__m256) value);
#else
  store(address, value);
#endif
}

TALUS_INLINE void streams_are_done()
{
#if defined(__AVX__)
  _mm_sfence();
#endif
}

}    // namespace Talus

#endif
