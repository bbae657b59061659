// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// From records to the lanes of a batch, and back. Four records of four numbers are a matrix that is
// transposed.

#include "contact/contact_chunk.h"

#include "base/lanes.h"
#include "laws/intersection_radius.h"

#include <algorithm>
#include <cmath>

namespace Talus {
namespace {

const Vec4 difference_and_sum = four(-1.0, -1.0, -1.0, 1.0), ones = four(1.0, 1.0, 1.0, 1.0);
using Lane = double[ContactBatch::width];

/// Histories that are prefetched while others are gathered; they are stored nearly in the order of
/// their use. Prefetching beyond the end does no harm.
constexpr std::size_t histories_ahead = 128;

TALUS_INLINE void prefetch_two_lines(const Record *records)
{
  __builtin_prefetch(records, 1);
  __builtin_prefetch(records + 2, 1);
}

/// r w and 1/r of a omega record, with the position record of the particle.
inline Vec4 surface_velocity(Vec4 position, Vec4 omega)
{
  return shuffle<3, 3, 3, 4>(position, ones) * omega;
}

}    // namespace

/* Particles pass through memory while contacts are computed, not all at once where they are moved:
   two for every four contacts, of which settled beds have about as many. */

void ContactChunk::prefetch_own(const ParticleRecords &particles)
{
  if (to_prefetch.begin + 1 >= to_prefetch.end) return;
  particles.prefetch_two_early(to_prefetch.begin);
  to_prefetch.begin += 2;
}

/* Geometry and kinematics of the block. The sums of records give everything but the normal. */

template <bool friction, bool history_kept, bool changes>
void ContactChunk::gather(const Step &step, int end)
{
  const ParticleRecords &particles = step.particles;
  constexpr std::size_t stride = friction ? 2 : 1;
  const Record *x = particles.position.data(), *motion = particles.motion.data();
  const ChangeRecord *change = particles.change.data();
  const Record *h = history.all_records();
  const std::uint32_t *place = history.all_places();

  const int *first = pairs.state_of_first(), *second = pairs.second.data();

  for (int k = 0; k < end; k += 4) {
    prefetch_own(particles);
    Vec4 a[4], b[4], c[4], d[4];
    Float8 e[4];
    for (int q = 0; q < 4; q++) {
      const std::uint32_t pair = pair_of_lane[k + q];
      const int i = first[pair], j = second[pair];
      const Record *mi = motion + stride * i, *mj = motion + stride * j;
      const Vec4 xi = load4(x[i]), xj = load4(x[j]);
      a[q] = xi + difference_and_sum * xj;
      b[q] = load4(mi[0]) + difference_and_sum * load4(mj[0]);
      if constexpr (friction)
        c[q] = surface_velocity(xi, load4(mi[1])) + surface_velocity(xj, load4(mj[1]));
      if constexpr (!friction) batch.inverse_radius[k + q] = x[i].c[3] * x[j].c[3];
      if constexpr (history_kept) d[q] = load4(h[place[pair]]);
      if constexpr (changes)
        e[q] = step.weight_of_changes * change_of_contact(change[i], change[j]);
    }
    if constexpr (history_kept) prefetch_two_lines(h + place[pair_of_lane[k]] + histories_ahead);
    to_lanes(a, batch.normal, batch.overlap, k);
    to_lanes(b, batch.velocity, batch.inverse_mass, k);
    if constexpr (friction) to_lanes(c, batch.surface_rotation, batch.inverse_radius, k);
    if constexpr (history_kept) to_lanes(d, batch.history, batch.history[3], k);
    if constexpr (changes) to_lanes(e, batch.velocity_change, batch.rotation_change, k);
  }
}

void ContactChunk::gather_further_histories(const ContactScene &scene, int end)
{
  const std::uint32_t *place = history.all_places();
  for (int n = 1; n < scene.history_records; n++) {
    const Record *h = history.all_records(n);
    for (int k = 0; k < end; k += 4) {
      Vec4 row[4];
      for (int q = 0; q < 4; q++) row[q] = load4(h[place[pair_of_lane[k + q]]]);
      prefetch_two_lines(h + place[pair_of_lane[k]] + histories_ahead);
      to_lanes(row, batch.history + 4L * n, batch.history[4 * n + 3], k);
    }
  }
}

/* Of the particles themselves, not of copies: no step is taken in the records. */

void ContactChunk::gather_temperatures(const double *temperature, int end)
{
  const std::vector<int> &atom = pairs.order().atom_of_slot;
  for (int k = 0; k < end; k++) {
    const std::uint32_t pair = pair_of_lane[k];
    batch.temperature_difference[k] =
        temperature[atom[pairs.second[pair]]] - temperature[atom[pairs.first[pair]]];
  }
}

/* From separation and sum of radii to normal and overlap. Without omega records the lanes of the
   inverse radius still hold the product of the radii. The overlap over the effective radius, which is
   at most the smaller one, tells whether some contact may be deeper than all before. */

void ContactChunk::finish_geometry(const ParticleRecords &particles, int end, bool radii_known)
{
  const Vec8 zero = splat<Vec8>(0.0), one = splat<Vec8>(1.0);
  Vec8 deepest_here = zero;
  for (int k = 0; k < end; k += lanes) {
    const Vector3<Vec8> separation{load8(&batch.normal[0][k]), load8(&batch.normal[1][k]),
                                   load8(&batch.normal[2][k])};
    const Vec8 sum_of_radii = load8(&batch.overlap[k]);
    const Vec8 distance = square_root(dot(separation, separation));
    const auto apart = distance > zero;    // coincident centers have no normal and get no force
    const Vec8 inverse = select(apart, one / distance, zero);
    const Vector3<Vec8> normal = inverse * separation;
    store(&batch.inverse_distance[k], inverse);
    store(&batch.normal[0][k], normal.x);
    store(&batch.normal[1][k], normal.y);
    store(&batch.normal[2][k], normal.z);
    const Vec8 overlap = sum_of_radii - distance;
    store(&batch.overlap[k], select(apart, overlap, zero));
    if (!radii_known)
      store(&batch.inverse_radius[k], sum_of_radii / load8(&batch.inverse_radius[k]));
    const Vec8 ratio = overlap * load8(&batch.inverse_radius[k]);
    deepest_here = select(ratio > deepest_here, ratio, deepest_here);
  }
  if (any(deepest_here > deepest.overlap_ratio)) notice_deeper(particles, end);
}

void ContactChunk::notice_deeper(const ParticleRecords &particles, int end)
{
  const std::vector<int> &atom = pairs.order().atom_of_slot;
  const int *state = pairs.state_of_first();
  for (int k = 0; k < end; k++) {
    if (!(batch.overlap[k] * batch.inverse_radius[k] > deepest.overlap_ratio)) continue;
    const std::uint32_t pair = pair_of_lane[k];
    const int j = pairs.second[pair];
    const Record &a = particles.position[state[pair]], &b = particles.position[j];
    const double distance = std::hypot(a.c[0] - b.c[0], a.c[1] - b.c[1], a.c[2] - b.c[2]);
    const double ratio = (a.c[3] + b.c[3] - distance) / std::min(a.c[3], b.c[3]);
    if (ratio > deepest.overlap_ratio) deepest = {ratio, atom[pairs.first[pair]], atom[j]};
  }
}

/* What only laws read that write twisting torques: how lever arms that end in the middle of the
   overlap differ from radii; with resistance also omega_i - omega_j and the circle in which the
   surfaces intersect. */

void ContactChunk::gather_for_twisting(const Step &step, int end, bool resistance)
{
  const ParticleRecords &particles = step.particles;
  const Record *x = particles.position.data();
  const int *first = pairs.state_of_first(), *second = pairs.second.data();
  for (int k = 0; k < end; k++) {
    const std::uint32_t pair = pair_of_lane[k];
    first_radius[k] = x[first[pair]].c[3];
    second_radius[k] = x[second[pair]].c[3];
  }
  for (int k = 0; k < end; k += lanes) {
    const Vec8 ri = load8(&first_radius[k]), rj = load8(&second_radius[k]),
               overlap = load8(&batch.overlap[k]), loss = overlap / (ri + rj);
    store(&batch.arm_loss[k], loss);
    store(&batch.arm_difference[k], 0.5 * loss * (rj - ri));
    if (resistance) store(&batch.intersection_radius[k], intersection_radius_of(ri, rj, overlap));
  }
  if (!resistance) return;
  const auto relative_omega = [&](int lane) {
    const std::uint32_t pair = pair_of_lane[lane];
    return load4(particles.omega(first[pair])) - load4(particles.omega(second[pair]));
  };
  for (int k = 0; k < end; k += 4) {
    Vec4 row[4];
    for (int q = 0; q < 4; q++) row[q] = relative_omega(k + q);
    to_lanes(row, batch.relative_omega, nullptr, k);
  }
  if (step.weight_of_changes == 0.0F) return;
  for (int k = 0; k < end; k++) {
    const std::uint32_t pair = pair_of_lane[k];
    const ChangeRecord &i = particles.change[first[pair]], &j = particles.change[second[pair]];
    for (int d = 0; d < 3; d++)
      batch.omega_change[d][k] =
          step.weight_of_changes * (i.c[4 + d] / first_radius[k] - j.c[4 + d] / second_radius[k]);
  }
}

/* Copies of a contact hold the same result, so writing them twice does no harm. */

void ContactChunk::keep_history(const ContactScene &scene, int end)
{
  const std::uint32_t *place = history.all_places();
  for (int n = 0; n < scene.history_records; n++) {
    Record *h = history.all_records(n);
    for (int k = 0; k < end; k += 4)
      to_rows(batch.history + 4L * n, batch.history[4 * n + 3], k,
              [=](int q) -> Record & { return h[place[pair_of_lane[k + q]]]; });
  }
}

template <bool friction> void ContactChunk::transpose_results(int end, const ContactScene &scene)
{
  const auto rows_of = [](const Lane *vector, const double *fourth, int k, Record *records) {
    to_rows(vector, fourth, k, [=](int q) -> Record & { return records[k + q]; });
  };
  for (int k = 0; k < end; k += 4) {
    rows_of(batch.force, nullptr, k, force_of_lane);
    if constexpr (friction) rows_of(batch.torque_per_radius, nullptr, k, torque_per_radius_of_lane);
    if (scene.with_twisting) rows_of(batch.twisting_torque, nullptr, k, twisting_of_lane);
  }
}

template void ContactChunk::gather<true, true, true>(const Step &, int);
template void ContactChunk::gather<true, true, false>(const Step &, int);
template void ContactChunk::gather<true, false, true>(const Step &, int);
template void ContactChunk::gather<true, false, false>(const Step &, int);
template void ContactChunk::gather<false, false, true>(const Step &, int);
template void ContactChunk::gather<false, false, false>(const Step &, int);
template void ContactChunk::transpose_results<true>(int, const ContactScene &);
template void ContactChunk::transpose_results<false>(int, const ContactScene &);

}    // namespace Talus
