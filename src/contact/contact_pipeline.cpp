// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "contact/contact_pipeline.h"

#include <algorithm>

namespace Talus {

ContactPipeline::ContactPipeline()
{
  batch.clear();
}

void ContactPipeline::set_laws(const LawTable &table)
{
  laws = table;
  with_friction = laws.has_friction();
  with_history = laws.has_history();
  with_onset = laws.has_onset();
  with_resistance = laws.has_resistance();
  // the contacts of each law fill whole vectors of the batch: leave room for the gaps
  const int gaps = laws.num_laws() > 1 ? (lanes - 1) * laws.num_laws() : 0;
  block_size = std::max(lanes, (ContactBatch::width - gaps) / lanes * lanes);
}

void ContactPipeline::start_pairs(const int *type, const PartnerLists &partners,
                                  const std::vector<std::int64_t> &filed_tag)
{
  slot_type.clear();
  if (!laws.uniform()) {
    slot_type.resize(pairs.num_particles());
    for (int s = 0; s < pairs.num_particles(); s++) slot_type[s] = type[pairs.atom_of_slot[s]];
  }
  if (with_history)
    history.fetch(pairs, partners, filed_tag);
  else
    history.release();
  touching_pairs = 0;
}

void ContactPipeline::file_history(PartnerLists &partners) const
{
  if (with_history)
    history.file(pairs, partners);
  else
    partners.begin();
}

void ContactPipeline::adopt_first_copies(
    PartnerLists &partners,
    const std::function<const double *(int, std::int64_t)> &ghost_values) const
{
  if (with_history) history.adopt_first_copies(pairs, partners, ghost_values);
}

void ContactPipeline::compute(const ParticleView &host, double dt, bool advance,
                              std::vector<ReportedContact> *report_to, EnergyAccount *account_to)
{
  report = report_to;
  account = account_to;
  if (account) account->begin_step(pairs.num_particles());
  particles.read(pairs, host, with_friction, with_resistance);
  touching_pairs =
      find_contacts(pairs, particles.position, with_history ? &history : nullptr, contact_list);

  if (with_history)
    compute_all<true, true>(dt, advance);
  else if (with_friction)
    compute_all<true, false>(dt, advance);
  else
    compute_all<false, false>(dt, advance);
}

template <bool friction, bool history_kept>
void ContactPipeline::compute_all(double dt, bool advance)
{
  for (std::int64_t begin = 0; begin < touching_pairs; begin += block_size) {
    const std::uint32_t *contacts = &contact_list[begin];
    const int count = static_cast<int>(std::min<std::int64_t>(block_size, touching_pairs - begin));
    const int end = arrange(contacts, count);
    gather<friction, history_kept>(end);
    if (with_onset) gather_onsets(end);
    finish_geometry(end, friction);
    if (with_resistance) gather_resistance(end);
    run_kernels(dt, advance);
    if (history_kept && advance) keep_history(end);
    if (with_onset && advance) keep_onsets(end);
    transpose_results<friction>(end);
    if (pairs.weighted()) apply_weights(end);
    add_up<friction>(contacts, count);
    if (with_resistance) add_couples(contacts, count);
    if (report) report_block(contacts, count);
    if (account) account_block(count, dt);
  }
}

void ContactPipeline::place(std::uint32_t contact, int position, int lane)
{
  pair_of_lane[lane] = contact;
  lane_of_contact[position] = lane;
}

/* Gives every contact of a block a lane. Contacts of one law stand together, and the last vector of
   each law is filled up with copies of its last contact, which are computed but not added. Returns
   the number of lanes in use, a multiple of `lanes`. */

int ContactPipeline::arrange(const std::uint32_t *contacts, int count)
{
  ranges.clear();
  int lane = 0;
  const auto close_range = [&](int law, int begin) {
    for (; lane % lanes; lane++) pair_of_lane[lane] = pair_of_lane[lane - 1];
    if (lane > begin) ranges.push_back({law, begin, lane});
  };

  if (laws.num_laws() == 1)
    for (int k = 0; k < count; k++) place(contacts[k], k, lane++);
  if (laws.num_laws() == 1) close_range(0, 0);

  for (int law = 0; laws.num_laws() > 1 && law < laws.num_laws(); law++) {
    const int begin = lane;
    for (int k = 0; k < count; k++)
      if (laws.law_index(row_of_pair(contacts[k])) == law) place(contacts[k], k, lane++);
    close_range(law, begin);
  }

  if (!laws.uniform())
    for (int k = 0; k < lane; k++) {
      const std::uint32_t c = pair_of_lane[k];
      batch.coefficients[k] = row_of_pair(c);
    }
  return lane;
}

/* Geometry and kinematics of the block. The sums of records give everything but the normal. */

namespace {
constexpr Vec4 difference_and_sum{-1.0, -1.0, -1.0, 1.0};
using Lanes = double[3][ContactBatch::width];

/// Four records become lanes k ... k+3 of a vector and of a scalar.
inline void spread(Vec4 *rows, Lanes &vector, double *fourth, int k)
{
  transpose(rows[0], rows[1], rows[2], rows[3]);
  for (int q = 0; q < 3; q++) store(&vector[q][k], rows[q]);
  if (fourth) store(&fourth[k], rows[3]);
}

/// Lanes k ... k+3 become four records.
inline void collect(const Lanes &vector, const double *fourth, int k, Vec4 *rows)
{
  for (int q = 0; q < 3; q++) rows[q] = load4(&vector[q][k]);
  rows[3] = fourth ? load4(&fourth[k]) : Vec4{};
  transpose(rows[0], rows[1], rows[2], rows[3]);
}

void clear_lanes(Lanes &vector, int begin, int end)
{
  for (auto &component : vector) std::fill(component + begin, component + end, 0.0);
}
}    // namespace

template <bool friction, bool history_kept> void ContactPipeline::gather(int end)
{
  const Record *x = particles.position.data(), *v = particles.velocity.data();
  const Record *w = particles.spin.data(), *h = history.records.data();

  for (int k = 0; k < end; k += 4) {
    Vec4 a[4], b[4], c[4], d[4];
    for (int q = 0; q < 4; q++) {
      const std::uint32_t pair = pair_of_lane[k + q];
      const int i = pairs.first[pair], j = pairs.second[pair];
      a[q] = load4(x[i]) + difference_and_sum * load4(x[j]);
      b[q] = load4(v[i]) + difference_and_sum * load4(v[j]);
      if constexpr (friction) c[q] = load4(w[i]) + load4(w[j]);
      if constexpr (!friction) batch.inverse_radius[k + q] = x[i].c[3] * x[j].c[3];
      if constexpr (history_kept) d[q] = load4(h[pair]);
    }
    spread(a, batch.normal, batch.overlap, k);
    spread(b, batch.velocity, batch.inverse_mass, k);
    if constexpr (friction) spread(c, batch.spin, batch.inverse_radius, k);
    if constexpr (history_kept) spread(d, batch.displacement, batch.at_limit, k);
  }
}

void ContactPipeline::gather_onsets(int end)
{
  for (int k = 0; k < end; k += 4) {
    Vec4 row[4];
    for (int q = 0; q < 4; q++) row[q] = load4(history.onsets[pair_of_lane[k + q]]);
    spread(row, batch.onset, nullptr, k);
  }
}

/* From separation and sum of radii to normal and overlap. Without spin records the lanes of the
   inverse radius still hold the product of the radii. */

void ContactPipeline::finish_geometry(int end, bool radii_known)
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

void ContactPipeline::gather_resistance(int end)
{
  const Record *x = particles.position.data(), *w = particles.spin.data();
  for (int k = 0; k < end; k += 4) {
    Vec4 row[4];
    for (int q = 0; q < 4; q++) {
      const std::uint32_t pair = pair_of_lane[k + q];
      const int i = pairs.first[pair], j = pairs.second[pair];
      row[q] = w[i].c[3] * load4(w[i]) - w[j].c[3] * load4(w[j]);
      batch.circle[k + q] = x[i].c[3];
      second_radius[k + q] = x[j].c[3];
    }
    spread(row, batch.relative_spin, nullptr, k);
  }
  for (int k = 0; k < end; k += lanes)
    store(&batch.circle[k],
          circle_of_intersection(load8(&batch.circle[k]), load8(&second_radius[k]),
                                 load8(&batch.overlap[k])));
}

void ContactPipeline::run_kernels(double dt, bool advance)
{
  for (const LawRange &range : ranges) {
    laws.kernel(range.law, advance)(batch, range.begin, range.end, laws.coefficients(), dt);
    // not written by the kernels of laws that have none
    const ContactLaw law = laws.distinct_law(range.law);
    if (with_friction && !law.has_friction()) clear_lanes(batch.moment, range.begin, range.end);
    if (with_resistance && !law.resists) clear_lanes(batch.couple, range.begin, range.end);
  }
}

/* Copies of a contact hold the same result, so writing them twice does no harm. */

void ContactPipeline::keep_history(int end)
{
  for (int k = 0; k < end; k += 4) {
    Vec4 row[4];
    collect(batch.displacement, batch.at_limit, k, row);
    for (int q = 0; q < 4; q++) store(history.records[pair_of_lane[k + q]], row[q]);
  }
}

void ContactPipeline::keep_onsets(int end)
{
  for (int k = 0; k < end; k += 4) {
    Vec4 row[4];
    collect(batch.onset, nullptr, k, row);
    for (int q = 0; q < 4; q++) store(history.onsets[pair_of_lane[k + q]], row[q]);
  }
}

template <bool friction> void ContactPipeline::transpose_results(int end)
{
  const auto rows_of = [](const Lanes &vector, int k, Record *records) {
    Vec4 row[4];
    collect(vector, nullptr, k, row);
    for (int q = 0; q < 4; q++) store(records[k + q], row[q]);
  };
  for (int k = 0; k < end; k += 4) {
    rows_of(batch.force, k, force_of_lane);
    if constexpr (friction) rows_of(batch.moment, k, moment_of_lane);
    if (with_resistance) rows_of(batch.couple, k, couple_of_lane);
  }
}

void ContactPipeline::apply_weights(int end)
{
  for (int k = 0; k < end; k++) {
    const double weight = pairs.weights[pair_of_lane[k]];
    for (int d = 0; d < 3; d++) {
      force_of_lane[k].c[d] *= weight;
      moment_of_lane[k].c[d] *= weight;
      couple_of_lane[k].c[d] *= weight;
    }
  }
}

template <bool friction> void ContactPipeline::add_up(const std::uint32_t *contacts, int count)
{
  Record *force = particles.force.data(), *moment = particles.moment.data();
  for (int n = 0; n < count; n++) {
    const int i = pairs.first[contacts[n]], j = pairs.second[contacts[n]];
    const int lane = lane_of_contact[n];
    const Vec4 f = load4(force_of_lane[lane]);
    store(force[i], load4(force[i]) + f);
    store(force[j], load4(force[j]) - f);
    if constexpr (friction) {
      const Vec4 m = load4(moment_of_lane[lane]);
      store(moment[i], load4(moment[i]) + m);
      store(moment[j], load4(moment[j]) + m);
    }
  }
}

void ContactPipeline::add_couples(const std::uint32_t *contacts, int count)
{
  Record *couple = particles.couple.data();
  for (int n = 0; n < count; n++) {
    const int i = pairs.first[contacts[n]], j = pairs.second[contacts[n]];
    const Vec4 c = load4(couple_of_lane[lane_of_contact[n]]);
    store(couple[i], load4(couple[i]) + c);
    store(couple[j], load4(couple[j]) - c);
  }
}

void ContactPipeline::report_block(const std::uint32_t *contacts, int count)
{
  for (int n = 0; n < count; n++) {
    const int i = pairs.first[contacts[n]], j = pairs.second[contacts[n]];
    ReportedContact out{pairs.atom_of_slot[i], pairs.atom_of_slot[j], {}, {}};
    for (int d = 0; d < 3; d++) {
      out.force[d] = force_of_lane[lane_of_contact[n]].c[d];
      out.separation[d] = particles.position[i].c[d] - particles.position[j].c[d];
    }
    report->push_back(out);
  }
}

void ContactPipeline::account_block(int count, double dt)
{
  for (int n = 0; n < count; n++) {
    const int lane = lane_of_contact[n];
    const std::uint32_t pair = pair_of_lane[lane];
    const int i = pairs.first[pair], j = pairs.second[pair], row = row_of_pair(pair);
    account->add(lane_energy(laws.law(row), laws.coefficients(row), batch, lane, dt),
                 share_of_pair(pair), i, particles.position[i].c[3], j, particles.position[j].c[3]);
  }
}

int ContactPipeline::row_of_pair(std::int64_t pair) const
{
  return laws.uniform() ? 0 : laws.row(slot_type[pairs.first[pair]], slot_type[pairs.second[pair]]);
}

std::int64_t ContactPipeline::pair_of(int i, int j) const
{
  if (!with_history || std::max(i, j) >= pairs.num_particles()) return -1;
  return pairs.find(pairs.slot_of_atom[i], pairs.slot_of_atom[j]);
}

TangentialHistory<double> ContactPipeline::history_of(int i, int j) const
{
  const std::int64_t pair = pair_of(i, j);
  if (pair < 0) return {};
  const bool in_order = pairs.slot_of_atom[i] < pairs.slot_of_atom[j];
  const Record h = in_order ? history.records[pair] : mirrored(history.records[pair]);
  return {{h.c[0], h.c[1], h.c[2]}, h.c[3]};
}

ContactOnset<double> ContactPipeline::onset_of(int i, int j) const
{
  const std::int64_t pair = pair_of(i, j);
  if (pair < 0 || history.onsets.empty()) return {};
  const Record &o = history.onsets[pair];
  return {o.c[0], o.c[1], o.c[2]};
}

double ContactPipeline::memory_usage() const
{
  return particles.memory_usage() + history.memory_usage() +
         static_cast<double>(contact_list.capacity() * sizeof(std::uint32_t)) +
         pairs.memory_usage();
}

}    // namespace Talus
