// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "contact/contact_chunk.h"

#include "contact/narrow_phase.h"
#include "laws/change_of_order.h"
#include "laws/tangential/end_of_contact.h"
#include "material/run_laws.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <numeric>

namespace Talus {

static void clear_lanes(double (*vector)[ContactBatch::width], int begin, int end)
{
  for (int d = 0; d < 3; d++) std::fill(vector[d] + begin, vector[d] + end, 0.0);
}

ContactChunk::ContactChunk()
{
  batch.clear();
}

void ContactChunk::start_pairs(const ContactScene &scene, const HistoryStore &histories)
{
  // the contacts of each law fill whole vectors of the batch: leave room for the gaps
  std::iota(std::begin(lane_of_contact), std::end(lane_of_contact), 0);
  const int laws = scene.laws.num_laws(), gaps = laws > 1 ? (lanes - 1) * laws : 0;
  block_size = std::max(lanes, (ContactBatch::width - gaps) / lanes * lanes);
  if (scene.with_history)
    history.fetch(pairs, histories);
  else
    history.release();
  touching = 0;
  limits_are_known = false;
  deepest = {DeepestContact::watched};
}

void ContactChunk::change_order(int order, const std::function<const ContactLaw &(int, int)> &law)
{
  const std::int64_t count = history.is_kept() ? pairs.num_pairs() : 0;
  for (std::int64_t n = 0; n < count; n++)
    if (history.touches(n)) {
      HistoryValues values = history.values(n);
      Talus::change_order(law(pairs.first[n], pairs.second[n]), order, values);
      history.set_values(n, values);
    }
}

void ContactChunk::exchange_contacts(StateExchange &x)
{
  x(touching);
  if (x.restores()) {
    renew(contacts, pairs.num_pairs() + lanes);
    deepest = {DeepestContact::watched};
  }
  x.array(contacts.data(), touching);
}

void ContactChunk::forget_contacts()
{
  touching = 0;
  release(contacts);
  release(limits);
}

void ContactChunk::compute(const ContactScene &scene, ParticleRecords &particles,
                           const ContactStep &how, const Load &load, const Frontier &frontier)
{
  const Step step{how, scene, particles, load, frontier};
  const std::size_t room = pairs.num_pairs() + lanes;    // the narrow phase stores a few ahead
  if (contacts.size() != room) renew(contacts, room);
  later_tallies.clear();
  tallied = 0;
  flows.clear();
  chunk_work = EnergyByCause{};
  chunk_virial = VirialSums{};
  work_left.clear();
  if (step.weight_of_changes == 0.0F) clear_changes();
  if (scene.with_history)
    compute_all<true, true>(step);
  else if (scene.with_friction)
    compute_all<true, false>(step);
  else
    compute_all<false, false>(step);
  if (pairs.is_late()) tally_early_before(std::numeric_limits<int>::max(), 0, step);
  if (!pairs.foreign.empty()) streams_are_done();
}

/* Only gather() writes them. */

void ContactChunk::clear_changes()
{
  if (changes_are_clear) return;
  for (auto *vector : {batch.velocity_change, batch.rotation_change, batch.omega_change})
    clear_lanes(vector, 0, ContactBatch::width);
  changes_are_clear = true;
}

/* Particles are loaded, pairs tested and forces computed stretch by stretch, all in ascending
   order of the second particle: memory is read straight ahead, and first particles, but for the
   distant ones, are still in the cache. */

template <bool friction, bool history_kept> void ContactChunk::compute_all(const Step &step)
{
  constexpr std::int64_t stretch = 8L * ContactBatch::width, between_calls = 16 * stretch;
  constexpr int slots_ahead = 512;    // as many as are loaded with some stretches
  const std::int64_t candidates = pairs.num_pairs();
  const Record *position = step.particles.position.data();
  SlotRange to_load = pairs.is_late() ? SlotRange{} : pairs.slots();
  to_prefetch = {to_load.begin, to_load.begin};
  std::size_t next_distant = 0;
  std::int64_t done = 0;
  touching = 0;
  const auto ask = [&](std::int64_t pair, unsigned ended) { return lasting(step, pair, ended); };
  const BeyondTouch::Lasts lasts = std::cref(ask);    // needs no memory
  const bool asks = step.scene.second_order || step.scene.liquid.any();
  make_room_for_limits(step);
  const BeyondTouch beyond{limits.empty() ? nullptr : limits.data(), asks ? &lasts : nullptr};
  for (std::int64_t begin = 0; begin < candidates; begin += stretch) {
    const std::int64_t end = std::min(candidates, begin + stretch);
    if (step.progress && begin % between_calls == 0) (*step.progress)();
    prefetch_distant(step.particles, next_distant, end + stretch);
    const int needed = std::min(pairs.second[end - 1] + 1, to_load.end);
    if (needed > to_load.begin) step.load(to_load.begin, needed);
    to_load.begin = std::max(to_load.begin, needed);
    const int ahead = std::min(slots_ahead, to_load.end - to_load.begin);
    to_prefetch = {std::max(to_prefetch.begin, to_load.begin), to_load.begin + ahead};
    if (!limits_are_known) find_limits(step, begin, end);
    touching += find_contacts(pairs, begin, end, position, history_kept ? &history : nullptr,
                              &contacts[touching], beyond);
    for (; touching - done >= block_size; done += block_size)
      compute_block<friction, history_kept>(step, done, block_size);
  }
  limits_are_known = true;
  if (done < touching)
    compute_block<friction, history_kept>(step, done, static_cast<int>(touching - done));
  if (to_load.begin < to_load.end) step.load(to_load.begin, to_load.end);
}

/* Prefetches the distant particles of pairs before `end`. */

void ContactChunk::prefetch_distant(const ParticleRecords &particles, std::size_t &next,
                                    std::int64_t end) const
{
  for (; next < pairs.distant.size() && pairs.distant[next].pair < end; next++) {
    const std::size_t s = pairs.distant[next].slot;
    __builtin_prefetch(&particles.position[s]);
    __builtin_prefetch(&particles.motion[particles.stride * s]);
    if (particles.keeps_changes()) __builtin_prefetch(&particles.change[s]);
    // nothing is added to copies
    if (s < static_cast<std::size_t>(pairs.order().size()))
      __builtin_prefetch(&particles.load[particles.stride * s]);
  }
}

template <bool friction, bool history_kept>
void ContactChunk::compute_block(const Step &step, std::int64_t begin, int count)
{
  const std::uint32_t *block = &contacts[begin];
  const ContactScene &scene = step.scene;
  const int end = arrange(scene, block, count);
  changes_are_clear = step.weight_of_changes == 0.0F;
  if (step.weight_of_changes > 0.0F)
    gather<friction, history_kept, true>(step, end);
  else
    gather<friction, history_kept, false>(step, end);
  if (scene.history_records > 1) gather_further_histories(scene, end);
  finish_geometry(step.particles, end, friction);
  if (scene.with_twisting) gather_for_twisting(step, end, scene.with_resistance || step.account);
  if (scene.with_heat) gather_temperatures(step.temperature, end);
  if (scene.liquid.any()) find_bridge_volumes(step, end);
  run_kernels(step);
  if (history_kept && step.advance) keep_history(scene, end);
  transpose_results<friction>(end, scene);
  if (pairs.weighted()) apply_weights(end);
  if (!pairs.is_late()) {
    add_up<friction>(step, block, count);
    if (scene.with_twisting) add_twisting_torques(step.particles, block, count);
    if (scene.with_heat) add_heat(step.particles, block, count);
  }
  defer(step, block, count);
  if (step.virial) add_virial(block, count);
  if (step.tally) tally_block(step, block, count);
  if (step.account) account_block(step, block, count);
}

void ContactChunk::give_lane(std::uint32_t contact, int position, int lane)
{
  pair_of_lane[lane] = contact;
  lane_of_contact[position] = lane;
}

/* Gives every contact of a block a lane. Contacts of one law stand together, and the last vector of
   each law is filled up with copies of its last contact, which are computed but not added. Returns
   the number of lanes in use, a multiple of `lanes`. */

int ContactChunk::arrange(const ContactScene &scene, const std::uint32_t *contacts, int count)
{
  const LawTable &laws = scene.laws;
  ranges.clear();
  int lane = 0;
  const auto close_range = [&](int law, int begin) {
    const int used = lane;
    for (; lane % lanes; lane++) pair_of_lane[lane] = pair_of_lane[lane - 1];
    if (lane > begin) ranges.push_back({law, begin, used, lane});
  };

  if (laws.num_laws() == 1) {    // lanes are those of start_pairs()
    std::copy(contacts, contacts + count, pair_of_lane);
    lane = count;
    close_range(0, 0);
  }

  for (int law = 0; laws.num_laws() > 1 && law < laws.num_laws(); law++) {
    const int begin = lane;
    for (int k = 0; k < count; k++)
      if (laws.law_index(row_of_pair(scene, contacts[k])) == law) give_lane(contacts[k], k, lane++);
    close_range(law, begin);
  }

  if (!laws.uniform())
    for (int k = 0; k < lane; k++) batch.coefficients[k] = row_of_pair(scene, pair_of_lane[k]);
  return lane;
}

void ContactChunk::run_kernels(const Step &step)
{
  const LawTable &laws = step.scene.laws;
  batch.lag = step.lag;
  for (const LawRange &range : ranges) {
    run_laws(batch, range.law, range.begin, range.end, {laws, step.dt, step.advance, step.account});
    // not written by the kernels of laws that have none
    const ContactLaw &law = laws.distinct_law(range.law);
    if (step.scene.with_friction && !law.has_friction())
      clear_lanes(batch.torque_per_radius, range.begin, range.end);
    if (step.scene.with_twisting && !law.twists())
      clear_lanes(batch.twisting_torque, range.begin, range.end);
    if (step.scene.with_heat && !law.conducts_heat())
      std::fill(batch.heat_flow + range.begin, batch.heat_flow + range.end, 0.0);
  }
}

void ContactChunk::apply_weights(int end)
{
  for (int k = 0; k < end; k++) {
    const double weight = pairs.weights[pair_of_lane[k]];
    for (int d = 0; d < 3; d++) {
      force_of_lane[k].c[d] *= weight;
      torque_per_radius_of_lane[k].c[d] *= weight;
      twisting_of_lane[k].c[d] *= weight;
    }
  }
}

/* The contacts of one second particle follow each other, and nothing has been added to it before
   the first of them but its weight, if it has one: its sums stay in registers and are stored again
   and again, but not loaded. Sums of particles with late contacts are wrong here, and replaced when
   all have been computed. */

template <bool friction, bool one_law, bool weights>
void ContactChunk::add_up(ParticleRecords &particles, const std::uint32_t *block, int count)
{
  constexpr std::size_t stride = friction ? 2 : 1;
  static const Record not_used{};
  const int *first = pairs.first.data(), *second = pairs.second.data();
  Record *load = particles.load.data();
  int last = second[block[0]];    // may have begun in the last block
  const Record *begun = load + stride * last;
  Vec4 force = load4(begun[0]), torque_per_radius{};
  if constexpr (friction) torque_per_radius = load4(begun[1]);

  for (int n = 0; n < count; n++) {
    const std::uint32_t pair = block[n];
    const int a = first[pair], b = second[pair];
    Record *i = load + stride * a, *j = load + stride * b;
    const int lane = one_law ? n : lane_of_contact[n];
    const bool same = b == last, kept = !pairs.is_foreign(a);
    last = b;
    particles.has_acted(b);
    if (kept) particles.has_acted(a);
    const Vec4 f = load4(force_of_lane[lane]);
    if (kept) store(i[0], load4(i[0]) + f);
    if constexpr (weights)    // never waits for what the last turn has stored
      force = chosen(same, force, load4(*chosen(same, &not_used, j))) - f;
    else
      force = kept_if(same, force) - f;
    store(j[0], force);
    if constexpr (friction) {
      const Vec4 m = load4(torque_per_radius_of_lane[lane]);
      if (kept) store(i[1], load4(i[1]) + m);
      torque_per_radius = kept_if(same, torque_per_radius) + m;
      store(j[1], torque_per_radius);
    }
  }
}

template <bool friction>
void ContactChunk::add_up(const Step &step, const std::uint32_t *block, int count)
{
  ParticleRecords &particles = step.particles;
  const bool one_law = step.scene.laws.num_laws() == 1;
  if (particles.have_weights())
    one_law ? add_up<friction, true, true>(particles, block, count)
            : add_up<friction, false, true>(particles, block, count);
  else
    one_law ? add_up<friction, true, false>(particles, block, count)
            : add_up<friction, false, false>(particles, block, count);
}

void ContactChunk::add_twisting_torques(ParticleRecords &particles, const std::uint32_t *block,
                                        int count)
{
  for (int n = 0; n < count; n++) {
    const int first = pairs.first[block[n]];
    Record &i = particles.twisting_torque[first];
    Record &j = particles.twisting_torque[pairs.second[block[n]]];
    const Vec4 c = load4(twisting_of_lane[lane_of_contact[n]]);
    if (!pairs.is_foreign(first)) store(i, load4(i) + c);
    store(j, load4(j) - c);
  }
}

void ContactChunk::add_heat(ParticleRecords &particles, const std::uint32_t *block, int count)
{
  for (int n = 0; n < count; n++) {
    const int first = pairs.first[block[n]];
    const double flow = batch.heat_flow[lane_of_contact[n]];
    if (!pairs.is_foreign(first)) particles.heat_flow[first] += flow;
    particles.heat_flow[pairs.second[block[n]]] -= flow;
  }
}

/* Few blocks have pairs at the frontier. Which of their contacts are there is unpredictable: found
   for all of them first, without branches. */

void ContactChunk::defer(const Step &step, const std::uint32_t *block, int count)
{
  static_assert(ContactBatch::width <= 64, "one bit for each contact");
  if (!pairs.reaches_frontier(block[0], block[count - 1])) return;
  DeferredForces &forces = *step.frontier.forces;
  std::uint64_t at_frontier = 0;
  for (int n = 0; n < count; n++) at_frontier |= std::uint64_t{pairs.is_at_frontier(block[n])} << n;
  for (; at_frontier; at_frontier &= at_frontier - 1) {
    const int n = __builtin_ctzll(at_frontier), lane = lane_of_contact[n];
    const std::uint32_t pair = block[n];
    forces.put(step.frontier.first_place + pairs.frontier_before(pair),
               pairs.is_foreign(pairs.first[pair]),
               {load4(force_of_lane[lane]), load4(torque_per_radius_of_lane[lane]),
                load4(twisting_of_lane[lane]), batch.heat_flow[lane]});
  }
}

double ContactChunk::memory_usage() const
{
  return pairs.memory_usage() + history.memory_usage() +
         static_cast<double>(contacts.capacity() * sizeof(std::uint32_t) +
                             limits.capacity() * sizeof(double));
}

}    // namespace Talus
