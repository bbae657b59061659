// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// What a chunk tells of its contacts in steps in which somebody asks: forces one by one, and work.

#include "contact/contact_chunk.h"

#include <tuple>

namespace Talus {

namespace {
double sum_of(Vec8 lane)
{
  double sum = 0.0;
  for (int k = 0; k < lanes; k++) sum += lane[k];
  return sum;
}

}    // namespace

/* In two phases ends of particles with late contacts are reported in the late phase. */

void ContactChunk::tally_block(const Step &step, const std::uint32_t *block, int count)
{
  const ParticleOrder &order = pairs.order();
  for (int n = 0; n < count; n++) {
    const int i = pairs.first[block[n]], j = pairs.second[block[n]];
    TalliedContact out{order.atom_of_slot[i], order.atom_of_slot[j], true, true, {}, {}};
    for (int d = 0; d < 3; d++) {
      out.force[d] = force_of_lane[lane_of_contact[n]].c[d];
      out.separation[d] = step.particles.position[i].c[d] - step.particles.position[j].c[d];
    }
    if (pairs.is_late()) {
      tally_early_before(j, i, step);
    } else if (const bool i_later = pairs.has_late(i), j_later = pairs.has_late(j);
               i_later || j_later) {
      out.for_i = i_later;
      out.for_j = j_later;
      later_tallies.push_back({j, i, out});
      out.for_i = !i_later;
      out.for_j = !j_later;
    }
    if (out.for_i || out.for_j) (*step.tally)(out);
  }
}

/* Reports what the early chunk has left, of pairs before that one. */

void ContactChunk::tally_early_before(int second, int first, const Step &step)
{
  const std::vector<LaterTally> &left = step.frontier.early->later_tallies;
  for (; tallied < left.size(); tallied++) {
    const LaterTally &next = left[tallied];
    if (std::tie(next.second, next.first) >= std::tie(second, first)) return;
    (*step.tally)(next.contact);
  }
}

/* Lanes of copies count nothing. The separation is that of which the geometry has left its direction and length. */

void ContactChunk::add_virial(const std::uint32_t *block, int count)
{
  const ParticleOrder &order = pairs.order();
  alignas(64) double share[ContactBatch::width] = {};
  for (int n = 0; n < count; n++) {
    const std::uint32_t pair = block[n];
    share[lane_of_contact[n]] = (pairs.weighted() ? pairs.weights[pair] : 1.0) *
                                order.share(pairs.first[pair], pairs.second[pair]);
  }
  const Vec8 zero = splat<Vec8>(0.0), one = splat<Vec8>(1.0);
  const auto vector = [](const double(*rows)[ContactBatch::width], int k) {
    return Vector3<Vec8>{load8(&rows[0][k]), load8(&rows[1][k]), load8(&rows[2][k])};
  };
  for (int k = 0; k < ranges.back().end; k += lanes) {
    const Vec8 inverse = load8(&batch.inverse_distance[k]);
    const Vec8 distance = select(inverse > zero, one / inverse, zero);
    chunk_virial.add(vector(batch.force, k), load8(&share[k]) * distance * vector(batch.normal, k));
  }
}

/* Lanes of copies count nothing, and those of a contact with a ghost a half: the other rank has the
   other one. */

void ContactChunk::account_block(const Step &step, const std::uint32_t *block, int count)
{
  for (const LawRange &range : ranges)
    for (int lane = range.used; lane < range.end; lane++)
      for (auto &work : batch.work) work[lane] = 0.0;
  if (pairs.weighted())
    for (int n = 0; n < count; n++)
      for (auto &work : batch.work) work[lane_of_contact[n]] *= pairs.weights[block[n]];
  if (!step.account->by_particle.empty()) account_by_particle(step, block, count);
  const ParticleOrder &order = pairs.order();
  for (int n = 0; n < count && order.owned < order.size(); n++) {
    const double share = order.share(pairs.first[block[n]], pairs.second[block[n]]);
    for (auto &work : batch.work) work[lane_of_contact[n]] *= share;
  }
  Vec8 sum[ContactBatch::num_causes] = {};
  for (int k = 0; k < ranges.back().end; k += lanes)
    for (int n = 0; n < ContactBatch::num_causes; n++) sum[n] = sum[n] + load8(&batch.work[n][k]);
  chunk_work += EnergyByCause{sum_of(sum[0]), sum_of(sum[1]), sum_of(sum[2])};
}

/* Of an owned particle, all contacts are computed on its rank: no other one has a part. */

void ContactChunk::account_by_particle(const Step &step, const std::uint32_t *block, int count)
{
  const ParticleOrder &order = pairs.order();
  for (int n = 0; n < count; n++) {
    const int lane = lane_of_contact[n], first = pairs.first[block[n]];
    const int i = order.atom_of_slot[first], j = order.atom_of_slot[pairs.second[block[n]]];
    const EnergyByCause contact_work = work_of_lane(batch, lane);
    if (order.is_owned(j)) add_work(*step.account, j, contact_work, 0.5);
    if (!order.is_owned(i)) continue;
    if (pairs.is_foreign(first))
      work_left.push_back({i, contact_work});
    else
      add_work(*step.account, i, contact_work, 0.5);
  }
}

void ContactChunk::add_work_left(const WorkAccount &to) const
{
  for (const WorkLeft &left : work_left) add_work(to, left.atom, left.work, 0.5);
}

}    // namespace Talus
