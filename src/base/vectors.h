// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Vectors of any width on any processor, written with the vector extension that GCC and Clang
// share: one register where the machine has registers of that size, else two vectors of half the
// width (base/double_width.h). What the extension lacks, or what not every compiler has of it, is here in
// intrinsics of AVX-512, AVX, SSE2 and NEON; a processor with none of them gets plain loops.
//
// Everything here rounds as IEEE 754 prescribes: results do not depend on the width of registers.

#ifndef TALUS_BASE_VECTORS_H
#define TALUS_BASE_VECTORS_H

#include "base/double_width.h"
#include "base/intrinsics.h"

#include <cmath>
#include <cstdint>

namespace Talus {

#if defined(__AVX512F__)
inline constexpr int register_size = 64;
#elif defined(__AVX__)
inline constexpr int register_size = 32;
#else
inline constexpr int register_size = 16;
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
#elif defined(__SSE2__)
  return "SSE2";
#elif defined(__aarch64__)
  return "NEON";
#else
  return "no vector instructions";
#endif
}

template <class Number, int width, bool fits> struct VectorType {
  typedef Number type __attribute__((vector_size(width * sizeof(Number))));
};
template <class Number, int width> struct VectorType<Number, width, false> {
  using type = DoubleWidth<
      typename VectorType<Number, width / 2, width / 2 * sizeof(Number) <= register_size>::type>;
};
/// `width` numbers; width is a power of 2 and the vector has 16 bytes at least.
template <class Number, int width>
using VectorOf = typename VectorType<Number, width, width * sizeof(Number) <= register_size>::type;

using Vec2 = VectorOf<double, 2>;
using Vec4 = VectorOf<double, 4>;
using Vec8 = VectorOf<double, 8>;
using Float4 = VectorOf<float, 4>;
using Float8 = VectorOf<float, 8>;

/// What a comparison of vectors, or of numbers, yields: all bits of a place are set where it holds.
template <class Vector> using bool_of = decltype(Vector{} < Vector{});

/* Selecting and moving numbers. */

template <class Mask, class Vector> TALUS_INLINE Vector select(Mask mask, Vector yes, Vector no)
{
  return mask ? yes : no;
}
template <class Mask, class Half>
TALUS_INLINE DoubleWidth<Half> select(DoubleWidth<Mask> mask, DoubleWidth<Half> yes,
                                      DoubleWidth<Half> no)
{
  return {select(mask.low, yes.low, no.low), select(mask.high, yes.high, no.high)};
}

template <class Vector> TALUS_INLINE Vector larger(Vector a, Vector b)
{
  return select(a > b, a, b);
}

/// Number k of a vector, or of two that follow each other.
template <int k, class Half> TALUS_INLINE number_of<Half> number_at(const DoubleWidth<Half> &v)
{
  if constexpr (k < width_of<Half>)
    return v.low[k];
  else
    return v.high[k - width_of<Half>];
}
template <int k, class Half>
TALUS_INLINE number_of<Half> number_at(const DoubleWidth<Half> &a, const DoubleWidth<Half> &b)
{
  constexpr int width = width_of<DoubleWidth<Half>>;
  if constexpr (k < width)
    return number_at<k>(a);
  else
    return number_at<k - width>(b);
}

/// The numbers at the places `from` of a and b, which are counted through: those of b begin at the
/// width of a.
template <int... from, class Vector> TALUS_INLINE Vector shuffle(Vector a, Vector b)
{
  static_assert(sizeof...(from) == width_of<Vector>);
#if defined(__clang__) || __GNUC__ >= 12
  return __builtin_shufflevector(a, b, from...);
#else
  return __builtin_shuffle(a, b, bool_of<Vector>{from...});
#endif
}
template <int f0, int f1, int f2, int f3, class Half>
TALUS_INLINE DoubleWidth<Half> shuffle(DoubleWidth<Half> a, DoubleWidth<Half> b)
{
  static_assert(width_of<Half> == 2);
  return {Half{number_at<f0>(a, b), number_at<f1>(a, b)},
          Half{number_at<f2>(a, b), number_at<f3>(a, b)}};
}

/// Two vectors side by side, and the halves of one.
template <class Half> TALUS_INLINE DoubleWidth<Half> join(Half low, Half high)
{
  return {low, high};
}
template <class Half> TALUS_INLINE Half low_half(DoubleWidth<Half> v)
{
  return v.low;
}
template <class Half> TALUS_INLINE Half high_half(DoubleWidth<Half> v)
{
  return v.high;
}
#if defined(__AVX__)
TALUS_INLINE Float8 join(Float4 low, Float4 high)
{
  return (Float8) _mm256_insertf128_ps(_mm256_castps128_ps256((__m128) low), (__m128) high, 1);
}
TALUS_INLINE Float4 low_half(Float8 v)
{
  return (Float4) _mm256_castps256_ps128((__m256) v);
}
TALUS_INLINE Float4 high_half(Float8 v)
{
  return (Float4) _mm256_extractf128_ps((__m256) v, 1);
}
#endif
#if defined(__AVX512F__)
TALUS_INLINE Vec8 join(Vec4 low, Vec4 high)
{
  return (Vec8) _mm512_maskz_insertf64x4(0xff, _mm512_castpd256_pd512((__m256d) low),
                                         (__m256d) high, 1);
}
TALUS_INLINE Vec4 low_half(Vec8 v)
{
  // a cast is an extraction too, with a warning of a number that is not used
  return (Vec4) _mm512_maskz_extractf64x4_pd(0xff, (__m512d) v, 0);
}
TALUS_INLINE Vec4 high_half(Vec8 v)
{
  return (Vec4) _mm512_maskz_extractf64x4_pd(0xf, (__m512d) v, 1);
}
#endif

/// Four numbers, for example as a constant.
TALUS_INLINE Vec4 four(double a, double b, double c, double d)
{
#if defined(__AVX__)
  return Vec4{a, b, c, d};
#else
  return {Vec2{a, b}, Vec2{c, d}};
#endif
}

/// 0, 1, 2 and so on.
template <class Vector, int... k>
TALUS_INLINE Vector counting_from(number_of<Vector> first, std::integer_sequence<int, k...>)
{
  return Vector{static_cast<number_of<Vector>>(first + k)...};
}
template <class Vector> TALUS_INLINE Vector counting(number_of<Vector> first = 0)
{
  if constexpr (sizeof(Vector) > register_size) {
    using Half = decltype(Vector::low);
    return {counting<Half>(first), counting<Half>(first + width_of<Half>)};
  } else
    return counting_from<Vector>(first, std::make_integer_sequence<int, width_of<Vector>>{});
}

TALUS_INLINE Float4 to_floats(Vec4 v)
{
#if defined(__AVX__)
  return (Float4) _mm256_cvtpd_ps((__m256d) v);
#elif defined(__SSE2__)
  return (Float4) _mm_movelh_ps(_mm_cvtpd_ps((__m128d) v.low), _mm_cvtpd_ps((__m128d) v.high));
#elif defined(__aarch64__)
  return (Float4) vcvt_high_f32_f64(vcvt_f32_f64((float64x2_t) v.low), (float64x2_t) v.high);
#else
  return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2]),
          static_cast<float>(v[3])};
#endif
}

TALUS_INLINE Vec4 to_doubles(Float4 v)
{
#if defined(__AVX__)
  return (Vec4) _mm256_cvtps_pd((__m128) v);
#elif defined(__SSE2__)
  return {(Vec2) _mm_cvtps_pd((__m128) v),
          (Vec2) _mm_cvtps_pd(_mm_movehl_ps((__m128) v, (__m128) v))};
#elif defined(__aarch64__)
  return {(Vec2) vcvt_f64_f32(vget_low_f32((float32x4_t) v)),
          (Vec2) vcvt_high_f64_f32((float32x4_t) v)};
#else
  return four(v[0], v[1], v[2], v[3]);
#endif
}

/* Transposes the 4 x 4 matrix whose rows are a, b, c, d; of vectors of eight numbers, the two
   matrices that stand side by side. */

TALUS_INLINE void transpose(Float4 &a, Float4 &b, Float4 &c, Float4 &d)
{
  const Float4 ab_low = shuffle<0, 4, 1, 5>(a, b), ab_high = shuffle<2, 6, 3, 7>(a, b);
  const Float4 cd_low = shuffle<0, 4, 1, 5>(c, d), cd_high = shuffle<2, 6, 3, 7>(c, d);
  a = shuffle<0, 1, 4, 5>(ab_low, cd_low);
  b = shuffle<2, 3, 6, 7>(ab_low, cd_low);
  c = shuffle<0, 1, 4, 5>(ab_high, cd_high);
  d = shuffle<2, 3, 6, 7>(ab_high, cd_high);
}

#if defined(__AVX__)
TALUS_INLINE void transpose(Vec4 &a, Vec4 &b, Vec4 &c, Vec4 &d)
{
  const Vec4 ab_low = shuffle<0, 4, 2, 6>(a, b), ab_high = shuffle<1, 5, 3, 7>(a, b);
  const Vec4 cd_low = shuffle<0, 4, 2, 6>(c, d), cd_high = shuffle<1, 5, 3, 7>(c, d);
  a = shuffle<0, 1, 4, 5>(ab_low, cd_low);
  b = shuffle<0, 1, 4, 5>(ab_high, cd_high);
  c = shuffle<2, 3, 6, 7>(ab_low, cd_low);
  d = shuffle<2, 3, 6, 7>(ab_high, cd_high);
}
TALUS_INLINE void transpose(Float8 &a, Float8 &b, Float8 &c, Float8 &d)
{
  const Float8 ab_low = shuffle<0, 8, 1, 9, 4, 12, 5, 13>(a, b);
  const Float8 ab_high = shuffle<2, 10, 3, 11, 6, 14, 7, 15>(a, b);
  const Float8 cd_low = shuffle<0, 8, 1, 9, 4, 12, 5, 13>(c, d);
  const Float8 cd_high = shuffle<2, 10, 3, 11, 6, 14, 7, 15>(c, d);
  a = shuffle<0, 1, 8, 9, 4, 5, 12, 13>(ab_low, cd_low);
  b = shuffle<2, 3, 10, 11, 6, 7, 14, 15>(ab_low, cd_low);
  c = shuffle<0, 1, 8, 9, 4, 5, 12, 13>(ab_high, cd_high);
  d = shuffle<2, 3, 10, 11, 6, 7, 14, 15>(ab_high, cd_high);
}
#else
TALUS_INLINE void transpose(Vec4 &a, Vec4 &b, Vec4 &c, Vec4 &d)
{
  const Vec4 rows[4] = {a, b, c, d};
  a = {shuffle<0, 2>(rows[0].low, rows[1].low), shuffle<0, 2>(rows[2].low, rows[3].low)};
  b = {shuffle<1, 3>(rows[0].low, rows[1].low), shuffle<1, 3>(rows[2].low, rows[3].low)};
  c = {shuffle<0, 2>(rows[0].high, rows[1].high), shuffle<0, 2>(rows[2].high, rows[3].high)};
  d = {shuffle<1, 3>(rows[0].high, rows[1].high), shuffle<1, 3>(rows[2].high, rows[3].high)};
}
#endif
#if defined(__AVX512F__)
TALUS_INLINE void transpose(Vec8 &a, Vec8 &b, Vec8 &c, Vec8 &d)
{
  const Vec8 ab_low = shuffle<0, 8, 2, 10, 4, 12, 6, 14>(a, b);
  const Vec8 ab_high = shuffle<1, 9, 3, 11, 5, 13, 7, 15>(a, b);
  const Vec8 cd_low = shuffle<0, 8, 2, 10, 4, 12, 6, 14>(c, d);
  const Vec8 cd_high = shuffle<1, 9, 3, 11, 5, 13, 7, 15>(c, d);
  a = shuffle<0, 1, 8, 9, 4, 5, 12, 13>(ab_low, cd_low);
  b = shuffle<0, 1, 8, 9, 4, 5, 12, 13>(ab_high, cd_high);
  c = shuffle<2, 3, 10, 11, 6, 7, 14, 15>(ab_low, cd_low);
  d = shuffle<2, 3, 10, 11, 6, 7, 14, 15>(ab_high, cd_high);
}
#endif
/// Two matrices in vectors of two registers: not for Vec4 without AVX, which is one matrix.
template <class Half>
TALUS_INLINE std::enable_if_t<width_of<Half> == 4>
transpose(DoubleWidth<Half> &a, DoubleWidth<Half> &b, DoubleWidth<Half> &c, DoubleWidth<Half> &d)
{
  transpose(a.low, b.low, c.low, d.low);
  transpose(a.high, b.high, c.high, d.high);
}

/* Square roots. */

TALUS_INLINE double square_root(double a)
{
  return std::sqrt(a);
}
#if defined(__AVX512F__)
TALUS_INLINE Vec8 square_root(Vec8 a)
{
  return (Vec8) _mm512_maskz_sqrt_pd(0xff, (__m512d) a);
}
#elif defined(__AVX__)
TALUS_INLINE Vec4 square_root(Vec4 a)
{
  return (Vec4) _mm256_sqrt_pd((__m256d) a);
}
#else
TALUS_INLINE Vec2 square_root(Vec2 a)
{
#if defined(__SSE2__)
  return (Vec2) _mm_sqrt_pd((__m128d) a);
#elif defined(__aarch64__)
  return (Vec2) vsqrtq_f64((float64x2_t) a);
#else
  return Vec2{std::sqrt(a[0]), std::sqrt(a[1])};
#endif
}
#endif
template <class Half> TALUS_INLINE DoubleWidth<Half> square_root(DoubleWidth<Half> a)
{
  return {square_root(a.low), square_root(a.high)};
}

/* Masks as bits: bit k is set where comparison k holds. */

template <class Mask> TALUS_INLINE unsigned bits_of(Mask mask)
{
#if defined(__AVX__)
  if constexpr (sizeof(Mask) == 32 && width_of<Mask> == 4)
    return static_cast<unsigned>(_mm256_movemask_pd((__m256d) mask));
  else if constexpr (sizeof(Mask) == 32 && width_of<Mask> == 8)
    return static_cast<unsigned>(_mm256_movemask_ps((__m256) mask));
#endif
#if defined(__AVX512F__)
  if constexpr (sizeof(Mask) == 64 && width_of<Mask> == 8)
    return _mm512_cmplt_epi64_mask((__m512i) mask, _mm512_setzero_si512());
  else if constexpr (sizeof(Mask) == 64 && width_of<Mask> == 16)
    return _mm512_cmplt_epi32_mask((__m512i) mask, _mm512_setzero_si512());
#endif
  if constexpr (width_of<Mask> == 2) {
#if defined(__SSE2__)
    return static_cast<unsigned>(_mm_movemask_pd((__m128d) mask));
#else
    return static_cast<unsigned>((mask[0] & 1) | (mask[1] & 2));
#endif
  } else if constexpr (sizeof(Mask) == 16 && width_of<Mask> == 4) {
#if defined(__SSE2__)
    return static_cast<unsigned>(_mm_movemask_ps((__m128) mask));
#elif defined(__aarch64__)
    const uint32x4_t bits{1, 2, 4, 8};
    return vaddvq_u32(vandq_u32((uint32x4_t) mask, bits));
#else
    return static_cast<unsigned>((mask[0] & 1) | (mask[1] & 2) | (mask[2] & 4) | (mask[3] & 8));
#endif
  }
}
template <class Half> TALUS_INLINE unsigned bits_of(DoubleWidth<Half> mask)
{
  return bits_of(mask.low) | bits_of(mask.high) << width_of<Half>;
}

#if defined(__aarch64__)
TALUS_INLINE unsigned bits_of(DoubleWidth<bool_of<Vec2>> mask)
{
  return bits_of((bool_of<Float4>) vuzp1q_u32((uint32x4_t) mask.low, (uint32x4_t) mask.high));
}
#endif

/// One bit for each number: set where a < b.
template <class Vector> TALUS_INLINE unsigned less_bits(Vector a, Vector b)
{
#if defined(__AVX512F__)
  if constexpr (std::is_same_v<Vector, Vec8>)
    return _mm512_cmp_pd_mask((__m512d) a, (__m512d) b, _CMP_LT_OQ);
  else
#endif
    return bits_of(a < b);
}

/// Whether a comparison holds anywhere.
TALUS_INLINE bool any(bool mask)
{
  return mask;
}
#if defined(__AVX512F__)
TALUS_INLINE bool any(bool_of<Vec8> mask)
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
#if defined(__SSE2__)
  return _mm_movemask_pd((__m128d) mask) != 0;
#else
  return (mask[0] | mask[1]) != 0;
#endif
}
#endif
template <class Half> TALUS_INLINE bool any(DoubleWidth<Half> mask)
{
  return any(mask.low | mask.high);
}

}    // namespace Talus

#endif
