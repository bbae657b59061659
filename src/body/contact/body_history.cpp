// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "body/contact/body_history.h"

#include "laws/tangential/end_of_contact.h"

#include <algorithm>
#include <utility>

namespace Talus {

constexpr int size_normal = 3;

int BodyHistory::count(std::size_t candidate) const
{
  if (with_several) return counts[candidate];
  return static_cast<int>(touched(candidate / 8) >> candidate % 8 & 1U);
}

void BodyHistory::set_zero(std::size_t slot)
{
  rows.set_zero(slot);
  if (with_normals) normals[slot] = {0.0, 0.0, 0.0};
}

BodyHistory::~BodyHistory()
{
  leave_memory();
}

void BodyHistory::keep_records(int records)
{
  rows.keep(records);
}

void BodyHistory::rest_in(ContactMemory &place, std::int64_t partner)
{
  memory = &place;
  name = partner;
  memory->add(*this);
}

void BodyHistory::leave_memory()
{
  if (memory) memory->remove(*this);
  memory = nullptr;
}

void BodyHistory::add(ContactLists &to, int particle, std::uint64_t feature,
                      const Vector3<double> &normal, const HistoryValues &values) const
{
  double *const at = to.add(particle, name, feature, size_normal + 4 * rows.records());
  at[0] = normal.x;
  at[1] = normal.y;
  at[2] = normal.z;
  std::copy_n(values.begin(), 4L * rows.records(), at + size_normal);
}

HistoryValues BodyHistory::values_of(const ContactLists::Contact &one)
{
  HistoryValues values{};
  const int count = std::min(one.values - size_normal, most_history_values);
  std::copy_n(one.value + size_normal, std::max(count, 0), values.begin());
  return values;
}

void BodyHistory::put_aside(ContactLists &to)
{
  for (std::size_t c = 0; c < owners.size(); c++)
    for (int k = 0; k < count(c); k++) {
      const std::size_t slot = first_slot(c) + k;
      const int feature = !with_parts ? k : with_several ? parts[slot] : 0;
      add(to, owners[c], static_cast<std::uint32_t>(feature), normal_at(slot), rows.values(slot));
    }
}

int BodyHistory::count_in(const ContactLists &lists, int particle) const
{
  int count = 0;
  lists.for_each(particle, [&](const ContactLists::Contact &one) { count += owns(one); });
  return with_parts ? count : std::min(count, LargeBodyShape::max_contacts);
}

std::vector<int> BodyHistory::particles_in_contact(int owned) const
{
  std::vector<int> those;
  if (rests()) {
    for (int i = 0; i < owned && !memory->lists().empty(); i++)
      if (count_in(memory->lists(), i) > 0) those.push_back(i);
    return those;
  }
  for (std::size_t c = 0; c < owners.size(); c++)
    if (count(c) > 0) those.push_back(owners[c]);
  std::sort(those.begin(), those.end());
  return those;
}

/* Between two rebuilds there are other candidates without a rest: a body has moved, or they are sorted. */

void BodyHistory::follow(const std::vector<int> &candidates, const std::vector<std::uint8_t> &room)
{
  ContactLists between;
  if (!rests()) {
    int last = -1;
    for (const int i : owners) last = std::max(last, i);
    for (const int i : candidates) last = std::max(last, i);
    between.grow(last + 1);
    put_aside(between);
  }
  const ContactLists &from = rests() ? memory->lists() : between;
  owners = candidates;
  const std::size_t n = owners.size();
  first.clear();
  counts.clear();
  touching = std::vector<std::atomic<std::uint8_t>>(with_several ? 0 : (n + 7) / 8);
  std::size_t slots = with_several ? 0 : n;
  for (std::size_t c = 0; c < n && with_several; c++) {
    const int number = count_in(from, owners[c]);
    counts.push_back(static_cast<std::uint8_t>(number));
    first.push_back(static_cast<std::uint32_t>(slots));
    slots += std::max(room[c], counts[c]);
  }
  rows.clear();
  rows.resize(slots);
  normals.resize(with_normals ? slots : 0);
  parts.resize(with_several && with_parts ? slots : 0);
  for (std::size_t c = 0; c < n; c++) take_back(c, from);
  forgets_those_at_rest = false;
  begin_step();
}

/* The file of a restart may hold more contacts than the body can have now. */

void BodyHistory::take_back(std::size_t c, const ContactLists &from)
{
  const int most = with_several ? counts[c] : 1;
  if (!with_several) set_zero(c);
  int k = 0;
  from.for_each(owners[c], [&](const ContactLists::Contact &one) {
    if (k == most || !owns(one)) return;
    const std::size_t slot = first_slot(c) + k++;
    if (with_normals)
      normals[slot] = forgets_those_at_rest
                          ? Vector3<double>{0.0, 0.0, 0.0}
                          : Vector3<double>{one.value[0], one.value[1], one.value[2]};
    if (with_several && with_parts) parts[slot] = static_cast<int>(one.feature);
    rows.set_values(slot, values_of(one));
  });
  if (!with_several && k)
    touching[c / 8].fetch_or(static_cast<std::uint8_t>(1U << c % 8), std::memory_order_relaxed);
}

void BodyHistory::clear(std::size_t block, unsigned separated)
{
  for (std::size_t c = 8 * block; separated; c++, separated >>= 1U) {
    if (!(separated & 1U)) continue;
    set_zero(c);
  }
}

/// Contacts of a candidate a step ago.
struct BodyHistory::Known {
  struct Contact {
    Vector3<double> normal;
    Record history[HistoryRows::most_records];
  };
  Contact contact[LargeBodyShape::max_contacts];
  int count = 0;
  unsigned continued = 0;

  /// Of those that do not go on yet, among those of `may`: the one with the nearest normal, or -1.
  int nearest(const Vector3<double> &normal, unsigned may = ~0U) const
  {
    int best = -1;
    double largest = least_cosine;
    for (int k = 0; k < count; k++) {
      const double cosine = dot(contact[k].normal, normal);
      if (!(may & ~continued & 1U << k) || cosine <= largest) continue;
      largest = cosine;
      best = k;
    }
    return best;
  }
};

int BodyHistory::continue_contacts(std::size_t candidate, SurfaceContact *found, int count,
                                   Vector3<double> *before, const Ends *ends, bool reaches)
{
  Known known;
  known.count = counts[candidate];
  const std::size_t slot = first[candidate];
  unsigned last = ~0U;    // those that may be without overlap
  for (int k = 0; k < known.count; k++) {
    known.contact[k].normal = normals[slot + k];
    rows.get(slot + k, known.contact[k].history);
    if (ends && !has_just_ended(known.contact[k].history[0].c[3], ends->advance))
      last &= ~(1U << k);
  }
  int left = 0;
  const auto keep_contact = [&](const SurfaceContact &contact, int with) {
    found[left] = contact;
    if (before) before[left] = with >= 0 ? known.contact[with].normal : Vector3<double>{};
    normals[slot + left] = contact.normal;
    if (with >= 0) {
      known.continued |= 1U << with;
      rows.set(slot + left, known.contact[with].history);
    } else {
      rows.set_zero(slot + left);
    }
    left++;
  };
  for (int n = 0; n < count; n++) {
    const bool touches = reaches || found[n].overlap > 0.0;
    const int best = known.nearest(found[n].normal, touches ? ~0U : last);
    if (touches || best >= 0) keep_contact(found[n], best);
  }
  const std::size_t end = candidate + 1 < first.size() ? first[candidate + 1] : rows.size();
  const int room = std::min(static_cast<int>(end - slot), LargeBodyShape::max_contacts);
  if (ends && (last & ~known.continued & ((1U << known.count) - 1U))) {
    SurfaceContact far[LargeBodyShape::max_contacts];
    const int num_far = ends->look_further(far);
    for (int n = 0; n < num_far && left < room; n++) {
      const int best = far[n].overlap > 0.0 ? -1 : known.nearest(far[n].normal, last);
      if (best >= 0) keep_contact(far[n], best);
    }
  }
  counts[candidate] = static_cast<std::uint8_t>(left);
  return left;
}

/* Of contacts with parts of a wall, places are those of fix wall/gran/region of LAMMPS: the last one takes
   the place of one that has ended, new ones are behind the others. Numbers of parts of some regions
   occur twice, and their contacts are known by their order as well. */

int BodyHistory::drop_ended_parts(std::size_t slot, int known, const SurfaceContact *found,
                                  int count)
{
  unsigned going_on = 0;    // of `found`
  for (int k = 0; k < known;) {
    int n = 0;
    while (n < count && (found[n].part != parts[slot + k] || (going_on >> n & 1U))) n++;
    if (n < count) {
      going_on |= 1U << n;
      k++;
      continue;
    }
    known--;
    parts[slot + k] = parts[slot + known];
    set_values(slot + k, values(slot + known));
  }
  return known;
}

/* `contact_at` leads from places to contacts, and is read the other way round, which makes a difference
   from three contacts on: so does LAMMPS. */

void BodyHistory::match_parts(std::size_t candidate, const SurfaceContact *found, int count,
                              std::uint32_t *slots)
{
  const std::size_t slot = first[candidate];
  const int known = drop_ended_parts(slot, counts[candidate], found, count);
  int all = known, contact_at[LargeBodyShape::max_parts];
  unsigned taken = 0;    // places
  for (int n = 0; n < count; n++) {
    int k = 0;
    while (k < known && (parts[slot + k] != found[n].part || (taken >> k & 1U))) k++;
    if (k == known) {
      k = all++;
      parts[slot + k] = found[n].part;
      rows.set_zero(slot + k);
    }
    taken |= 1U << k;
    contact_at[k] = n;
  }
  for (int n = 0; n < count; n++) slots[n] = static_cast<std::uint32_t>(slot + contact_at[n]);
  counts[candidate] = static_cast<std::uint8_t>(all);
}

double BodyHistory::memory_usage() const
{
  const auto bytes = [](const auto &v) { return static_cast<double>(v.capacity() * sizeof v[0]); };
  return bytes(owners) + bytes(first) + bytes(counts) + bytes(normals) + bytes(parts) +
         bytes(touching) + rows.memory_usage();
}

}    // namespace Talus
