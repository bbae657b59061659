// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "history/contact_lists.h"

#include <algorithm>
#include <cstring>

namespace Talus {

static_assert(sizeof(std::int64_t) == sizeof(double), "names travel as the bits of a double");

void ContactLists::keep(int values)
{
  if (values == num_values) return;
  std::vector<double> moved(contacts.size() * values, 0.0);
  for (std::size_t n = 0; n < contacts.size(); n++)
    std::copy_n(&numbers[n * num_values], std::min(values, num_values), &moved[n * values]);
  numbers.swap(moved);
  num_values = values;
}

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
  contacts.clear();
  numbers.clear();
}

double *ContactLists::add(int particle, std::int64_t partner, std::uint64_t feature)
{
  contacts.push_back({partner, feature, 0});
  const auto number = static_cast<std::uint32_t>(contacts.size());
  if (last_of[particle])
    contacts[last_of[particle] - 1].next = number;
  else
    first_of[particle] = number;
  last_of[particle] = number;
  numbers.resize(contacts.size() * num_values);
  return numbers.data() + (number - 1) * static_cast<std::size_t>(num_values);
}

int ContactLists::count(int particle) const
{
  int count = 0;
  for (std::uint32_t n = first_of[particle]; n; n = contacts[n - 1].next) count++;
  return count;
}

int ContactLists::largest_packed(int n) const
{
  int most = 0;
  for (int i = 0; i < n && !contacts.empty(); i++) most = std::max(most, count(i));
  return size_of_list(most);
}

void ContactLists::write_name(std::int64_t partner, std::uint64_t feature, double *to)
{
  std::memcpy(to, &partner, sizeof partner);
  std::memcpy(to + 1, &feature, sizeof feature);
}

int ContactLists::pack(int particle, double *to) const
{
  int count = 0;
  double *next = to + size_head;
  for_each(particle, [&](const Contact &contact) {
    write_name(contact.partner, contact.feature, next);
    next = std::copy_n(contact.value, num_values, next + size_name);
    count++;
  });
  to[0] = count;
  to[1] = num_values;
  return static_cast<int>(next - to);
}

int ContactLists::unpack(int particle, const double *from)
{
  forget(particle);
  const int count = static_cast<int>(from[0]), each = static_cast<int>(from[1]);
  const double *next = from + size_head;
  for (int n = 0; n < count; n++, next += size_name + each) {
    std::int64_t partner;
    std::uint64_t feature;
    std::memcpy(&partner, next, sizeof partner);
    std::memcpy(&feature, next + 1, sizeof feature);
    double *const to = add(particle, partner, feature);
    std::copy_n(next + size_name, std::min(each, num_values), to);
  }
  return static_cast<int>(next - from);
}

double ContactLists::memory_usage() const
{
  return static_cast<double>(sizeof(std::uint32_t) * (first_of.capacity() + last_of.capacity()) +
                             sizeof(Link) * contacts.capacity() +
                             sizeof(double) * numbers.capacity());
}

}    // namespace Talus
