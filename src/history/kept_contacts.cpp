// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "history/kept_contacts.h"

#include "base/in_parallel.h"
#include "history/partner_lists.h"

#include <algorithm>

namespace Talus {

void KeptContacts::begin(const ParticleOrder &order, const WorkPartition &partition,
                         bool particles_may_leave)
{
  filled = true;
  may_leave = particles_may_leave;
  most = 0;
  work = partition;
  parts.resize(work.num_chunks());

  slot_by_name.clear();
  tag.clear();
  if (!may_leave) return;
  tag.resize(order.size());
  for (int s = 0; s < order.size(); s++) {
    const int atom = order.atom_of_slot[s];
    tag[s] = order.tag[atom];
    if (!order.is_owned(atom)) slot_by_name[tag[s]] = was_ghost(s);
  }
}

/* visit(first, second) for every pair of a chunk whose first particle is of its range, or is not. */

template <class Visit> void KeptContacts::for_each_pair(int p, bool of_own_first, Visit visit) const
{
  const Part &its = parts[p];
  for (std::size_t row = 0; row + 1 < its.rows.size(); row++)
    for (std::uint32_t e = its.rows[row]; e < its.rows[row + 1]; e++) {
      if (is_of_own_range(p, its.first[e]) == of_own_first)
        visit(its.first[e], its.first_row + static_cast<int>(row));
    }
}

/* visit(chunk, of its own range) for all pairs: of chunks with a phase in common at the same time,
   each with the first particles of its range; the few with others follow. */

template <class Visit> void KeptContacts::for_each_chunk(Visit visit) const
{
  for (int phase = 0; phase < work.num_phases(); phase++)
    in_parallel(work.num_ranges(), threads, [&](int r) { visit(work.chunk(phase, r), true); });
  for (int p = 0; p < num_chunks(); p++) visit(p, false);
}

void KeptContacts::finish(int num_threads)
{
  if (!may_leave) return;
  threads = num_threads;
  listed = false;
  followers_begin.assign(tag.size() + 2, 0);
  const auto count = [this](int p, bool of_own_first) {
    const Part &its = parts[p];
    for (std::uint32_t e = 0; e < its.rows.back(); e++)
      if (is_of_own_range(p, its.first[e]) == of_own_first) followers_begin[its.first[e] + 2]++;
  };
  for_each_chunk(count);
  for (int s = 0; s < static_cast<int>(tag.size()); s++) {
    std::uint32_t all = followers_begin[s + 2];
    for (int phase = 0; phase < work.num_phases(); phase++) {
      const Part &its = parts[work.chunk(phase, work.range_of(s))];
      all += its.row_end(s) - its.row_begin(s);
    }
    most = std::max(most, static_cast<int>(all));
  }
}

/* From the number of followers of each particle to lists: when the first one leaves, for often
   nobody does. */

void KeptContacts::list_followers()
{
  listed = true;
  for (std::size_t s = 2; s < followers_begin.size(); s++)
    followers_begin[s] += followers_begin[s - 1];
  renew(followers, followers_begin.back());
  // the begin of a row moves on to its end
  for_each_chunk([this](int p, bool of_own_first) {
    for_each_pair(p, of_own_first, [this](int first, int second) {
      followers[followers_begin[first + 1]++] = second;
    });
  });
  followers_begin.pop_back();
}

int KeptContacts::pack(int slot, int values, double *buffer)
{
  if (!may_leave) {
    buffer[0] = 0.0;
    return 1;
  }
  if (!listed) list_followers();
  slot_by_name[tag[slot]] = slot;
  double *to = buffer + 1;
  int count = 0;
  const auto add = [&](const Part &its, int partner, std::int64_t place, bool is_first) {
    const Record &record = its.records[place];
    const Record seen = is_first ? record : mirrored(record);
    double all[8] = {seen.c[0], seen.c[1], seen.c[2], seen.c[3]};
    if (!its.impacts.empty()) std::copy_n(its.impacts[place].c, 4, all + 4);
    to = PartnerLists::write_entry(to, tag[partner], all, values);
    count++;
  };
  for (int phase = 0; phase < work.num_phases(); phase++) {
    const Part &own = parts[work.chunk(phase, work.range_of(slot))];
    for (std::uint32_t e = own.row_begin(slot); e < own.row_end(slot); e++)
      add(own, own.first[e], own.place[e], false);
  }
  for (std::uint32_t n = followers_begin[slot]; n < followers_begin[slot + 1]; n++) {
    const Part &its = parts[work.chunk_with_pair(slot, followers[n])];
    add(its, followers[n], its.find(slot, followers[n]), true);
  }
  buffer[0] = count;
  return static_cast<int>(to - buffer);
}

int KeptContacts::slot_named(std::int64_t name) const
{
  const auto found = slot_by_name.find(name);
  return found != slot_by_name.end() ? found->second : unknown;
}

/* One of the two has to have been owned, since of two ghosts nothing is known. */

KeptContacts::Found KeptContacts::find_of_ghost(int a, int b) const
{
  if ((a < 0 && b < 0) || a == unknown || b == unknown) return {};
  return a < 0 ? find_of_owned(was_ghost(a), b) : find_of_owned(a, was_ghost(b));
}

void KeptContacts::clear()
{
  filled = false;
  most = 0;
  if (memory_usage() > worth_giving_back) *this = KeptContacts{};
}

double KeptContacts::memory_usage() const
{
  std::size_t bytes =
      static_cast<std::size_t>(work.memory_usage()) + sizeof(std::int64_t) * tag.capacity() +
      sizeof(std::uint32_t) * followers_begin.capacity() + sizeof(int) * followers.capacity() +
      (sizeof(std::pair<std::int64_t, int>) + 2 * sizeof(void *)) * slot_by_name.size();
  for (const Part &p : parts)
    bytes += sizeof(std::uint32_t) * p.rows.capacity() + sizeof(int) * p.first.capacity() +
             sizeof(std::uint32_t) * p.place.capacity() +
             sizeof(Record) * (p.records.capacity() + p.impacts.capacity());
  return static_cast<double>(bytes);
}

}    // namespace Talus
