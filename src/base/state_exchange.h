// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Copies of values that make up a state, and the one function for both directions: an object lists
// the members that belong to its state once, in a function
//
//   void exchange_state(StateExchange &x) { x(position, velocity, histories); }
//
// which saves them where x was made to save, and sets them where it restores. Both must list the same values in the
// same order. No communication is allowed in such functions, for another rank may run out of memory.

#ifndef TALUS_BASE_STATE_EXCHANGE_H
#define TALUS_BASE_STATE_EXCHANGE_H

#include <algorithm>
#include <any>
#include <cstddef>
#include <type_traits>
#include <utility>
#include <vector>

namespace Talus {

/// What has been saved, in its order.
class SavedState {
 public:
  /// Bytes.
  double memory_usage() const { return bytes; }

 private:
  friend class StateExchange;
  std::vector<std::any> values;
  double bytes = 0.0;
};

class StateExchange {
 public:
  /// Each rank has its own; see state_numbers.h for the other kind.
  static constexpr bool of_each_rank = true;

  /// Saves behind what is there.
  explicit StateExchange(SavedState &to) : saved(&to), from(&to) {}
  /// Restores from the beginning.
  explicit StateExchange(const SavedState &state) : from(&state) {}

  bool restores() const { return !saved; }
  /// Any objects with copies.
  template <class... Values> void operator()(Values &...values) { (exchange(values), ...); }
  /// `count` values from `first` on; as many must be there when they are restored.
  template <class Value> void array(Value *first, std::size_t count)
  {
    if (saved)
      keep(std::vector<Value>(first, first + count));
    else
      std::copy_n(take<std::vector<Value>>().begin(), count, first);
  }

 private:
  template <class Value> void exchange(Value &value)
  {
    if (saved)
      keep(value);
    else
      value = take<Value>();
  }
  template <class Value> void keep(Value value)
  {
    saved->bytes += bytes_of(value, 0);
    saved->values.emplace_back(std::move(value));
  }
  template <class Value> const Value &take()
  {
    return *std::any_cast<Value>(&from->values.at(next++));
  }

  template <class Value>
  static auto bytes_of(const Value &value, int) -> decltype(value.memory_usage())
  {
    return value.memory_usage();
  }
  template <class Value>
  static auto bytes_of(const Value &value, int)
      -> decltype(value.data(), static_cast<double>(value.size()))
  {
    return static_cast<double>(value.size() * sizeof(*value.data()));
  }
  template <class Value> static double bytes_of(const Value & /*value*/, long)
  {
    return sizeof(Value);
  }

  SavedState *saved = nullptr;
  const SavedState *from;
  std::size_t next = 0;
};

}    // namespace Talus

#endif
