// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "contact/contact_history.h"

#include <algorithm>

namespace Talus {

void ContactHistory::fetch(const CandidateList &pairs, const PartnerLists &partners,
                           const std::int64_t *filed_tag)
{
  const std::int64_t *tag = filed_tag ? filed_tag : pairs.tag.data();
  records.assign(pairs.num_pairs(), Record{});
  touching.assign((pairs.num_pairs() + 7) / 8, 0);

  for (std::int64_t c = 0; c < pairs.num_pairs(); c++) {
    const int a = pairs.atom_of_slot[pairs.first[c]], b = pairs.atom_of_slot[pairs.second[c]];
    const bool from_first = pairs.is_owned(a);
    const auto *p = from_first ? partners.find(a, tag[b]) : partners.find(b, tag[a]);
    if (!p) continue;
    const Record seen{{p->history[0], p->history[1], p->history[2], p->history[3]}};
    records[c] = from_first ? seen : mirrored(seen);
    touching[c / 8] |= 1U << (c % 8);
  }
}

void ContactHistory::file(const CandidateList &pairs, PartnerLists &partners) const
{
  const auto for_each_touching = [&](auto visit) {
    for (std::int64_t c = 0; c < pairs.num_pairs(); c++)
      if (touches(c))
        visit(pairs.atom_of_slot[pairs.first[c]], pairs.atom_of_slot[pairs.second[c]], records[c]);
  };

  partners.begin();
  for_each_touching([&](int a, int b, const Record &) {
    if (pairs.is_owned(a)) partners.count(a);
    if (pairs.is_owned(b)) partners.count(b);
  });
  partners.layout();
  for_each_touching([&](int a, int b, const Record &history) {
    if (pairs.is_owned(a)) partners.append(a, pairs.tag[b], history);
    if (pairs.is_owned(b)) partners.append(b, pairs.tag[a], mirrored(history));
  });
}

void ContactHistory::release()
{
  std::vector<Record>().swap(records);
  std::vector<std::uint8_t>().swap(touching);
}

void ContactHistory::forget(std::int64_t block, unsigned separated)
{
  for (int bit = 0; bit < 8; bit++)
    if (separated >> bit & 1U) records[8 * block + bit] = Record{};
}

double ContactHistory::memory_usage() const
{
  return static_cast<double>(records.capacity() * sizeof(Record) + touching.capacity());
}

}    // namespace Talus
