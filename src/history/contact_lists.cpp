// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "history/contact_lists.h"

#include "base/aligned_vector.h"

#include <algorithm>
#include <cstring>

namespace Talus {

static_assert(sizeof(std::int64_t) == sizeof(double), "names travel as the bits of a double");

void ContactLists::copy(int from, int to)
{
  first_of[to] = first_of[from];
  last_of[to] = last_of[from];
}

void ContactLists::clear()
{
  if (contacts.empty()) return;
  std::fill(first_of.begin(), first_of.end(), 0);
  std::fill(last_of.begin(), last_of.end(), 0);
  if (static_cast<double>(sizeof(Link) * contacts.capacity() +
                          sizeof(double) * numbers.capacity()) > release_threshold) {
    release(contacts);
    release(numbers);
  }
  contacts.clear();
  numbers.clear();
}

double *ContactLists::add(int particle, std::int64_t partner, std::uint64_t feature, int values)
{
  contacts.push_back({partner, feature, numbers.size(), values, 0});
  const auto number = static_cast<std::uint32_t>(contacts.size());
  (last_of[particle] ? contacts[last_of[particle] - 1].next : first_of[particle]) = number;
  last_of[particle] = number;
  numbers.resize(numbers.size() + values);
  return numbers.data() + numbers.size() - values;
}

void ContactLists::add_copy(int particle, const Contact &one)
{
  std::copy_n(one.value, one.values, add(particle, one.partner, one.feature, one.values));
}

int ContactLists::packed_size(int particle) const
{
  int size = size_head;
  for_each(particle, [&](const Contact &one) { size += size_name + one.values; });
  return size;
}

int ContactLists::largest_packed(int n) const
{
  int most = size_head;
  for (int i = 0; i < n && !contacts.empty(); i++) most = std::max(most, packed_size(i));
  return most;
}

/* ---- messages ---- */

void ContactLists::Writer::add(const Contact &one)
{
  *begin += 1.0;
  std::memcpy(end, &one.partner, sizeof one.partner);
  std::memcpy(end + 1, &one.feature, sizeof one.feature);
  end[2] = one.values;
  end = std::copy_n(one.value, one.values, end + size_name);
}

ContactLists::Contact ContactLists::read(const double *from)
{
  Contact one{};
  std::memcpy(&one.partner, from, sizeof one.partner);
  std::memcpy(&one.feature, from + 1, sizeof one.feature);
  one.values = static_cast<int>(from[2]);
  one.value = from + size_name;
  return one;
}

double ContactLists::memory_usage() const
{
  return static_cast<double>(sizeof(std::uint32_t) * (first_of.capacity() + last_of.capacity()) +
                             sizeof(Link) * contacts.capacity() +
                             sizeof(double) * numbers.capacity());
}

}    // namespace Talus
