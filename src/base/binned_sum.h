// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Sums of doubles that have the same bits in any order, over any number of ranks and threads, in a tenth
// of the memory of an ExactSum and less time: for many sums, of which each is rounded once.
//
// Numbers are cut at fixed places into digits of 32 bits, and sums keep those of the highest number
// and four below it; digits are summed without carries. Which are kept depends on the highest number alone,
// so that what is lost, below 2^-95 of it for each addition, does not depend on the order either (Demmel
// and Nguyen 2013, Fast reproducible floating-point summation, ARITH 21).

#ifndef TALUS_BASE_BINNED_SUM_H
#define TALUS_BASE_BINNED_SUM_H

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

namespace Talus {

/// So many sums, for which the highest number is that of all of them.
template <int count> class BinnedSums {
 public:
  void clear() { *this = BinnedSums{}; }

  /// Up to 2^30 times.
  void add(int sum, double value)
  {
    std::uint64_t bits;
    std::memcpy(&bits, &value, sizeof bits);
    const int biased = static_cast<int>(bits >> 52) & 0x7ff;
    std::uint64_t mantissa = bits & ((std::uint64_t{1} << 52) - 1);
    if (biased) mantissa |= std::uint64_t{1} << 52;
    if (!mantissa) return;
    const int shift = biased ? biased - 1 : 0;    // from the lowest bit of all doubles
    const int first = biased == 0x7ff ? not_finite : shift / digit_bits;
    const int within = shift % digit_bits;
    const std::uint64_t low = mantissa << within, high = within ? mantissa >> (64 - within) : 0;
    if (first + 2 > highest) keep_from(first + 2);
    const std::int64_t sign = bits >> 63 ? -1 : 1;
    const int place = highest - first;    // of the lowest digit: 2 or more
    std::int64_t *const to = digit[sum];
    if (place - 2 < num_digits) to[place - 2] += sign * static_cast<std::int64_t>(high);
    if (place - 1 < num_digits)
      to[place - 1] += sign * static_cast<std::int64_t>(low >> digit_bits);
    if (place < num_digits) to[place] += sign * static_cast<std::int64_t>(low & 0xffffffff);
  }
  void add(const BinnedSums &other)
  {
    if (other.highest > highest) keep_from(other.highest);
    const int down = highest - other.highest;
    for (int n = 0; n < count; n++)
      for (int k = 0; k + down < num_digits; k++) digit[n][k + down] += other.digit[n][k];
  }

  /// NaN if anything added was not finite.
  double value(int sum) const
  {
    if (highest >= not_finite) return std::numeric_limits<double>::quiet_NaN();
    constexpr double one_digit = 1.0 / 4294967296.0;
    double total = 0.0;
    for (int k = num_digits - 1; k >= 0; k--)    // small ones first
      total = static_cast<double>(digit[sum][k]) + one_digit * total;
    return std::ldexp(total, lowest_bit + digit_bits * highest);
  }

 private:
  static constexpr int num_digits = 5;

 public:
  /// As whole numbers, for messages and files.
  static constexpr int size = 1 + count * num_digits;
  void to_array(std::int64_t *a) const
  {
    *a++ = highest;
    std::memcpy(a, digit, sizeof digit);
  }
  static BinnedSums from_array(const std::int64_t *a)
  {
    BinnedSums sums;
    sums.highest = static_cast<int>(*a++);
    std::memcpy(sums.digit, a, sizeof sums.digit);
    return sums;
  }

 private:
  static constexpr int digit_bits = 32, lowest_bit = -1074, not_finite = 1000;

  void keep_from(int new_highest)
  {
    const int up = new_highest - highest;
    for (auto &of_sum : digit)
      for (int k = num_digits - 1; k >= 0; k--) of_sum[k] = k >= up ? of_sum[k - up] : 0;
    highest = new_highest;
  }

  int highest = 0;    // place of the first digit, from that of the lowest bit of all doubles
  std::int64_t digit[count][num_digits] = {};
};

}    // namespace Talus

#endif
