// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "contact/contact_history.h"

#include <algorithm>

namespace Talus {

void ContactHistory::fetch(const CandidateList &pairs, const PartnerLists &partners,
                           const std::vector<std::int64_t> &filed_tag)
{
  const ParticleOrder &order = pairs.order();
  onset_kept = partners.num_values() == 8;
  renew(places, pairs.num_pairs());
  touching.assign((pairs.num_pairs() + 7) / 8, 0);
  vacant.clear();
  // addresses for all, that nothing has to move later; only what is written takes memory
  for (BigVector<Record> *each : {&records, &onsets}) {
    renew(*each, each == &records || onset_kept ? pairs.num_pairs() : 0);
    each->clear();
  }

  const bool under_one_end = !partners.has_both_ends();
  for (std::int64_t c = 0; c < pairs.num_pairs(); c++) {
    const int a = order.atom_of_slot[pairs.first[c]], b = order.atom_of_slot[pairs.second[c]];
    const bool from_first = under_one_end ? filed_tag[a] < filed_tag[b] : order.is_owned(a);
    const int owner = from_first ? a : b, partner = from_first ? b : a;
    const double *v = filed_tag[partner] ? partners.find(owner, filed_tag[partner]) : nullptr;
    if (!v) continue;
    const Record seen{{v[0], v[1], v[2], v[3]}};
    begin(c);
    record(c) = from_first ? seen : mirrored(seen);
    if (onset_kept) onset(c) = {{v[4], v[5], v[6], v[7]}};
    touching[c / 8] = static_cast<std::uint8_t>(touching[c / 8] | 1U << (c % 8));
  }
}

void ContactHistory::begin(std::int64_t pair)
{
  if (vacant.empty()) {
    places[pair] = static_cast<std::uint32_t>(records.size());
    records.push_back(Record{});
    if (onset_kept) onsets.push_back(Record{});
    return;
  }
  places[pair] = vacant.back();
  vacant.pop_back();
  record(pair) = Record{};
  if (onset_kept) onset(pair) = Record{};
}

void ContactHistory::change(std::int64_t block, unsigned bits)
{
  for (unsigned rest = touching[block] & ~bits; rest; rest &= rest - 1)
    vacant.push_back(places[8 * block + __builtin_ctz(rest)]);
  for (unsigned rest = bits & ~touching[block]; rest; rest &= rest - 1)
    begin(8 * block + __builtin_ctz(rest));
  touching[block] = static_cast<std::uint8_t>(bits);
}

/* visit(pair, atom, partner, atom is the first) for both ends of every touching pair, or only that
   with the lower tag, where owned and served. */

template <class Visit>
void ContactHistory::for_each_end(const CandidateList &pairs, bool both_ends, Visit visit) const
{
  const ParticleOrder &order = pairs.order();
  for (std::int64_t c = 0; c < pairs.num_pairs(); c++) {
    if (!touches(c)) continue;
    const int first = pairs.first[c], second = pairs.second[c];
    const int a = order.atom_of_slot[first], b = order.atom_of_slot[second];
    const bool under_first = both_ends || order.tag[a] < order.tag[b];
    const bool under_second = both_ends || !under_first;
    if (under_first && order.is_owned(a) && pairs.serves(first)) visit(c, a, b, true);
    if (under_second && order.is_owned(b) && pairs.serves(second)) visit(c, b, a, false);
  }
}

void ContactHistory::announce(const CandidateList &pairs, PartnerLists &partners) const
{
  for_each_end(pairs, partners.has_both_ends(),
               [&](std::int64_t, int atom, int, bool) { partners.count(atom); });
}

void ContactHistory::file(const CandidateList &pairs, PartnerLists &partners) const
{
  const std::vector<std::int64_t> &tag = pairs.order().tag;
  for_each_end(pairs, partners.has_both_ends(),
               [&](std::int64_t c, int atom, int partner, bool is_first) {
                 file_entry(partners.append(atom, tag[partner]), c, is_first);
               });
}

void ContactHistory::file_entry(double *values, std::int64_t pair, bool from_first) const
{
  const Record seen = from_first ? record(pair) : mirrored(record(pair));
  std::copy(std::begin(seen.c), std::end(seen.c), values);
  if (onset_kept) std::copy(std::begin(onset(pair).c), std::end(onset(pair).c), values + 4);
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
  *this = ContactHistory{};
}

double ContactHistory::memory_usage() const
{
  return static_cast<double>((records.capacity() + onsets.capacity()) * sizeof(Record) +
                             (places.capacity() + vacant.capacity()) * sizeof(std::uint32_t) +
                             touching.capacity());
}

}    // namespace Talus
