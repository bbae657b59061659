// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// From records to the lanes of a batch, and back: eight contacts at a time. Lanes k ... k+7 are
// those of the contacts k ... k+3 in the lower and k+4 ... k+7 in the upper halves of four vectors,
// so that each half is a matrix of four records to transpose.

#include "contact/contact_part.h"

#include "contact/resistance.h"

#include <algorithm>

namespace Talus {
namespace {

static_assert(lanes == 8, "two matrices of four records");
constexpr Vec8 difference_and_sum{-1.0, -1.0, -1.0, 1.0, -1.0, -1.0, -1.0, 1.0};
constexpr Vec4 ones{1.0, 1.0, 1.0, 1.0};
using Lanes = double[3][ContactBatch::width];

/// Eight records become lanes k ... k+7 of a vector and of a scalar.
inline void spread(Vec8 *rows, Lanes &vector, double *fourth, int k)
{
  transpose(rows[0], rows[1], rows[2], rows[3]);
  for (int q = 0; q < 3; q++) store(&vector[q][k], rows[q]);
  if (fourth) store(&fourth[k], rows[3]);
}

/// Lanes k ... k+7 become the eight records where(0) ... where(7).
template <class Where>
inline void to_records(const Lanes &vector, const double *fourth, int k, Where where)
{
  Vec8 rows[4];
  for (int q = 0; q < 3; q++) rows[q] = load8(&vector[q][k]);
  rows[3] = fourth ? load8(&fourth[k]) : Vec8{};
  transpose(rows[0], rows[1], rows[2], rows[3]);
  for (int q = 0; q < 4; q++) {
    store(where(q), lower_half(rows[q]));
    store(where(q + 4), upper_half(rows[q]));
  }
}

/// r w and 1/r of a spin record, with the position record of the particle.
inline Vec4 surface_velocity(Vec4 position, Vec4 spin)
{
  return __builtin_shufflevector(position, ones, 3, 3, 3, 4) * spin;
}

}    // namespace

/* Geometry and kinematics of the block. The sums of records give everything but the normal. */

template <bool friction, bool history_kept>
void ContactPart::gather(const ParticleRecords &particles, int end)
{
  constexpr std::size_t stride = friction ? 2 : 1;
  const Record *x = particles.position.data(), *motion = particles.motion.data();
  const Record *h = history.records.data();

  for (int k = 0; k < end; k += lanes) {
    Vec8 a[4], b[4], c[4], d[4];
    for (int q = 0; q < 4; q++) {
      const std::uint32_t pair[2] = {pair_of_lane[k + q], pair_of_lane[k + q + 4]};
      const std::size_t i[2] = {static_cast<std::size_t>(pairs.first[pair[0]]),
                                static_cast<std::size_t>(pairs.first[pair[1]])};
      const std::size_t j[2] = {static_cast<std::size_t>(pairs.second[pair[0]]),
                                static_cast<std::size_t>(pairs.second[pair[1]])};
      const Vec8 xi = join(load4(x[i[0]]), load4(x[i[1]]));
      const Vec8 xj = join(load4(x[j[0]]), load4(x[j[1]]));
      const auto two = [&](const std::size_t *of) {
        return join(load4(motion[stride * of[0]]), load4(motion[stride * of[1]]));
      };
      a[q] = xi + difference_and_sum * xj;
      b[q] = two(i) + difference_and_sum * two(j);
      if constexpr (friction) {
        const auto surfaces = [&](const std::size_t *of) {
          return join(surface_velocity(load4(x[of[0]]), load4(motion[2 * of[0] + 1])),
                      surface_velocity(load4(x[of[1]]), load4(motion[2 * of[1] + 1])));
        };
        c[q] = surfaces(i) + surfaces(j);
      } else
        for (int half = 0; half < 2; half++)
          batch.inverse_radius[k + q + 4 * half] = x[i[half]].c[3] * x[j[half]].c[3];
      if constexpr (history_kept) d[q] = join(load4(h[pair[0]]), load4(h[pair[1]]));
    }
    spread(a, batch.normal, batch.overlap, k);
    spread(b, batch.velocity, batch.inverse_mass, k);
    if constexpr (friction) spread(c, batch.spin, batch.inverse_radius, k);
    if constexpr (history_kept) spread(d, batch.displacement, batch.at_limit, k);
  }
}

void ContactPart::gather_onsets(int end)
{
  const auto onset = [this](int lane) { return load4(history.onsets[pair_of_lane[lane]]); };
  for (int k = 0; k < end; k += lanes) {
    Vec8 row[4];
    for (int q = 0; q < 4; q++) row[q] = join(onset(k + q), onset(k + q + 4));
    spread(row, batch.onset, nullptr, k);
  }
}

/* From separation and sum of radii to normal and overlap. Without spin records the lanes of the
   inverse radius still hold the product of the radii. */

void ContactPart::finish_geometry(int end, bool radii_known)
{
  const Vec8 zero = splat<Vec8>(0.0), one = splat<Vec8>(1.0);
  for (int k = 0; k < end; k += lanes) {
    const Vector3<Vec8> separation{load8(&batch.normal[0][k]), load8(&batch.normal[1][k]),
                                   load8(&batch.normal[2][k])};
    const Vec8 sum_of_radii = load8(&batch.overlap[k]);
    const Vec8 distance = square_root(dot(separation, separation));
    const auto apart = distance > zero;    // coincident centres have no normal and get no force
    const Vec8 inverse = select(apart, one / distance, zero);
    const Vector3<Vec8> normal = inverse * separation;
    store(&batch.inverse_distance[k], inverse);
    store(&batch.normal[0][k], normal.x);
    store(&batch.normal[1][k], normal.y);
    store(&batch.normal[2][k], normal.z);
    store(&batch.overlap[k], select(apart, sum_of_radii - distance, zero));
    if (!radii_known)
      store(&batch.inverse_radius[k], sum_of_radii / load8(&batch.inverse_radius[k]));
  }
}

/* What only laws with resistance read: omega_i - omega_j and the circle in which the surfaces
 * intersect. */

void ContactPart::gather_resistance(const ParticleRecords &particles, int end)
{
  const Record *x = particles.position.data();
  const auto relative_spin = [&](int lane) {
    const std::uint32_t pair = pair_of_lane[lane];
    const int i = pairs.first[pair], j = pairs.second[pair];
    batch.circle[lane] = x[i].c[3];
    second_radius[lane] = x[j].c[3];
    return load4(particles.spin(i)) - load4(particles.spin(j));
  };
  for (int k = 0; k < end; k += lanes) {
    Vec8 row[4];
    for (int q = 0; q < 4; q++) row[q] = join(relative_spin(k + q), relative_spin(k + q + 4));
    spread(row, batch.relative_spin, nullptr, k);
    store(&batch.circle[k],
          circle_of_intersection(load8(&batch.circle[k]), load8(&second_radius[k]),
                                 load8(&batch.overlap[k])));
  }
}

/* Copies of a contact hold the same result, so writing them twice does no harm. */

void ContactPart::keep_history(int end)
{
  for (int k = 0; k < end; k += lanes)
    to_records(batch.displacement, batch.at_limit, k,
               [this, k](int q) -> Record & { return history.records[pair_of_lane[k + q]]; });
}

void ContactPart::keep_onsets(int end)
{
  for (int k = 0; k < end; k += lanes)
    to_records(batch.onset, nullptr, k,
               [this, k](int q) -> Record & { return history.onsets[pair_of_lane[k + q]]; });
}

template <bool friction> void ContactPart::transpose_results(int end, bool with_resistance)
{
  const auto rows_of = [](const Lanes &vector, int k, Record *records) {
    to_records(vector, nullptr, k, [=](int q) -> Record & { return records[k + q]; });
  };
  for (int k = 0; k < end; k += lanes) {
    rows_of(batch.force, k, force_of_lane);
    if constexpr (friction) rows_of(batch.moment, k, moment_of_lane);
    if (with_resistance) rows_of(batch.couple, k, couple_of_lane);
  }
}

template void ContactPart::gather<true, true>(const ParticleRecords &, int);
template void ContactPart::gather<true, false>(const ParticleRecords &, int);
template void ContactPart::gather<false, false>(const ParticleRecords &, int);
template void ContactPart::transpose_results<true>(int, bool);
template void ContactPart::transpose_results<false>(int, bool);

}    // namespace Talus
