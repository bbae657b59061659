// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "history/contact_history.h"

#include <algorithm>

namespace Talus {

/* Whether the store knows a pair is unpredictable: so a record is written in any case, and
   overwritten by the next one if it does not count. */

void ContactHistory::fetch(const PairList &pairs, const HistoryStore &store)
{
  const std::int64_t n = store.empty() ? 0 : pairs.num_pairs();
  rows.keep(store.num_records());
  renew(places, pairs.num_pairs());
  touching.assign((pairs.num_pairs() + 7) / 8, 0);
  vacant.clear();
  // addresses for all, that nothing has to move later; only what is written takes memory
  rows.renew(pairs.num_pairs());
  std::uint32_t found = 0;
  for (std::int64_t block = 0; block < n; block += 8) {
    unsigned bits = 0;
    for (std::int64_t c = block; c < std::min(block + 8, n); c++) {
      const FoundHistory stored = store.find(pairs.first[c], pairs.second[c]);
      const Record &first = stored.rows->record(stored.row);
      rows.record(found) = stored.by_a ? first : mirrored(first);
      for (int k = 1; k < rows.records(); k++)
        rows.record(found, k) =
            k < stored.rows->records() ? stored.rows->record(stored.row, k) : Record{};
      places[c] = found;
      found += stored.known;
      bits |= static_cast<unsigned>(stored.known) << (c - block);
    }
    touching[block / 8] = static_cast<std::uint8_t>(bits);
  }
  rows.resize(found);
}

void ContactHistory::put_aside(const PairList &pairs, SlotContacts &to, bool as_copy)
{
  const std::int64_t n = pairs.num_pairs();
  const ParticleOrder &order = pairs.order();
  const bool with_ghosts = order.owned < order.size();
  const auto is_ghost = [&](int slot) { return !order.is_owned(order.atom_of_slot[slot]); };
  to.first_row = n ? pairs.second[0] : 0;
  to.rows.assign(n ? pairs.second[n - 1] - to.first_row + 2 : 1, 0);
  renew(to.first, rows.size() + SlotContacts::ahead);
  renew(to.place, rows.size() + SlotContacts::ahead);
  to.with_ghost.clear();
  std::uint32_t count = 0;
  for (std::size_t block = 0; block < touching.size(); block++) {
    std::uint32_t found[8];
    const int num_found =
        store_places(found, static_cast<std::uint32_t>(8 * block), touching[block]);
    for (int k = 0; k < num_found; k++) {
      const int first = pairs.first[found[k]], second = pairs.second[found[k]];
      const std::uint32_t place = places[found[k]];
      to.first[count] = first;
      to.place[count] = place;
      to.rows[second - to.first_row + 1] = ++count;
      if (with_ghosts && (is_ghost(first) || is_ghost(second)))
        to.with_ghost.push_back({first, second, place});
    }
  }
  // rows without a pair end where they begin
  for (std::size_t row = 1; row < to.rows.size(); row++)
    to.rows[row] = std::max(to.rows[row], to.rows[row - 1]);
  std::fill(to.first.begin() + count, to.first.end(), -1);
  std::fill(to.place.begin() + count, to.place.end(), 0);
  if (as_copy) {
    to.histories = rows;
    return;
  }
  to.histories.swap(rows);
  std::fill(touching.begin(), touching.end(), 0);
}

void ContactHistory::begin(std::int64_t pair)
{
  if (vacant.empty()) {
    places[pair] = static_cast<std::uint32_t>(rows.size());
    rows.add();
    return;
  }
  places[pair] = vacant.back();
  vacant.pop_back();
  rows.set_zero(places[pair]);
}

void ContactHistory::change(std::int64_t block, unsigned bits)
{
  for (unsigned rest = touching[block] & ~bits; rest; rest &= rest - 1)
    vacant.push_back(places[8 * block + __builtin_ctz(rest)]);
  for (unsigned rest = bits & ~touching[block]; rest; rest &= rest - 1)
    begin(8 * block + __builtin_ctz(rest));
  touching[block] = static_cast<std::uint8_t>(bits);
}

void ContactHistory::release()
{
  *this = ContactHistory{};
}

double ContactHistory::memory_usage() const
{
  return static_cast<double>((places.capacity() + vacant.capacity()) * sizeof(std::uint32_t) +
                             touching.capacity()) +
         rows.memory_usage();
}

}    // namespace Talus
