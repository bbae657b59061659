// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "history/contact_history.h"

#include <algorithm>
#include <cstring>

namespace Talus {

namespace {

constexpr Record nothing{};

/// What was filed of one pair: its history as one of its particles sees it. If nothing was, there
/// are some numbers to read all the same.
struct Filed {
  bool known = false, by_first = true;
  const double *history = nothing.c, *impact = nothing.c;
};

/// In the list of the first particle, or if that is a ghost of the second.
Filed in_lists(const FiledHistories &filed, const ParticleOrder &order, int first, int second)
{
  const int a = order.atom_of_slot[first], b = order.atom_of_slot[second];
  const bool of_first = order.is_owned(a);
  const int owner = of_first ? a : b, partner = of_first ? b : a;
  const double *values =
      filed.name[partner] ? filed.partners.find(owner, filed.name[partner]) : nullptr;
  if (!values) return {};
  return {true, of_first, values, filed.partners.num_values() == 8 ? values + 4 : nothing.c};
}

/* Lists are of those that came from elsewhere: they tell of pairs that were nobody's here. */

Filed in_kept(const FiledHistories &filed, const std::vector<int> &slots_then,
              const ParticleOrder &order, int first, int second)
{
  const int a = slots_then[first], b = slots_then[second];
  if (a < 0 && b < 0) return in_lists(filed, order, first, second);
  const KeptContacts::Found found = filed.kept.find(a, b);
  return {found.known, found.by_a, found.record->c, found.impact->c};
}

}    // namespace

/* What `find` finds of each pair of slots. Whether it finds anything nobody can foresee: so a
   record is written in any case, and overwritten by the next one if it does not count. */

template <class Find> void ContactHistory::fill(const PairList &pairs, Find find)
{
  const std::int64_t n = pairs.num_pairs();
  renew(places, n);
  touching.assign((n + 7) / 8, 0);
  vacant.clear();
  // addresses for all, that nothing has to move later; only what is written takes memory
  renew(records, n);
  renew(impacts, impact_kept ? n : 0);
  std::uint32_t found = 0;
  for (std::int64_t block = 0; block < n; block += 8) {
    unsigned bits = 0;
    for (std::int64_t c = block; c < std::min(block + 8, n); c++) {
      const Filed its = find(pairs.first[c], pairs.second[c]);
      std::memcpy(&records[found], its.history, sizeof(Record));
      if (!its.by_first) records[found] = mirrored(records[found]);
      if (impact_kept) std::memcpy(&impacts[found], its.impact, sizeof(Record));
      places[c] = found;
      found += its.known;
      bits |= static_cast<unsigned>(its.known) << (c - block);
    }
    touching[block / 8] = static_cast<std::uint8_t>(bits);
  }
  records.resize(found);
  impacts.resize(impact_kept ? found : 0);
}

void ContactHistory::fetch(const PairList &pairs, const FiledHistories &filed,
                           const std::vector<int> &slots_then)
{
  const ParticleOrder &order = pairs.order();
  impact_kept = filed.partners.num_values() == 8;
  if (filed.kept.empty())
    fill(pairs, [&](int first, int second) { return in_lists(filed, order, first, second); });
  else
    fill(pairs,
         [&](int first, int second) { return in_kept(filed, slots_then, order, first, second); });
}

void ContactHistory::keep(const PairList &pairs, KeptContacts::Part &part)
{
  constexpr std::size_t ahead = 8;
  const std::int64_t n = pairs.num_pairs();
  part.first_row = n ? pairs.second[0] : 0;
  part.rows.assign(n ? pairs.second[n - 1] - part.first_row + 2 : 1, 0);
  renew(part.first, records.size() + 2 * ahead);
  renew(part.place, records.size() + 2 * ahead);
  std::uint32_t count = 0;
  for (std::size_t block = 0; block < touching.size(); block++) {
    std::uint32_t found[8];
    const int its = store_places(found, static_cast<std::uint32_t>(8 * block), touching[block]);
    for (int k = 0; k < its; k++) {
      part.first[count] = pairs.first[found[k]];
      part.place[count] = places[found[k]];
      part.rows[pairs.second[found[k]] - part.first_row + 1] = ++count;
    }
  }
  // rows without a pair end where they begin
  for (std::size_t row = 1; row < part.rows.size(); row++)
    part.rows[row] = std::max(part.rows[row], part.rows[row - 1]);
  std::fill(part.first.begin() + count, part.first.end(), -1);
  std::fill(part.place.begin() + count, part.place.end(), 0);
  part.records.swap(records);
  part.impacts.swap(impacts);
  std::fill(touching.begin(), touching.end(), 0);
}

void ContactHistory::begin(std::int64_t pair)
{
  if (vacant.empty()) {
    places[pair] = static_cast<std::uint32_t>(records.size());
    records.push_back(Record{});
    if (impact_kept) impacts.push_back(Record{});
    return;
  }
  places[pair] = vacant.back();
  vacant.pop_back();
  record(pair) = Record{};
  if (impact_kept) impact(pair) = Record{};
}

void ContactHistory::change(std::int64_t block, unsigned bits)
{
  for (unsigned rest = touching[block] & ~bits; rest; rest &= rest - 1)
    vacant.push_back(places[8 * block + __builtin_ctz(rest)]);
  for (unsigned rest = bits & ~touching[block]; rest; rest &= rest - 1)
    begin(8 * block + __builtin_ctz(rest));
  touching[block] = static_cast<std::uint8_t>(bits);
}

/* visit(pair, atom, atom is the first) for both ends of every touching pair, where owned and of
   this range. */

template <class Visit> void ContactHistory::for_each_end(const PairList &pairs, Visit visit) const
{
  const ParticleOrder &order = pairs.order();
  for (std::int64_t c = 0; c < pairs.num_pairs(); c++) {
    if (!touches(c)) continue;
    const int first = pairs.first[c], second = pairs.second[c];
    const int a = order.atom_of_slot[first], b = order.atom_of_slot[second];
    if (order.is_owned(a) && !pairs.is_foreign(first)) visit(c, a, true);
    if (order.is_owned(b)) visit(c, b, false);
  }
}

/* visit(pair, atom) for every touching pair whose first particle is owned and of another range. */

template <class Visit>
void ContactHistory::for_each_foreign(const PairList &pairs, Visit visit) const
{
  const ParticleOrder &order = pairs.order();
  for (const std::int64_t c : pairs.frontier()) {
    const int first = pairs.first[c], a = order.atom_of_slot[first];
    if (pairs.is_foreign(first) && touches(c) && order.is_owned(a)) visit(c, a);
  }
}

void ContactHistory::announce(const PairList &pairs, PartnerLists &partners) const
{
  for_each_end(pairs, [&](std::int64_t, int atom, bool) { partners.count(atom); });
}

void ContactHistory::announce_foreign(const PairList &pairs, PartnerLists &partners) const
{
  for_each_foreign(pairs, [&](std::int64_t, int atom) { partners.count(atom); });
}

void ContactHistory::file(const PairList &pairs, PartnerLists &partners) const
{
  for_each_end(pairs,
               [&](std::int64_t c, int, bool of_first) { file_end(pairs, partners, c, of_first); });
}

void ContactHistory::file_foreign(const PairList &pairs, PartnerLists &partners) const
{
  for_each_foreign(pairs, [&](std::int64_t c, int) { file_end(pairs, partners, c, true); });
}

void ContactHistory::file_end(const PairList &pairs, PartnerLists &partners, std::int64_t pair,
                              bool from_first) const
{
  const ParticleOrder &order = pairs.order();
  const int first = order.atom_of_slot[pairs.first[pair]],
            second = order.atom_of_slot[pairs.second[pair]];
  double *values =
      partners.append(from_first ? first : second, order.tag[from_first ? second : first]);
  const Record seen = from_first ? record(pair) : mirrored(record(pair));
  std::copy(std::begin(seen.c), std::end(seen.c), values);
  if (impact_kept) std::copy(std::begin(impact(pair).c), std::end(impact(pair).c), values + 4);
}

void ContactHistory::adopt_first_copies(
    const PairList &pairs, PartnerLists &partners,
    const std::function<const double *(int, std::int64_t)> &ghost_values) const
{
  const ParticleOrder &order = pairs.order();
  for (std::int64_t c = 0; c < pairs.num_pairs(); c++) {
    const int a = order.atom_of_slot[pairs.first[c]], b = order.atom_of_slot[pairs.second[c]];
    if (!touches(c) || order.is_owned(a)) continue;
    const double *theirs = ghost_values(a, order.tag[b]);
    double *mine = partners.find(b, order.tag[a]);
    if (!theirs || !mine) continue;
    const Record seen = mirrored({{theirs[0], theirs[1], theirs[2], theirs[3]}});
    std::copy(std::begin(seen.c), std::end(seen.c), mine);
    std::copy(theirs + 4, theirs + partners.num_values(), mine + 4);
  }
}

void ContactHistory::release()
{
  *this = ContactHistory{};
}

double ContactHistory::memory_usage() const
{
  return static_cast<double>((records.capacity() + impacts.capacity()) * sizeof(Record) +
                             (places.capacity() + vacant.capacity()) * sizeof(std::uint32_t) +
                             touching.capacity());
}

}    // namespace Talus
