// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "body/contact/body_history.h"

#include <algorithm>
#include <utility>

namespace Talus {

int BodyHistory::count_of_entry(std::size_t entry) const
{
  if (with_several) return counts[entry];
  if (entry >= num_candidates) return 1;
  return static_cast<int>(touched(entry / 8) >> entry % 8 & 1U);
}

int BodyHistory::count(int particle) const
{
  return entry_of[particle] == nowhere ? 0 : count_of_entry(entry_of[particle]);
}

Record BodyHistory::of_particle(int particle) const
{
  return count(particle) ? records[first_slot(entry_of[particle])] : Record{};
}

BodyHistory::Contact BodyHistory::contact_at(std::size_t slot) const
{
  return {with_normals ? normals[slot] : Vector3<double>{0.0, 0.0, 0.0}, records[slot],
          with_impact ? impacts[slot] : Record{}};
}

void BodyHistory::put(std::size_t slot, const Contact &contact)
{
  records[slot] = contact.history;
  if (with_impact) impacts[slot] = contact.impact;
  if (with_normals) normals[slot] = contact.normal;
}

void BodyHistory::resize_slots(std::size_t n)
{
  records.resize(n);
  impacts.resize(with_impact ? n : 0);
  normals.resize(with_normals ? n : 0);
}

int BodyHistory::pack(int particle, double *buf) const
{
  const int number = count(particle);
  double *to = buf;
  *to++ = number;
  for (int k = 0; k < number; k++) {
    const Contact c = contact_at(first_slot(entry_of[particle]) + k);
    for (const double component : {c.normal.x, c.normal.y, c.normal.z}) *to++ = component;
    to = std::copy(c.history.c, c.history.c + 4, to);
    to = std::copy(c.impact.c, c.impact.c + 4, to);
  }
  return static_cast<int>(to - buf);
}

/* Most particles that arrive are far from the body: they get no slot. The file of a restart may
   hold more contacts than the body can have now. */

int BodyHistory::unpack(int particle, const double *buf)
{
  const int number = static_cast<int>(buf[0]);
  const int kept = std::min(number, with_several ? LargeBodyShape::max_contacts : 1);
  entry_of[particle] = nowhere;
  if (kept) {
    const std::size_t slot = records.size();
    entry_of[particle] = static_cast<int>(with_several ? first.size() : slot);
    if (with_several) {
      first.push_back(static_cast<std::uint32_t>(slot));
      counts.push_back(static_cast<std::uint8_t>(kept));
    }
    resize_slots(slot + kept);
    for (int k = 0; k < kept; k++) {
      const double *c = buf + 1 + k * size_contact;
      put(slot + k, {{c[0], c[1], c[2]}, {{c[3], c[4], c[5], c[6]}}, {{c[7], c[8], c[9], c[10]}}});
    }
  }
  return 1 + number * size_contact;
}

void BodyHistory::follow(const std::vector<int> &candidates, const std::vector<std::uint8_t> &room)
{
  const std::size_t n = candidates.size();
  std::vector<int> from(n);
  for (std::size_t c = 0; c < n; c++) from[c] = entry_of[candidates[c]];
  std::fill(entry_of.begin(), entry_of.end(), nowhere);
  for (std::size_t c = 0; c < n; c++) entry_of[candidates[c]] = static_cast<int>(c);

  BodyHistory old = std::exchange(*this, BodyHistory{});
  keep(old.with_several, old.with_impact, old.with_normals);
  entry_of.swap(old.entry_of);
  num_candidates = n;
  touching = std::vector<std::atomic<std::uint8_t>>(with_several ? 0 : (n + 7) / 8);
  const auto old_count = [&](std::size_t c) {
    return from[c] == nowhere ? 0 : old.count_of_entry(from[c]);
  };
  std::size_t slots = 0;
  for (std::size_t c = 0; c < n && with_several; c++) {
    counts.push_back(static_cast<std::uint8_t>(old_count(c)));
    first.push_back(static_cast<std::uint32_t>(slots));
    slots += std::max(room[c], counts[c]);
  }
  resize_slots(with_several ? slots : n);
  for (std::size_t c = 0; c < n; c++) {
    const int number = old_count(c);
    for (int k = 0; k < number; k++)
      put(first_slot(c) + k, old.contact_at(old.first_slot(from[c]) + k));
    if (with_several) continue;
    if (number)
      touching[c / 8].fetch_or(static_cast<std::uint8_t>(1U << c % 8));
    else
      put(c, Contact{});
  }
}

void BodyHistory::clear(std::size_t block, unsigned separated)
{
  for (std::size_t c = 8 * block; separated; c++, separated >>= 1U) {
    if (!(separated & 1U)) continue;
    records[c] = Record{};
    if (with_impact) impacts[c] = Record{};
    if (with_normals) normals[c] = {0.0, 0.0, 0.0};
  }
}

/// Contacts of a candidate a step ago.
struct BodyHistory::Known {
  Contact contact[LargeBodyShape::max_contacts];
  int count = 0;
  unsigned continued = 0;

  /// Of those that do not go on yet, among those of `may`: the one with the nearest normal, or -1.
  int nearest(const Vector3<double> &normal, unsigned may = ~0U) const
  {
    constexpr double least_cosine = 0.8;    // 37 degrees; more than facets of a smooth patch differ
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
                                   Vector3<double> *before, const Ends *ends)
{
  Known known;
  known.count = counts[candidate];
  const std::size_t slot = first[candidate];
  unsigned last = ~0U;    // those that may be without overlap
  for (int k = 0; k < known.count; k++) {
    known.contact[k] = contact_at(slot + k);
    if (ends && !ends->lasts(known.contact[k].history)) last &= ~(1U << k);
  }
  int left = 0;
  const auto go_on = [&](const SurfaceContact &its, int with) {
    found[left] = its;
    if (before) before[left] = with >= 0 ? known.contact[with].normal : Vector3<double>{};
    Contact now{its.normal, Record{}, Record{}};
    if (with >= 0) {
      known.continued |= 1U << with;
      now.history = known.contact[with].history;
      now.impact = known.contact[with].impact;
    }
    put(slot + left++, now);
  };
  for (int n = 0; n < count; n++) {
    const bool touches = found[n].overlap > 0.0;
    const int best = known.nearest(found[n].normal, touches ? ~0U : last);
    if (touches || best >= 0) go_on(found[n], best);
  }
  const std::size_t end = candidate + 1 < first.size() ? first[candidate + 1] : records.size();
  const int room = std::min(static_cast<int>(end - slot), LargeBodyShape::max_contacts);
  if (ends && (last & ~known.continued & ((1U << known.count) - 1U))) {
    SurfaceContact far[LargeBodyShape::max_contacts];
    const int num_far = ends->look_further(far);
    for (int n = 0; n < num_far && left < room; n++) {
      const int best = far[n].overlap > 0.0 ? -1 : known.nearest(far[n].normal, last);
      if (best >= 0) go_on(far[n], best);
    }
  }
  counts[candidate] = static_cast<std::uint8_t>(left);
  return left;
}

double BodyHistory::memory_usage() const
{
  const auto bytes = [](const auto &v) { return static_cast<double>(v.capacity() * sizeof v[0]); };
  return bytes(entry_of) + bytes(first) + bytes(counts) + bytes(records) + bytes(impacts) +
         bytes(normals) + bytes(touching);
}

}    // namespace Talus
