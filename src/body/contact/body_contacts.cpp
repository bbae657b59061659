// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "body/contact/body_contacts.h"

#include "base/in_parallel.h"
#include "body/shape/moving_vertices.h"
#include "laws/change_of_order.h"

#include <algorithm>
#include <map>

namespace Talus {

void BodyFindings::join(const BodyFindings &other)
{
  for (Worst BodyFindings::*finding :
       {&BodyFindings::overlap, &BodyFindings::speed, &BodyFindings::passed, &BodyFindings::idle})
    if ((other.*finding).value > (this->*finding).value) this->*finding = other.*finding;
}

void BodyFindings::join(const DeepestInBody &deepest)
{
  if (deepest.overlap_ratio > std::max(overlap.value, DeepestContact::watched))
    overlap = {deepest.overlap_ratio, deepest.particle, deepest.part};
}

void BodyContacts::set_laws(const LawTable &table)
{
  laws = std::make_shared<const LawTable>(table);
  with_history = laws->has_history();
  history_records = laws->history_records();
  batches.clear();    // their lanes hold rows of the old table
}

void BodyContacts::change_order(int order, const int *type,
                                const std::function<const ContactLaw &(int)> &law)
{
  if (!with_history) return;
  for (std::size_t c = 0; c < candidates.atoms().size(); c++) {
    const int i = candidates.atoms()[c];
    for (int k = 0; k < history.count(c); k++) {
      const std::size_t slot = history.first_slot(c) + k;
      HistoryValues values = history.values(slot);
      Talus::change_order(law(type[i]), order, values);
      history.set_values(slot, values);
    }
  }
}

void BodyContacts::find_candidates(const LargeBodyShape &shape, const BodyFrame &frame,
                                   const ParticleState &view, const int *mask, int group,
                                   double skin, int threads)
{
  index.clear();
  forget_deepest();
  std::vector<int> to_keep;
  if (with_history && history.by_parts()) to_keep = history.particles_in_contact(view.owned());
  candidates.list(shape, frame, view, mask, group, skin,
                  largest_pulloff_distance(view, mask, group), to_keep, threads);
  follow_candidates();
}

/* Laws without history have nothing at rest either. */

void BodyContacts::follow_candidates()
{
  if (with_history)
    history.follow(candidates.atoms(), candidates.room());
  else
    history.begin_step();
}

Eigen::AlignedBox3d BodyContacts::bounds_of_search(const BodyFrame &frame,
                                                   const ParticleState &view, const int *mask,
                                                   int group, double skin) const
{
  return BodyCandidates::bounds_of_search(frame, view, mask, group, skin,
                                          largest_pulloff_distance(view, mask, group));
}

/* How far contacts of these particles last beyond zero overlap at most (length). */

double BodyContacts::largest_pulloff_distance(const ParticleState &view, const int *mask,
                                              int group) const
{
  double largest = 0.0;
  if (!laws->lasts_beyond_contact()) return largest;
  std::map<int, double> radius_of_type;    // that of larger ones is larger
  int type = 0;
  double *radius = nullptr;
  for (int i = 0; i < view.owned(); i++) {
    if (!(mask[i] & group)) continue;
    if (!radius || view.type(i) != type) radius = &radius_of_type[type = view.type(i)];
    *radius = std::max(*radius, view.radius(i));
  }
  for (const auto &[of_type, radius_of_largest] : radius_of_type)
    largest =
        std::max(largest, laws->pulloff_distance(laws->row(of_type, of_type), radius_of_largest));
  return largest;
}

/* Where a step goes through the records, it does so from their beginning to their end. */

void BodyContacts::index_candidates(const ParticleState &view)
{
  const int *const order = view.order();
  if (candidates.size() == 0 || (!index.empty() && order_of_index == order)) return;
  const bool sorted = order && candidates.room().empty() && candidates.sort_by_slot(order);
  if (sorted && with_history) history.follow(candidates.atoms(), candidates.room());
  order_of_index = order;
  index.clear();
  for (const int i : candidates.atoms()) index.push_back(view.place(i));
  index.resize(index.size() + BodyTask::spare, index.back());
}

BodyTask BodyContacts::task_of(const LargeBodyShape &shape, const BodyFrame &frame,
                               const ParticleState &view, const BodyStep &step)
{
  return {shape,        *laws,   frame, view,         candidates,
          index.data(), history, step,  with_history, history_records};
}

void BodyContacts::start_batches(int threads, bool exact)
{
  while (static_cast<int>(batches.size()) < threads)
    batches.push_back(std::make_unique<BodyBatch>());
  for (auto &batch : batches) batch->start(exact);
}

std::size_t BodyContacts::first_of(int thread, int threads) const
{
  return candidates.size() * thread / threads;
}

BodyLoad BodyContacts::compute(const LargeBodyShape &shape, const BodyFrame &frame,
                               const ParticleState &view, const BodyStep &step)
{
  const bool many = step.threads > 1 && shape.thread_safe();
  const int threads = many ? step.threads : 1;
  index_candidates(view);
  history.begin_step();
  start_batches(threads, step.exact);
  const BodyTask task = task_of(shape, frame, view, step);
  in_parallel(threads, threads, [&](int t) {
    batches[t]->compute(task, first_of(t, threads), first_of(t + 1, threads));
  });

  BodyLoad load;
  if (step.account) step.account->sum += static_work();
  if (step.exact) step.exact->clear();
  if (step.touched) step.touched->clear();
  if (step.corners) step.corners->clear();
  for (const auto &batch : batches) {
    load.add(batch->load);
    if (step.exact) step.exact->add(batch->exact);
    if (step.touched)
      step.touched->insert(step.touched->end(), batch->touched.begin(), batch->touched.end());
    if (step.corners && step.corners->empty())
      step.corners->swap(batch->corners);    // of the first, or the only one
    else if (step.corners)
      step.corners->insert(step.corners->end(), batch->corners.begin(), batch->corners.end());
    if (step.for_outputs)
      step.for_outputs->add(std::move(batch->contacts_for_outputs), batch->stored_energy);
  }
  return load;
}

bool BodyContacts::begin_static(const LargeBodyShape &shape, const BodyFrame &frame,
                                const ParticleState &view, const BodyStep &step)
{
  const bool is_plain =
      !step.exact && !step.touched && !step.corners && !step.virial && !step.for_outputs;
  if (shape.most_contacts() > 1 || !view.order() || frame.moves || !is_plain) return false;
  index_candidates(view);
  history.begin_step();
  start_batches(step.threads, false);
  in_pieces = {&shape, &frame, view, step};
  return true;
}

void BodyContacts::add_to_slots(int thread, int begin, int end)
{
  const auto last = index.begin() + static_cast<std::ptrdiff_t>(candidates.size());
  const auto place = [&](int slot) {
    return static_cast<std::size_t>(std::lower_bound(index.begin(), last, slot) - index.begin());
  };
  const BodyTask task = task_of(*in_pieces.shape, *in_pieces.frame, in_pieces.view, in_pieces.step);
  batches[thread]->compute(task, place(begin), place(end));
}

BodyLoad BodyContacts::static_load() const
{
  BodyLoad load;
  for (const auto &batch : batches) load.add(batch->load);
  return load;
}

EnergyByCause BodyContacts::static_work() const
{
  EnergyByCause work;
  for (const auto &batch : batches) work += batch->work;
  return work;
}

BodyFindings BodyContacts::find_worst(const LargeBodyShape &shape, const BodyFrame &frame,
                                      const ParticleState &view, int threads) const
{
  if (!shape.thread_safe()) threads = 1;
  std::vector<BodyFindings> found(threads);
  in_parallel(threads, threads, [&](int t) {
    found[t] = findings_in(shape, frame, view, first_of(t, threads), first_of(t + 1, threads));
  });
  BodyFindings most;
  for (const BodyFindings &findings : found) most.join(findings);
  for (const auto &batch : batches) most.join(batch->deepest());
  return most;
}

BodyFindings BodyContacts::findings_in(const LargeBodyShape &shape, const BodyFrame &frame,
                                       const ParticleState &view, std::size_t begin,
                                       std::size_t end) const
{
  BodyFindings most;
  SurfaceContact found[LargeBodyShape::max_parts];
  const bool several = shape.most_contacts() > 1;
  for (std::size_t c = begin; c < end; c++) {
    const int i = candidates.atom(c);
    const Vector3<double> place = view.position(i), x = frame.point_to_body(place);
    const double radius = view.radius(i);
    bool may_touch = true;
    const NearParts near = several ? candidates.parts_near(frame, c, x, radius, may_touch)
                                   : NearParts{nullptr, nullptr};
    const int count = !several    ? static_cast<int>(shape.touches(x, radius, *found))
                      : may_touch ? shape.find_contacts(x, radius, near, found)
                                  : 0;
    BodyFindings of_particle;
    for (int k = 0; k < count; k++)
      if (const double overlap = found[k].overlap / radius; overlap > of_particle.overlap.value)
        of_particle.overlap = {overlap, i, found[k].part};
    Vector3<double> v = view.velocity(i);
    if (frame.moves) v = v - frame.velocity_at(place);
    if (frame.vertices && count)
      v = v - frame.vertices->motion(frame.vertices->point_on(found->part, x)).velocity;
    of_particle.speed = {length(v) / radius, i, 0};
    if (several) {
      const Passage passage = shape.passage(candidates.listed_at(c), x, near);
      if (passage.part >= 0)
        of_particle.passed = {passage.from_acting_side ? 1.0 : 2.0, i, passage.part};
      const int idle = may_touch ? shape.idle_part(x, radius, near) : -1;
      if (idle >= 0) of_particle.idle = {1.0, i, idle};
    }
    most.join(of_particle);
  }
  return most;
}

void BodyContacts::forget_deepest()
{
  for (auto &batch : batches) batch->forget_deepest();
}

double BodyContacts::memory_usage() const
{
  return candidates.memory_usage() + history.memory_usage() +
         static_cast<double>(index.capacity() * sizeof(int));
}

}    // namespace Talus
