// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "history/named_contacts.h"

#include <algorithm>

namespace Talus {

void NamedContacts::clear()
{
  if (empty()) return;
  keys.clear();
  histories.clear();
  std::fill(cells.begin(), cells.end(), 0);
}

void NamedContacts::reserve(std::size_t contacts)
{
  keys.reserve(contacts);
  histories.reserve(contacts);
  if (2 * contacts > cells.size()) grow(contacts);
}

/* The cell that holds a key, or the free one where it belongs. At most half of all are taken, so
   there is one. */

std::size_t NamedContacts::cell_of(const Key &key) const
{
  // names are often consecutive numbers: all their bits have to reach the low ones
  std::uint64_t mixed = static_cast<std::uint64_t>(key.low) * 0x9e3779b97f4a7c15U;
  mixed = (mixed ^ (mixed >> 32)) + static_cast<std::uint64_t>(key.high);
  mixed *= 0xd6e8feb86659fd93U;
  mixed ^= mixed >> 32;
  std::size_t cell = mixed & (cells.size() - 1);
  while (cells[cell] && !(keys[cells[cell] - 1] == key)) cell = (cell + 1) & (cells.size() - 1);
  return cell;
}

void NamedContacts::grow(std::size_t contacts)
{
  std::size_t size = 64;
  while (size < 2 * contacts) size *= 2;
  cells.assign(size, 0);
  for (std::size_t n = 0; n < keys.size(); n++)
    cells[cell_of(keys[n])] = static_cast<std::uint32_t>(n + 1);
}

void NamedContacts::insert(std::int64_t a, std::int64_t b, const HistoryValues &history)
{
  if (2 * (size() + 1) > cells.size()) grow(2 * (size() + 1));
  const Key key = key_of(a, b);
  std::uint32_t &cell = cells[cell_of(key)];
  if (!cell) {
    keys.push_back(key);
    histories.add();
    cell = static_cast<std::uint32_t>(size());
  }
  histories.set_values(cell - 1, a < b ? history : mirrored(history));
}

FoundHistory NamedContacts::find(std::int64_t a, std::int64_t b) const
{
  if (empty()) return {};
  const std::uint32_t n = cells[cell_of(key_of(a, b))];
  if (!n) return {};
  return {true, a < b, &histories, n - 1};
}

double NamedContacts::memory_usage() const
{
  return static_cast<double>(sizeof(Key) * keys.capacity() +
                             sizeof(std::uint32_t) * cells.capacity()) +
         histories.memory_usage();
}

}    // namespace Talus
