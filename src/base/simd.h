// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The two vector types of the contact code, written with the vector extension that GCC and Clang
// share, so that the same source serves SSE2, AVX2 and AVX-512.
//
//   Vec4  one Record: the four numbers of one particle
//   Vec8  one number of eight contacts; laws are templates over Real = double or Vec8
//
// Everything here rounds as IEEE 754 prescribes, so results do not depend on the lane or on the
// width of the machine's registers (build with -ffp-contract=off).

#ifndef TALUS_BASE_SIMD_H
#define TALUS_BASE_SIMD_H

#include <cmath>
#include <cstdint>
#if defined(__SSE2__)
#include <immintrin.h>
#endif

/// For what runs inside the kernels: with hundreds of kernels in one file compilers stop to inline
/// on their own, and passing vectors through memory costs a fifth of the time. Sanitizers add
/// so much code to each operation that compilers do not cope with all of it in one function.
#if defined(__SANITIZE_ADDRESS__)
#define TALUS_INLINE inline
#else
#define TALUS_INLINE [[gnu::always_inline]] inline
#endif

namespace Talus {

typedef double Vec4 __attribute__((vector_size(32)));

inline constexpr int lanes = 8;

/// Two vectors as one of twice the width. Compilers would take a vector that is wider than the
/// registers, but compare it number by number, with branches.
template <class Half> struct Twice {
  Half low, high;

  TALUS_INLINE double operator[](int k) const { return reinterpret_cast<const double *>(this)[k]; }
  TALUS_INLINE double &operator[](int k) { return reinterpret_cast<double *>(this)[k]; }
};

#define TALUS_TWICE(op)                                                                            \
  template <class Half> TALUS_INLINE auto operator op(Twice<Half> a, Twice<Half> b)                \
  {                                                                                                \
    return Twice<decltype(a.low op b.low)>{a.low op b.low, a.high op b.high};                      \
  }
#define TALUS_TWICE_AND_NUMBER(op)                                                                 \
  TALUS_TWICE(op)                                                                                  \
  template <class Half> TALUS_INLINE Twice<Half> operator op(Twice<Half> a, double b)              \
  {                                                                                                \
    return {a.low op b, a.high op b};                                                              \
  }                                                                                                \
  template <class Half> TALUS_INLINE Twice<Half> operator op(double a, Twice<Half> b)              \
  {                                                                                                \
    return {a op b.low, a op b.high};                                                              \
  }
TALUS_TWICE_AND_NUMBER(+)
TALUS_TWICE_AND_NUMBER(-)
TALUS_TWICE_AND_NUMBER(*)
TALUS_TWICE_AND_NUMBER(/)
TALUS_TWICE(<)
TALUS_TWICE(>)
TALUS_TWICE(<=)
TALUS_TWICE(>=)
TALUS_TWICE(&)
TALUS_TWICE(|)
#undef TALUS_TWICE
#undef TALUS_TWICE_AND_NUMBER

template <class Half> TALUS_INLINE Twice<Half> operator-(Twice<Half> a)
{
  return {-a.low, -a.high};
}

#if defined(__AVX512F__)
typedef double Vec8 __attribute__((vector_size(64)));
#elif defined(__AVX__)
typedef Twice<Vec4> Vec8;
#else
typedef double Vec2 __attribute__((vector_size(16)));
typedef Twice<Twice<Vec2>> Vec8;
#endif

/// What this build uses of the machine, for the log.
inline const char *instruction_set()
{
#if defined(__AVX512F__)
  return "AVX-512";
#elif defined(__AVX2__)
  return "AVX2";
#elif defined(__AVX__)
  return "AVX";
#else
  return "baseline instructions";
#endif
}

/// The same number in every lane.
template <class Real> inline Real splat(double value)
{
  return value - Real{};    // not +, which would turn -0 into 0 and stay in the code
}

/// What a comparison of Reals yields.
template <class Real> using bool_of = decltype(Real{} < Real{});

inline double select(bool mask, double yes, double no)
{
  return mask ? yes : no;
}

inline double square_root(double a)
{
  return std::sqrt(a);
}

#if defined(__AVX512F__)
inline Vec8 select(bool_of<Vec8> mask, Vec8 yes, Vec8 no)
{
  return mask ? yes : no;
}
inline Vec8 square_root(Vec8 a)
{
  return (Vec8) _mm512_maskz_sqrt_pd(0xff, (__m512d) a);
}
#elif defined(__AVX__)
TALUS_INLINE Vec4 select(bool_of<Vec4> mask, Vec4 yes, Vec4 no)
{
  return mask ? yes : no;
}
TALUS_INLINE Vec4 square_root(Vec4 a)
{
  return (Vec4) _mm256_sqrt_pd((__m256d) a);
}
#else
TALUS_INLINE Vec2 select(bool_of<Vec2> mask, Vec2 yes, Vec2 no)
{
  return mask ? yes : no;
}
TALUS_INLINE Vec2 square_root(Vec2 a)
{
#if defined(__SSE2__)
  return (Vec2) _mm_sqrt_pd((__m128d) a);
#else
  return {std::sqrt(a[0]), std::sqrt(a[1])};
#endif
}
#endif
template <class Mask, class Half>
TALUS_INLINE Twice<Half> select(Twice<Mask> mask, Twice<Half> yes, Twice<Half> no)
{
  return {select(mask.low, yes.low, no.low), select(mask.high, yes.high, no.high)};
}
template <class Half> TALUS_INLINE Twice<Half> square_root(Twice<Half> a)
{
  return {square_root(a.low), square_root(a.high)};
}

/// Whether a comparison holds in any lane.
inline bool any(bool mask)
{
  return mask;
}
#if defined(__AVX512F__)
inline bool any(bool_of<Vec8> mask)
{
  return _mm512_test_epi64_mask((__m512i) mask, (__m512i) mask) != 0;
}
#elif defined(__AVX__)
TALUS_INLINE bool any(bool_of<Vec4> mask)
{
  return _mm256_movemask_pd((__m256d) mask) != 0;
}
#else
TALUS_INLINE bool any(bool_of<Vec2> mask)
{
  return (mask[0] | mask[1]) != 0;
}
#endif
template <class Mask> TALUS_INLINE bool any(Twice<Mask> mask)
{
  return any(mask.low) || any(mask.high);
}

template <class Real> inline Real magnitude(Real a)
{
  return select(a < splat<Real>(0.0), -a, a);
}

inline double hyperbolic_tangent(double a)
{
  return std::tanh(a);
}
inline Vec8 hyperbolic_tangent(Vec8 a)
{
  for (int k = 0; k < lanes; k++)
    a[k] = std::tanh(a[k]);    // the library's: the same for each lane
  return a;
}

template <class Half> Twice<Half> hyperbolic_tangent(Twice<Half> a)
{
  return {hyperbolic_tangent(a.low), hyperbolic_tangent(a.high)};
}

/// Fifth root of a number >= 0, to two units in the last place.
inline double fifth_root(double a)
{
  return a > 0.0 ? std::pow(a, 0.2) : 0.0;
}
inline Vec8 fifth_root(Vec8 a)
{
  for (int k = 0; k < lanes; k++) a[k] = fifth_root(a[k]);
  return a;
}

template <class Half> Twice<Half> fifth_root(Twice<Half> a)
{
  return {fifth_root(a.low), fifth_root(a.high)};
}

/// Cube root.
inline double cube_root(double a)
{
  return std::cbrt(a);
}
inline Vec8 cube_root(Vec8 a)
{
  for (int k = 0; k < lanes; k++) a[k] = std::cbrt(a[k]);
  return a;
}

template <class Half> Twice<Half> cube_root(Twice<Half> a)
{
  return {cube_root(a.low), cube_root(a.high)};
}

/// One bit for each lane: set where a < b.
inline unsigned less_bits(Vec4 a, Vec4 b)
{
#if defined(__AVX__)
  return static_cast<unsigned>(_mm256_movemask_pd((__m256d) (a < b)));
#else
  unsigned bits = 0;
  for (int k = 0; k < 4; k++) bits |= (a[k] < b[k] ? 1U : 0U) << k;
  return bits;
#endif
}

#if defined(__AVX512F__)
inline unsigned less_bits(Vec8 a, Vec8 b)
{
  return _mm512_cmp_pd_mask((__m512d) a, (__m512d) b, _CMP_LT_OQ);
}

/// Two records side by side.
inline Vec8 join(Vec4 lower, Vec4 upper)
{
  return __builtin_shufflevector(lower, upper, 0, 1, 2, 3, 4, 5, 6, 7);
}
#endif

/// Stores first + k for every bit k of the lower eight, side by side, and returns their number.
/// Writes eight places in any case: no branch, which processors could not predict.
inline int store_places(std::uint32_t *to, std::uint32_t first, unsigned bits)
{
#if defined(__AVX512VL__)
  const __m256i places = _mm256_add_epi32(_mm256_set1_epi32(static_cast<int>(first)),
                                          _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7));
  // compressed in a register: to compress into memory takes some processors a hundred cycles
  _mm256_storeu_si256(reinterpret_cast<__m256i *>(to),
                      _mm256_maskz_compress_epi32(static_cast<__mmask8>(bits), places));
  return __builtin_popcount(bits & 0xffU);
#else
  int count = 0;
  for (unsigned k = 0; k < 8; k++) {
    to[count] = first + k;
    count += bits >> k & 1U;
  }
  return count;
#endif
}

/// The vector, or zero: no branch, which processors could not predict.
TALUS_INLINE Vec4 kept_if(bool condition, Vec4 vector)
{
  typedef std::int64_t Bits __attribute__((vector_size(32)));
  return (Vec4) ((Bits) vector & (Bits{} - static_cast<std::int64_t>(condition)));
}

/// One of two addresses, without a branch.
template <class T> TALUS_INLINE const T *chosen(bool condition, const T *one, const T *other)
{
  const std::uintptr_t mask = std::uintptr_t{0} - static_cast<std::uintptr_t>(condition);
  const auto address = (reinterpret_cast<std::uintptr_t>(one) & mask) |
                       (reinterpret_cast<std::uintptr_t>(other) & ~mask);
  return reinterpret_cast<const T *>(address);
}

/// One of two, without a branch.
TALUS_INLINE Vec4 chosen(bool condition, Vec4 one, Vec4 other)
{
  typedef std::int64_t Bits __attribute__((vector_size(32)));
  const Bits mask = Bits{} - static_cast<std::int64_t>(condition);
  return (Vec4) (((Bits) one & mask) | ((Bits) other & ~mask));
}

/// Which of eight integers is the wanted one; the first of them, or 8 if none is.
inline int find_of_eight(const std::int32_t *values, std::int32_t wanted)
{
#if defined(__AVX2__)
  const __m256i eight = _mm256_loadu_si256(reinterpret_cast<const __m256i *>(values));
  const __m256i equal = _mm256_cmpeq_epi32(eight, _mm256_set1_epi32(wanted));
  unsigned bits = static_cast<unsigned>(_mm256_movemask_ps(_mm256_castsi256_ps(equal)));
#else
  unsigned bits = 0;
  for (int k = 0; k < 8; k++) bits |= static_cast<unsigned>(values[k] == wanted) << k;
#endif
  bits |= 1U << 8;
  return __builtin_ctz(bits);
}

/// Transposes the 4 x 4 matrix whose rows are a, b, c, d.
inline void transpose(Vec4 &a, Vec4 &b, Vec4 &c, Vec4 &d)
{
  const Vec4 ab_low = __builtin_shufflevector(a, b, 0, 4, 2, 6);
  const Vec4 ab_high = __builtin_shufflevector(a, b, 1, 5, 3, 7);
  const Vec4 cd_low = __builtin_shufflevector(c, d, 0, 4, 2, 6);
  const Vec4 cd_high = __builtin_shufflevector(c, d, 1, 5, 3, 7);
  a = __builtin_shufflevector(ab_low, cd_low, 0, 1, 4, 5);
  b = __builtin_shufflevector(ab_high, cd_high, 0, 1, 4, 5);
  c = __builtin_shufflevector(ab_low, cd_low, 2, 3, 6, 7);
  d = __builtin_shufflevector(ab_high, cd_high, 2, 3, 6, 7);
}

#if defined(__AVX512F__)
/// The same for two matrices side by side: lane k of the results is from row k of the lower halves,
/// lane 4 + k from row k of the upper ones.
inline void transpose(Vec8 &a, Vec8 &b, Vec8 &c, Vec8 &d)
{
  const Vec8 ab_low = __builtin_shufflevector(a, b, 0, 8, 2, 10, 4, 12, 6, 14);
  const Vec8 ab_high = __builtin_shufflevector(a, b, 1, 9, 3, 11, 5, 13, 7, 15);
  const Vec8 cd_low = __builtin_shufflevector(c, d, 0, 8, 2, 10, 4, 12, 6, 14);
  const Vec8 cd_high = __builtin_shufflevector(c, d, 1, 9, 3, 11, 5, 13, 7, 15);
  a = __builtin_shufflevector(ab_low, cd_low, 0, 1, 8, 9, 4, 5, 12, 13);
  b = __builtin_shufflevector(ab_high, cd_high, 0, 1, 8, 9, 4, 5, 12, 13);
  c = __builtin_shufflevector(ab_low, cd_low, 2, 3, 10, 11, 6, 7, 14, 15);
  d = __builtin_shufflevector(ab_high, cd_high, 2, 3, 10, 11, 6, 7, 14, 15);
}
#endif

/// Loads and stores; `address` must be aligned to the size of the vector. Vectors of the machine
/// may overlay arrays of double.
template <class Vector> struct Memory {
  typedef Vector Overlay __attribute__((may_alias));
  TALUS_INLINE static Vector load(const double *a) { return *reinterpret_cast<const Overlay *>(a); }
  TALUS_INLINE static void store(double *a, Vector v) { *reinterpret_cast<Overlay *>(a) = v; }
};

template <class Half> struct Memory<Twice<Half>> {
  static constexpr int width = sizeof(Half) / sizeof(double);
  TALUS_INLINE static Twice<Half> load(const double *a)
  {
    return {Memory<Half>::load(a), Memory<Half>::load(a + width)};
  }
  TALUS_INLINE static void store(double *a, Twice<Half> v)
  {
    Memory<Half>::store(a, v.low);
    Memory<Half>::store(a + width, v.high);
  }
};

inline Vec4 load4(const double *address)
{
  return Memory<Vec4>::load(address);
}

inline Vec8 load8(const double *address)
{
  return Memory<Vec8>::load(address);
}

inline void store(double *address, Vec4 value)
{
  Memory<Vec4>::store(address, value);
}

inline void store(double *address, Vec8 value)
{
  Memory<Vec8>::store(address, value);
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

inline void streams_are_done()
{
#if defined(__AVX__)
  _mm_sfence();
#endif
}

}    // namespace Talus

#endif
