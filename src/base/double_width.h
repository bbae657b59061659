// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Vectors that are wider than the machine's registers. Compilers would take them, but compare them
// number by number, with branches, and pass them through memory.

#ifndef TALUS_BASE_DOUBLE_WIDTH_H
#define TALUS_BASE_DOUBLE_WIDTH_H

#include <type_traits>
#include <utility>

/// For what runs inside the kernels: with hundreds of kernels in one file compilers stop to inline
/// on their own, and passing vectors through memory costs a fifth of the time. Sanitizers add
/// so much code to each operation that compilers do not cope with all of it in one function.
#if defined(__SANITIZE_ADDRESS__)
#define TALUS_INLINE inline
#else
#define TALUS_INLINE [[gnu::always_inline]] inline
#endif

namespace Talus {

/// Two vectors as one of twice the width. Arithmetic and comparisons are those of the halves; a
/// comparison gives a DoubleWidth of their masks.
template <class Half> struct DoubleWidth;

template <class Vector> struct NumberOf {
  using type = std::decay_t<decltype(std::declval<const Vector &>()[0])>;
};
template <class Half> struct NumberOf<DoubleWidth<Half>> {
  using type = typename NumberOf<Half>::type;
};

/// The type of the numbers of a vector, and how many it has.
template <class Vector> using number_of = typename NumberOf<Vector>::type;
template <class Vector>
inline constexpr int width_of = static_cast<int>(sizeof(Vector) / sizeof(number_of<Vector>));

template <class Half> struct DoubleWidth {
  using Number = number_of<Half>;
  Half low, high;

  TALUS_INLINE Number operator[](int k) const { return reinterpret_cast<const Number *>(this)[k]; }
  TALUS_INLINE Number &operator[](int k) { return reinterpret_cast<Number *>(this)[k]; }
};

#define TALUS_TWICE(op)                                                                            \
  template <class Half> TALUS_INLINE auto operator op(DoubleWidth<Half> a, DoubleWidth<Half> b)    \
  {                                                                                                \
    return DoubleWidth<decltype(a.low op b.low)>{a.low op b.low, a.high op b.high};                \
  }                                                                                                \
  template <class Half> TALUS_INLINE auto operator op(DoubleWidth<Half> a, number_of<Half> b)      \
  {                                                                                                \
    return DoubleWidth<decltype(a.low op b)>{a.low op b, a.high op b};                             \
  }                                                                                                \
  template <class Half> TALUS_INLINE auto operator op(number_of<Half> a, DoubleWidth<Half> b)      \
  {                                                                                                \
    return DoubleWidth<decltype(a op b.low)>{a op b.low, a op b.high};                             \
  }
TALUS_TWICE(+)
TALUS_TWICE(-)
TALUS_TWICE(*)
TALUS_TWICE(/)
TALUS_TWICE(<)
TALUS_TWICE(>)
TALUS_TWICE(<=)
TALUS_TWICE(>=)
TALUS_TWICE(==)
TALUS_TWICE(!=)
TALUS_TWICE(&)
TALUS_TWICE(|)
#undef TALUS_TWICE

template <class Half> TALUS_INLINE DoubleWidth<Half> operator-(DoubleWidth<Half> a)
{
  return {-a.low, -a.high};
}
template <class Half> TALUS_INLINE DoubleWidth<Half> operator~(DoubleWidth<Half> a)
{
  return {~a.low, ~a.high};
}

}    // namespace Talus

#endif
