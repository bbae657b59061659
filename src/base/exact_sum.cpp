// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "base/exact_sum.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace Talus {
namespace {

constexpr int digit_bits = 32;
constexpr std::int64_t base = std::int64_t{1} << digit_bits;
constexpr int lowest = -1074;    // exponent of the lowest bit of digit 0

}    // namespace

void ExactSum::clear()
{
  std::fill(digits, digits + size, 0);
  pending = 0;
}

void ExactSum::add(double value)
{
  std::uint64_t bits;
  std::memcpy(&bits, &value, sizeof bits);
  const int biased = static_cast<int>(bits >> 52) & 0x7ff;
  std::uint64_t mantissa = bits & ((std::uint64_t{1} << 52) - 1);
  if (biased == 0x7ff) {
    digits[num_digits]++;
    return;
  }
  if (biased) mantissa |= std::uint64_t{1} << 52;
  if (pending >= max_pending) normalize();
  pending++;

  const int shift = biased ? biased - 1 : 0;    // from the lowest bit
  std::int64_t *digit = digits + shift / digit_bits;
  const int within = shift % digit_bits;
  const std::uint64_t low = mantissa << within;    // the lower 64 of 85 bits
  const std::uint64_t high = within ? mantissa >> (64 - within) : 0;
  const std::int64_t sign = bits >> 63 ? -1 : 1;
  digit[0] += sign * static_cast<std::int64_t>(low & 0xffffffff);
  digit[1] += sign * static_cast<std::int64_t>(low >> digit_bits);
  digit[2] += sign * static_cast<std::int64_t>(high);
}

void ExactSum::add(const ExactSum &other)
{
  ExactSum addend = other;
  addend.normalize();
  normalize();
  for (int k = 0; k < size; k++) digits[k] += addend.digits[k];
  pending = 1;
}

/* Every digit but the highest ends between 0 and 2^32; the highest keeps the sign. */

void ExactSum::normalize()
{
  for (int k = 0; k + 1 < num_digits; k++) {
    const std::int64_t carry = digits[k] >> digit_bits;    // rounds down
    digits[k] -= carry * base;
    digits[k + 1] += carry;
  }
  pending = 0;
}

double ExactSum::value() const
{
  if (digits[num_digits]) return std::numeric_limits<double>::quiet_NaN();
  ExactSum magnitude = *this;
  magnitude.normalize();
  const bool negative = magnitude.digits[num_digits - 1] < 0;
  if (negative) {
    for (int k = 0; k < num_digits; k++) magnitude.digits[k] = -magnitude.digits[k];
    magnitude.normalize();
  }
  double sum = 0.0;
  for (int k = 0; k < num_digits; k++)    // small ones first
    if (magnitude.digits[k])
      sum += std::ldexp(static_cast<double>(magnitude.digits[k]), lowest + digit_bits * k);
  return negative ? -sum : sum;
}

}    // namespace Talus
