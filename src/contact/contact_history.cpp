// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "contact/contact_history.h"

#include <algorithm>

namespace Talus {

void ContactHistory::fetch(const CandidateList &pairs, const PartnerLists &partners,
                           const std::vector<std::int64_t> &filed_tag)
{
  const bool with_onsets = partners.num_values() == 8;
  records.assign(pairs.num_pairs(), Record{});
  onsets.assign(with_onsets ? pairs.num_pairs() : 0, Record{});
  touching.assign((pairs.num_pairs() + 7) / 8, 0);

  for (std::int64_t c = 0; c < pairs.num_pairs(); c++) {
    const int a = pairs.atom_of_slot[pairs.first[c]], b = pairs.atom_of_slot[pairs.second[c]];
    const bool from_first = pairs.is_owned(a);
    const int owner = from_first ? a : b, partner = from_first ? b : a;
    const double *v = filed_tag[partner] ? partners.find(owner, filed_tag[partner]) : nullptr;
    if (!v) continue;
    const Record seen{{v[0], v[1], v[2], v[3]}};
    records[c] = from_first ? seen : mirrored(seen);
    if (with_onsets) onsets[c] = {{v[4], v[5], v[6], v[7]}};
    touching[c / 8] |= 1U << (c % 8);
  }
}

void ContactHistory::file(const CandidateList &pairs, PartnerLists &partners) const
{
  const auto for_each_touching = [&](auto visit) {
    for (std::int64_t c = 0; c < pairs.num_pairs(); c++)
      if (touches(c))
        visit(c, pairs.atom_of_slot[pairs.first[c]], pairs.atom_of_slot[pairs.second[c]]);
  };

  partners.begin();
  for_each_touching([&](std::int64_t, int a, int b) {
    if (pairs.is_owned(a)) partners.count(a);
    if (pairs.is_owned(b)) partners.count(b);
  });
  partners.layout();
  for_each_touching([&](std::int64_t c, int a, int b) {
    if (pairs.is_owned(a)) file_entry(partners.append(a, pairs.tag[b]), c, true);
    if (pairs.is_owned(b)) file_entry(partners.append(b, pairs.tag[a]), c, false);
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
  for (std::int64_t c = 0; c < pairs.num_pairs(); c++) {
    const int a = pairs.atom_of_slot[pairs.first[c]], b = pairs.atom_of_slot[pairs.second[c]];
    if (!touches(c) || pairs.is_owned(a)) continue;
    const double *theirs = ghost_values(a, pairs.tag[b]);
    double *mine = partners.find(b, pairs.tag[a]);
    if (!theirs || !mine) continue;
    const Record seen = mirrored({{theirs[0], theirs[1], theirs[2], theirs[3]}});
    std::copy(std::begin(seen.c), std::end(seen.c), mine);
    std::copy(theirs + 4, theirs + partners.num_values(), mine + 4);
  }
}

void ContactHistory::release()
{
  std::vector<Record>().swap(records);
  std::vector<Record>().swap(onsets);
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
