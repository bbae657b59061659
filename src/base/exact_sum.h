// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// A sum of doubles without rounding: the same bits in any order, over any number of ranks and
// threads. For forces that feed back into the motion.

#ifndef TALUS_BASE_EXACT_SUM_H
#define TALUS_BASE_EXACT_SUM_H

#include <cstdint>

namespace Talus {

/// A fixed-point number that covers the whole range of doubles, as digits of 32 bits held in 64, so
/// that additions need no carry for a long time (Kulisch's long accumulator). Plain data: the
/// digits of several ranks may be added one by one (MPI_SUM of int64) after normalize(), for up to
/// 2^30 ranks.
class ExactSum {
 public:
  /// 2^-1074 ... 2^1024, and room for the sum of 2^60 of the largest.
  static constexpr int num_digits = 68;

  void clear();
  void add(double value);
  void add(const ExactSum &other);

  /// So many additions are made without a carry: digits stay below 2^53.
  static constexpr int max_pending = 1 << 20;

  /// Carries; at least once before digits are added elsewhere.
  void normalize();

  /// The sum, rounded once, towards nearest but for ties and doubly rounded rests: a function of
  /// the exact sum alone. NaN if anything added was not finite.
  double value() const;

  /// The digits and, last, the count of numbers that were not finite.
  static constexpr int size = num_digits + 1;
  std::int64_t *data() { return digits; }
  const std::int64_t *data() const { return digits; }

 private:
  std::int64_t digits[size] = {};
  int pending = 0;    // additions since the last carry
};

}    // namespace Talus

#endif
