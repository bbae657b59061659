// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "contact/contact_history.h"

#include <algorithm>

namespace Talus {

void ContactHistory::fetch(const CandidateList &pairs, const PartnerLists &partners,
                           const std::vector<std::int64_t> &filed_tag)
{
  const ParticleOrder &order = pairs.order();
  const bool with_onsets = partners.num_values() == 8;
  renew(records, pairs.num_pairs());
  renew(onsets, with_onsets ? pairs.num_pairs() : 0);
  std::fill(records.begin(), records.end(), Record{});
  std::fill(onsets.begin(), onsets.end(), Record{});
  touching.assign((pairs.num_pairs() + 7) / 8, 0);

  for (std::int64_t c = 0; c < pairs.num_pairs(); c++) {
    const int a = order.atom_of_slot[pairs.first[c]], b = order.atom_of_slot[pairs.second[c]];
    const bool from_first = order.is_owned(a);
    const int owner = from_first ? a : b, partner = from_first ? b : a;
    const double *v = filed_tag[partner] ? partners.find(owner, filed_tag[partner]) : nullptr;
    if (!v) continue;
    const Record seen{{v[0], v[1], v[2], v[3]}};
    records[c] = from_first ? seen : mirrored(seen);
    if (with_onsets) onsets[c] = {{v[4], v[5], v[6], v[7]}};
    touching[c / 8] |= 1U << (c % 8);
  }
}

/* visit(pair, atom, partner, atom is the first) for both ends of every touching pair, where owned
   and served. */

template <class Visit>
void ContactHistory::for_each_end(const CandidateList &pairs, Visit visit) const
{
  const ParticleOrder &order = pairs.order();
  for (std::int64_t c = 0; c < pairs.num_pairs(); c++) {
    if (!touches(c)) continue;
    const int first = pairs.first[c], second = pairs.second[c];
    const int a = order.atom_of_slot[first], b = order.atom_of_slot[second];
    if (order.is_owned(a) && pairs.serves(first)) visit(c, a, b, true);
    if (order.is_owned(b) && pairs.serves(second)) visit(c, b, a, false);
  }
}

void ContactHistory::announce(const CandidateList &pairs, PartnerLists &partners) const
{
  for_each_end(pairs, [&](std::int64_t, int atom, int, bool) { partners.count(atom); });
}

void ContactHistory::file(const CandidateList &pairs, PartnerLists &partners) const
{
  const std::vector<std::int64_t> &tag = pairs.order().tag;
  for_each_end(pairs, [&](std::int64_t c, int atom, int partner, bool is_first) {
    file_entry(partners.append(atom, tag[partner]), c, is_first);
  });
}

void ContactHistory::file_entry(double *values, std::int64_t pair, bool from_first) const
{
  const Record seen = from_first ? records[pair] : mirrored(records[pair]);
  std::copy(std::begin(seen.c), std::end(seen.c), values);
  if (!onsets.empty()) std::copy(std::begin(onsets[pair].c), std::end(onsets[pair].c), values + 4);
}

void ContactHistory::adopt_first_copies(
    const CandidateList &pairs, PartnerLists &partners,
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
  BigVector<Record>().swap(records);
  BigVector<Record>().swap(onsets);
  std::vector<std::uint8_t>().swap(touching);
}

void ContactHistory::forget(std::int64_t block, unsigned separated)
{
  for (int bit = 0; bit < 8; bit++) {
    if (!(separated >> bit & 1U)) continue;
    records[8 * block + bit] = Record{};
    if (!onsets.empty()) onsets[8 * block + bit] = Record{};
  }
}

double ContactHistory::memory_usage() const
{
  return static_cast<double>((records.capacity() + onsets.capacity()) * sizeof(Record) +
                             touching.capacity());
}

}    // namespace Talus
