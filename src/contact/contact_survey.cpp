// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "contact/contact_survey.h"

#include "base/in_parallel.h"
#include "contact/state_of_pair.h"
#include "laws/intersection_radius.h"

#include <algorithm>
#include <cmath>

namespace Talus {

/* Nothing but heat passes between these. */

bool ContactSurvey::is_gap(const ContactChunk &chunk, std::int64_t pair) const
{
  return of.scene.laws.law(chunk.row_of_pair(of.scene, pair)).reaches() &&
         !(overlap_of(chunk.pairs.first[pair], chunk.pairs.second[pair]) > 0.0);
}

double ContactSurvey::count_contacts() const
{
  double count = 0.0;
  for (const ContactChunk &chunk : of.chunks)
    chunk.for_each_contact([&](std::int64_t pair) {
      if (!is_gap(chunk, pair))
        count += of.order.share(chunk.pairs.first[pair], chunk.pairs.second[pair]);
    });
  return count;
}

double ContactSurvey::count_candidates() const
{
  double count = 0.0;
  for (const ContactChunk &chunk : of.chunks)
    for (std::int64_t c = 0; c < chunk.pairs.num_pairs(); c++)
      count += of.order.share(chunk.pairs.first[c], chunk.pairs.second[c]);
  return count;
}

double ContactSurvey::early_share() const
{
  if (!of.in_two_phases()) return 0.0;
  std::int64_t early = 0, all = 0;
  for (const ContactChunk &chunk : of.chunks) {
    all += chunk.pairs.num_pairs();
    if (!chunk.pairs.is_late()) early += chunk.pairs.num_pairs();
  }
  return all ? static_cast<double>(early) / static_cast<double>(all) : 0.0;
}

std::optional<HistoryValues> ContactSurvey::history_of(int i, int j) const
{
  if (!of.scene.with_history || std::max(i, j) >= of.num_particles()) return std::nullopt;
  const int a = of.order.slot_of_atom[i], b = of.order.slot_of_atom[j];
  const ContactChunk &chunk = of.chunks[of.work.chunk_with_pair(std::min(a, b), std::max(a, b))];
  const std::int64_t pair = chunk.pairs.find(a, b);
  if (pair < 0 || !chunk.history.touches(pair)) return std::nullopt;
  const HistoryValues stored = chunk.history.values(pair);
  return a < b ? stored : mirrored(stored);
}

/* Rolling and twisting as in ContactChunk::gather_for_twisting(). */

ContactReport ContactSurvey::report_of(const ContactChunk &chunk, std::int64_t pair,
                                       ContactData requested) const
{
  const int i = chunk.pairs.first[pair], j = chunk.pairs.second[pair];
  const Record &xi = of.particles.position[i], &xj = of.particles.position[j];
  const Record &vi = of.particles.velocity(i), &vj = of.particles.velocity(j);
  const auto three = [](const Record &r) { return Vector3<double>{r.c[0], r.c[1], r.c[2]}; };
  const Vector3<double> separation = three(xi) - three(xj);
  const double ri = xi.c[3], rj = xj.c[3], distance = length(separation);
  ContactState<double> s;
  s.inverse_distance = distance > 0.0 ? 1.0 / distance : 0.0;
  s.normal = s.inverse_distance * separation;
  s.overlap = distance > 0.0 ? ri + rj - distance : 0.0;
  s.velocity = three(vi) - three(vj);
  s.inverse_mass = vi.c[3] + vj.c[3];
  s.inverse_radius = 1.0 / ri + 1.0 / rj;
  if (of.scene.with_friction) {
    const Vector3<double> wi = three(of.particles.omega(i)), wj = three(of.particles.omega(j));
    s.surface_rotation = ri * wi + rj * wj;
    s.relative_omega = wi - wj;
  }
  if (of.particles.keeps_changes()) {
    s.lag = of.lag;
    set_changes(s, of.particles.change[i], of.particles.change[j], ri, rj);
  }
  s.arm_loss = s.overlap / (ri + rj);
  s.arm_difference = 0.5 * s.arm_loss * (rj - ri);
  s.intersection_radius = intersection_radius_of(ri, rj, s.overlap);

  HistoryValues history{};
  if (of.scene.with_history && chunk.history.touches(pair)) history = chunk.history.values(pair);
  ContactReport found;
  found.i = of.order.atom_of_slot[i];
  found.j = of.order.atom_of_slot[j];
  found.share = of.order.share(i, j);
  found.center[0] = three(xi);
  found.center[1] = three(xj);
  found.normal = s.normal;
  found.overlap = s.overlap;
  const int row = chunk.row_of_pair(of.scene, pair);
  report_contact(of.scene.laws.law(row), of.scene.laws.coefficients(row), s, of.dt, history,
                 requested, found);
  found.set_arms_of_spheres(ri, rj);
  return found;
}

void ContactSurvey::for_each_contact(ContactData requested, const VisitContact &visit) const
{
  if (!of.pairs_known) return;
  for (const ContactChunk &chunk : of.chunks)
    chunk.for_each_contact([&](std::int64_t pair) {
      if (!is_gap(chunk, pair)) visit(report_of(chunk, pair, requested));
    });
}

double ContactSurvey::squared_distance(int slot_a, int slot_b) const
{
  const double *a = of.particles.position[slot_a].c, *b = of.particles.position[slot_b].c;
  const double dx = a[0] - b[0], dy = a[1] - b[1], dz = a[2] - b[2];
  return dx * dx + dy * dy + dz * dz;
}

double ContactSurvey::overlap_of(int slot_a, int slot_b) const
{
  return of.particles.position[slot_a].c[3] + of.particles.position[slot_b].c[3] -
         std::sqrt(squared_distance(slot_a, slot_b));
}

/* The largest result(chunk) of all of.chunks, which are asked at the same time; of equal ones the
   first. */

template <class Value, class Result>
Value ContactSurvey::largest_of_chunks(Value none, Result result) const
{
  std::vector<Value> found(of.chunks.size(), none);
  in_parallel(static_cast<int>(of.chunks.size()), of.threads,
              [&](int c) { found[c] = result(of.chunks[c]); });
  for (const Value &one : found)
    if (none < one) none = one;
  return none;
}

DeepestContact ContactSurvey::deepest_contact() const
{
  return largest_of_chunks(DeepestContact{}, [this](const ContactChunk &chunk) {
    DeepestContact deepest;
    chunk.for_each_contact([&](std::int64_t pair) {
      const int i = chunk.pairs.first[pair], j = chunk.pairs.second[pair];
      const double ri = of.particles.position[i].c[3], rj = of.particles.position[j].c[3];
      // neither root nor quotient for those that are less deep beyond doubt
      constexpr double beyond_rounding = 1.0 + 1.0e-9;
      const double smaller = std::min(ri, rj), near = ri + rj - deepest.overlap_ratio * smaller;
      if (squared_distance(i, j) > near * near * beyond_rounding) return;
      const double ratio = overlap_of(i, j) / smaller;
      if (ratio > deepest.overlap_ratio)
        deepest = {ratio, of.order.atom_of_slot[i], of.order.atom_of_slot[j]};
    });
    return deepest;
  });
}

DeepestContact ContactSurvey::deepest_since_rebuild() const
{
  DeepestContact deepest{DeepestContact::watched};
  for (const ContactChunk &chunk : of.chunks)
    deepest = std::max(deepest, chunk.deepest_since_start());
  return deepest;
}

double ContactSurvey::smallest_contact_period() const
{
  // the largest of the inverse squares
  const double largest = largest_of_chunks(0.0, [this](const ContactChunk &chunk) {
    double of_chunk = 0.0;
    chunk.for_each_contact([&](std::int64_t pair) {
      const int i = chunk.pairs.first[pair], j = chunk.pairs.second[pair],
                row = of.scene.row_of(i, j);
      const double inverse_mass = of.particles.velocity(i).c[3] + of.particles.velocity(j).c[3];
      if (!(inverse_mass > 0.0)) return;
      const double ri = of.particles.position[i].c[3], rj = of.particles.position[j].c[3];
      const double k = tangent_stiffness(of.scene.laws.law(row), of.scene.laws.coefficients(row),
                                         overlap_of(i, j), 1.0 / inverse_mass, ri * rj / (ri + rj));
      if (k > 0.0) of_chunk = std::max(of_chunk, inverse_mass * k);
    });
    return of_chunk;
  });
  return largest > 0.0 ? std::sqrt(1.0 / largest) : 0.0;
}

double ContactSurvey::largest_relative_speed() const
{
  return std::sqrt(largest_of_chunks(0.0, [this](const ContactChunk &chunk) {
    double largest = 0.0;
    for (std::int64_t c = 0; c < chunk.pairs.num_pairs(); c++) {
      const double *a = of.particles.velocity(chunk.pairs.first[c]).c,
                   *b = of.particles.velocity(chunk.pairs.second[c]).c;
      const double dx = a[0] - b[0], dy = a[1] - b[1], dz = a[2] - b[2];
      largest = std::max(largest, dx * dx + dy * dy + dz * dz);
    }
    return largest;
  }));
}

}    // namespace Talus
