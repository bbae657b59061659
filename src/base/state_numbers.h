// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// State as numbers, for restart files: a visitor of the same functions exchange_state() that serve copies in memory
// (state_exchange.h), of what is made of numbers, vectors, orientations, lists of those and objects with such a function
// of their own. Restart files hold what all ranks have together, so what belongs to one rank alone is left out there:
//
//   template <class Exchange> void exchange_state(Exchange &x)
//   {
//     if constexpr (Exchange::of_each_rank) x(sums_of_this_rank);
//     x(sums_of_all, steps);
//   }

#ifndef TALUS_BASE_STATE_NUMBERS_H
#define TALUS_BASE_STATE_NUMBERS_H

#include "base/linear_algebra.h"

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>
#include <vector>

namespace Talus {

class StateNumbers {
 public:
  static constexpr bool of_each_rank = false;

  /// Writes behind what is there.
  explicit StateNumbers(std::vector<double> &numbers) : to(&numbers) {}
  /// Reads from the beginning.
  StateNumbers(const double *begin, const double *end) : at(begin), end(end) {}

  bool restores() const { return !to; }
  /// What has been read was there, and was all.
  bool fits() const { return !beyond && at == end; }

  template <class... Values> void operator()(Values &...values) { (exchange(values), ...); }

 private:
  void number(double &value)
  {
    if (to)
      to->push_back(value);
    else if (at != end)
      value = *at++;
    else
      beyond = true;
  }
  /// With all bits, which a double would round.
  void integer(std::int64_t &value)
  {
    double bits = 0.0;
    std::memcpy(&bits, &value, sizeof bits);
    number(bits);
    std::memcpy(&value, &bits, sizeof bits);
  }
  template <class Value> void exchange(Value &value)
  {
    if constexpr (std::is_same_v<Value, double>) {
      number(value);
    } else if constexpr (std::is_integral_v<Value> || std::is_enum_v<Value>) {
      auto bits = static_cast<std::int64_t>(value);
      integer(bits);
      value = static_cast<Value>(bits);
    } else {
      value.exchange_state(*this);
    }
  }
  void exchange(Vector3<double> &v) { (*this)(v.x, v.y, v.z); }
  void exchange(Eigen::Quaterniond &q) { (*this)(q.w(), q.x(), q.y(), q.z()); }
  template <class Value> void exchange(std::vector<Value> &values)
  {
    auto size = static_cast<std::int64_t>(values.size());
    integer(size);
    if (!to) {
      beyond = beyond || size < 0 || size > end - at;    // each has one number at least
      values.resize(beyond ? 0 : static_cast<std::size_t>(size));
    }
    for (Value &value : values) exchange(value);
  }

  std::vector<double> *to = nullptr;
  const double *at = nullptr, *end = nullptr;
  bool beyond = false;
};

}    // namespace Talus

#endif
