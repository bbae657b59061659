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
  // the contacts of each law fill whole vectors of the batch: leave room for the gaps
  const int gaps = laws.num_laws() > 1 ? (lanes - 1) * laws.num_laws() : 0;
  block_size = std::max(lanes, (ContactBatch::width - gaps) / lanes * lanes);
}

void ContactPipeline::start_pairs(const int *type, const PartnerLists &partners,
                                  const std::int64_t *filed_tag)
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
    partners.clear_all();    // what an earlier law has left must not come back
}

void ContactPipeline::compute(const ParticleView &host, double dt, bool advance,
                              std::vector<ReportedContact> *report_to)
{
  report = report_to;
  particles.read(pairs, host, with_friction);
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
    run_kernels(dt, advance);
    if (history_kept && advance) keep_history(end);
    transpose_results<friction>(end);
    if (pairs.weighted()) apply_weights(end);
    add_up<friction>(contacts, count);
    if (report) report_block(contacts, count);
  }
}

void ContactPipeline::place(std::uint32_t contact, int position, int lane)
{
  pair_of_lane[lane] = contact;
  lane_of_contact[position] = lane;
}

/* Gives every contact of a block a lane. Contacts of one law stand together, and the last vector of each
   law is filled up with copies of its last contact, which are computed but not added. Returns the number of
   lanes in use, a multiple of `lanes`. */

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
    for (int k = 0; k < count; k++) {
      const int a = slot_type[pairs.first[contacts[k]]], b = slot_type[pairs.second[contacts[k]]];
      if (laws.law_index(laws.row(a, b)) == law) place(contacts[k], k, lane++);
    }
    close_range(law, begin);
  }

  if (!laws.uniform())
    for (int k = 0; k < lane; k++) {
      const std::uint32_t c = pair_of_lane[k];
      batch.coefficients[k] = laws.row(slot_type[pairs.first[c]], slot_type[pairs.second[c]]);
    }
  return lane;
}

/* Geometry and kinematics of the block. The sums of records give everything but the normal. */

template <bool friction, bool history_kept> void ContactPipeline::gather(int end)
{
  constexpr Vec4 difference_and_sum{-1.0, -1.0, -1.0, 1.0};
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
    const auto spread = [k](Vec4 *rows, double(&vector)[3][ContactBatch::width], double *fourth) {
      transpose(rows[0], rows[1], rows[2], rows[3]);
      for (int q = 0; q < 3; q++) store(&vector[q][k], rows[q]);
      store(&fourth[k], rows[3]);
    };
    spread(a, batch.normal, batch.overlap);
    spread(b, batch.velocity, batch.inverse_mass);
    if constexpr (friction) spread(c, batch.spin, batch.inverse_radius);
    if constexpr (history_kept) spread(d, batch.displacement, batch.at_limit);
  }

  const Vec8 zero = splat<Vec8>(0.0), one = splat<Vec8>(1.0);
  for (int k = 0; k < end; k += lanes) {
    const Vector3<Vec8> separation{load8(&batch.normal[0][k]), load8(&batch.normal[1][k]),
                                   load8(&batch.normal[2][k])};
    const Vec8 sum_of_radii = load8(&batch.overlap[k]);
    const Vec8 distance = square_root(dot(separation, separation));
    const auto apart = distance > zero;    // coincident centres have no normal and get no force
    const Vector3<Vec8> normal = select(apart, one / distance, zero) * separation;
    store(&batch.normal[0][k], normal.x);
    store(&batch.normal[1][k], normal.y);
    store(&batch.normal[2][k], normal.z);
    store(&batch.overlap[k], select(apart, sum_of_radii - distance, zero));
    if constexpr (!friction)
      store(&batch.inverse_radius[k], sum_of_radii / load8(&batch.inverse_radius[k]));
  }
}

void ContactPipeline::run_kernels(double dt, bool advance)
{
  for (const LawRange &range : ranges) {
    laws.kernel(range.law, advance)(batch, range.begin, range.end, laws.coefficients(), dt);
    if (with_friction && !laws.distinct_law(range.law).has_friction())
      for (auto &component : batch.moment)    // not written by a kernel without friction
        std::fill(component + range.begin, component + range.end, 0.0);
  }
}

/* Copies of a contact hold the same result, so writing them twice does no harm. */

void ContactPipeline::keep_history(int end)
{
  for (int k = 0; k < end; k += 4) {
    Vec4 row[4] = {load4(&batch.displacement[0][k]), load4(&batch.displacement[1][k]),
                   load4(&batch.displacement[2][k]), load4(&batch.at_limit[k])};
    transpose(row[0], row[1], row[2], row[3]);
    for (int q = 0; q < 4; q++) store(history.records[pair_of_lane[k + q]], row[q]);
  }
}

template <bool friction> void ContactPipeline::transpose_results(int end)
{
  const auto collect = [](double(&vector)[3][ContactBatch::width], int k, Record *rows) {
    Vec4 row[4] = {load4(&vector[0][k]), load4(&vector[1][k]), load4(&vector[2][k]), Vec4{}};
    transpose(row[0], row[1], row[2], row[3]);
    for (int q = 0; q < 4; q++) store(rows[k + q], row[q]);
  };
  for (int k = 0; k < end; k += 4) {
    collect(batch.force, k, force_of_lane);
    if constexpr (friction) collect(batch.moment, k, moment_of_lane);
  }
}

void ContactPipeline::apply_weights(int end)
{
  for (int k = 0; k < end; k++) {
    const double weight = pairs.weights[pair_of_lane[k]];
    for (int d = 0; d < 3; d++) {
      force_of_lane[k].c[d] *= weight;
      moment_of_lane[k].c[d] *= weight;
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

double ContactPipeline::share_of_pair(std::int64_t pair) const
{
  const bool both = pairs.is_owned(pairs.atom_of_slot[pairs.first[pair]]) &&
      pairs.is_owned(pairs.atom_of_slot[pairs.second[pair]]);
  return both ? 1.0 : 0.5;
}

double ContactPipeline::count_contacts() const
{
  double count = 0.0;
  for (std::int64_t n = 0; n < touching_pairs; n++) count += share_of_pair(contact_list[n]);
  return count;
}

double ContactPipeline::count_candidates() const
{
  double count = 0.0;
  for (std::int64_t c = 0; c < pairs.num_pairs(); c++) count += share_of_pair(c);
  return count;
}

Record ContactPipeline::history_of(int i, int j) const
{
  if (!with_history || std::max(i, j) >= pairs.num_particles()) return Record{};
  const int a = pairs.slot_of_atom[i], b = pairs.slot_of_atom[j];
  const std::int64_t pair = pairs.find(a, b);
  if (pair < 0) return Record{};
  return a < b ? history.records[pair] : mirrored(history.records[pair]);
}

double ContactPipeline::memory_usage() const
{
  return particles.memory_usage() + history.memory_usage() +
      static_cast<double>(contact_list.capacity() * sizeof(std::uint32_t)) + pairs.memory_usage();
}

}    // namespace Talus
