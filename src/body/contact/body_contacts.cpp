// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "body/contact/body_contacts.h"

#include "base/in_parallel.h"

#include <algorithm>
#include <cmath>

namespace Talus {
namespace {

constexpr std::size_t ahead = 12;    // candidates whose state is called into the cache

}    // namespace

void BodyContacts::set_laws(const LawTable &table, bool one_contact)
{
  laws = table;
  single = one_contact;
  with_history = laws.has_history();
  with_impact = laws.has_impact();
}

BodyContacts::Worst BodyContacts::worst(const LargeBodyShape &shape, const BodyFrame &frame,
                                        const BodyParticleView &view, int threads) const
{
  if (!shape.thread_safe()) threads = 1;
  std::vector<Worst> found(threads);
  in_parallel(threads, threads, [&](int t) {
    found[t] = worst_of(shape, frame, view, first_of(t, threads), first_of(t + 1, threads));
  });
  Worst most;
  for (const Worst &its : found) {
    if (its.overlap > most.overlap) {
      most.overlap = its.overlap;
      most.deepest = its.deepest;
    }
    if (its.speed > most.speed) {
      most.speed = its.speed;
      most.fastest = its.fastest;
    }
  }
  return most;
}

BodyContacts::Worst BodyContacts::worst_of(const LargeBodyShape &shape, const BodyFrame &frame,
                                           const BodyParticleView &view, std::size_t begin,
                                           std::size_t end) const
{
  Worst most;
  SurfaceContact found[LargeBodyShape::max_contacts];
  for (std::size_t c = begin; c < end; c++) {
    const int i = candidates[c];
    const Vector3<double> place = view.position(i), x = frame.point_to_body(place);
    const double radius = view.radius_of(i);
    const int count =
        single ? static_cast<int>(shape.touches(x, radius, *found))
               : shape.find_contacts(x, radius, parts_near(c, radius + length(x - listed[c].at)),
                                     found);
    for (int k = 0; k < count; k++) {
      if (found[k].overlap / radius <= most.overlap) continue;
      most.overlap = found[k].overlap / radius;
      most.deepest = i;
    }
    const Vector3<double> v = view.velocity(i);
    const double speed = length(frame.moves ? v - frame.velocity_at(place) : v) / radius;
    if (speed <= most.speed) continue;
    most.speed = speed;
    most.fastest = i;
  }
  return most;
}

BodyLoad BodyContacts::compute(const LargeBodyShape &shape, const BodyFrame &frame,
                               const BodyParticleView &view, const BodyStep &step)
{
  const bool many = step.threads > 1 && !step.account && shape.thread_safe();
  const int threads = many ? step.threads : 1;
  if (step.account) remember_velocities(frame, view, *step.account);
  if (begin_at_rest(shape, frame, view, step)) {
    in_parallel(threads, threads,
                [&](int t) { add_at_rest(t, first_of(t, threads), first_of(t + 1, threads)); });
    return load_at_rest();
  }
  const BodyTask task = task_of(frame, view, step);
  largest_overlap = 0.0;
  compute_batches(shape, task, threads);

  BodyLoad load;
  if (step.exact) step.exact->clear();
  if (step.touched) step.touched->clear();
  for (int t = 0; t < threads; t++) {
    const BodyBatch &b = *batches[t];
    load.add(b.load);
    largest_overlap = std::max(largest_overlap, b.largest_overlap);
    if (step.exact) step.exact->add(b.exact);
    if (step.touched) step.touched->insert(step.touched->end(), b.touched.begin(), b.touched.end());
  }
  if (keeps_lists() && step.advance) renew_memory(threads);
  return load;
}

BodyTask BodyContacts::task_of(const BodyFrame &frame, const BodyParticleView &view,
                               const BodyStep &step) const
{
  return {laws,
          frame,
          view,
          step.dt,
          step.advance,
          step.exact != nullptr,
          step.touched != nullptr,
          step.account,
          with_history,
          with_impact,
          laws.has_resistance()};
}

std::size_t BodyContacts::first_of(int thread, int threads) const
{
  return candidates.size() * thread / threads;
}

bool BodyContacts::begin_at_rest(const LargeBodyShape &shape, const BodyFrame &frame,
                                 const BodyParticleView &view, const BodyStep &step)
{
  if (!single || !view.records) return false;
  if (slots.empty()) sort_by_slot(view.slot_of_atom);
  if (!StaticBodyBatch::serves(task_of(frame, view, step))) return false;
  at_rest = {&shape, &frame, view, step};
  while (static_cast<int>(resting_batches.size()) < step.threads)
    resting_batches.push_back(std::make_unique<StaticBodyBatch>());
  for (auto &batch : resting_batches) batch->load = BodyLoad();
  largest_overlap = 0.0;
  return true;
}

void BodyContacts::add_at_rest(int thread, std::size_t begin, std::size_t end)
{
  resting_batches[thread]->compute(*at_rest.shape,
                                   task_of(*at_rest.frame, at_rest.view, at_rest.step),
                                   {candidates, slots}, history, begin, end);
}

void BodyContacts::add_to_slots(int thread, int begin, int end)
{
  const auto last = slots.begin() + static_cast<std::ptrdiff_t>(candidates.size());
  const auto place = [&](int slot) {
    return static_cast<std::size_t>(std::lower_bound(slots.begin(), last, slot) - slots.begin());
  };
  add_at_rest(thread, place(begin), place(end));
}

BodyLoad BodyContacts::load_at_rest() const
{
  BodyLoad load;
  for (const auto &batch : resting_batches) load.add(batch->load);
  return load;
}

void BodyContacts::compute_batches(const LargeBodyShape &shape, const BodyTask &task, int threads)
{
  while (static_cast<int>(batches.size()) < threads)
    batches.push_back(std::make_unique<BodyBatch>());
  new_lists.assign(single ? 0 : candidates.size(), NewList{0, 0, 0});
  in_parallel(threads, threads, [&](int t) {
    const std::size_t begin = first_of(t, threads), end = first_of(t + 1, threads);
    batches[t]->start(task.exact);
    for (std::size_t c = begin; c < end && !single; c++) new_lists[c].batch = t;
    compute_range(shape, task, *batches[t], begin, end);
  });
}

void BodyContacts::compute_range(const LargeBodyShape &shape, const BodyTask &task,
                                 BodyBatch &batch, std::size_t begin, std::size_t end)
{
  batch.sparse = single ? &history : nullptr;
  for (int law = 0; law < laws.num_laws(); law++) {
    for (std::size_t c = begin; c < end; c++) {
      if (c + ahead < end) task.view.call(candidates[c + ahead]);
      if (!single) call_parts_ahead(shape, task.view, c, end);
      if (laws.law_index(task.row_of(candidates[c])) != law) continue;
      if (single)
        touch_once(shape, task, batch, law, c);
      else
        touch_often(shape, task, batch, law, c);
    }
    batch.flush(task, law);
  }
}

/* Candidates stand far from each other in memory: what one needs is called into the cache a while
   before. First the list of parts, then those that the particle probably touches. */

void BodyContacts::call_parts_ahead(const LargeBodyShape &shape, const BodyParticleView &view,
                                    std::size_t c, std::size_t end) const
{
  if (c + ahead >= end) return;
  const double near = 1.01;    // of the radius
  const std::size_t first = c + ahead, soon = c + ahead / 2;
  memory.call_ahead(candidates[first]);
  if (listed[first].nearest < near * view.radius_of(candidates[first]))
    __builtin_prefetch(parts.data() + parts_begin[first]);
  const double reach = near * view.radius_of(candidates[soon]);
  if (listed[soon].nearest >= reach) return;
  for (std::size_t p = parts_begin[soon]; p < parts_begin[soon + 1]; p++) {
    if (parts[p].distance > reach) break;
    shape.call_ahead(parts[p].part);
  }
}

void BodyContacts::touch_once(const LargeBodyShape &shape, const BodyTask &task, BodyBatch &batch,
                              int law, std::size_t c)
{
  const int i = candidates[c];
  SurfaceContact contact;
  const bool touches = shape.touches(task.frame.point_to_body(task.view.position(i)),
                                     task.view.radius_of(i), contact);
  if (with_history) history.set_touching(c / 8, 1U << c % 8, (touches ? 1U : 0U) << c % 8);
  if (!touches) return;
  const Record none{};
  batch.add(task, law, i, contact, with_history ? history.record(c) : none,
            with_impact ? history.impact(c) : none, static_cast<int>(c));
}

/* Only parts that the particle can have reached since they were listed; nearest first. */

NearParts BodyContacts::parts_near(std::size_t c, double reach) const
{
  const NearPart *const begin = parts.data() + parts_begin[c];
  const NearPart *const last = parts.data() + parts_begin[c + 1];
  const NearPart *end = begin;
  while (end != last && end->distance < reach) end++;
  return {begin, end};
}

void BodyContacts::touch_often(const LargeBodyShape &shape, const BodyTask &task, BodyBatch &batch,
                               int law, std::size_t c)
{
  const int i = candidates[c];
  const Vector3<double> x = task.frame.point_to_body(task.view.position(i));
  SurfaceContact found[LargeBodyShape::max_contacts];
  const double radius = task.view.radius_of(i);
  // a little more than the way that it went: rounding must not hide a part
  const double reach = radius + (1.0 + 1.0e-9) * length(x - listed[c].at) + 1.0e-9 * radius;
  const bool may_touch = listed[c].nearest < reach;
  const int count = may_touch ? shape.find_contacts(x, radius, parts_near(c, reach), found) : 0;
  NewList &list = new_lists[c];
  list.first = static_cast<int>(batch.remembered.size());
  list.count = count;
  unsigned taken = 0;
  // all of a particle's contacts first: a full batch writes back histories
  RememberedContact old[LargeBodyShape::max_contacts];
  for (int k = 0; k < count; k++) {
    old[k] = RememberedContact{found[k].normal, Record{}, Record{}};
    const int known = with_history ? memory.find(i, found[k].normal, taken) : -1;
    if (known >= 0) {
      old[k].history = memory.begin(i)[known].history;
      old[k].impact = memory.begin(i)[known].impact;
    }
    batch.remembered.push_back(old[k]);
  }
  for (int k = 0; k < count; k++)
    batch.add(task, law, i, found[k], old[k].history, old[k].impact, list.first + k);
}

void BodyContacts::renew_memory(int threads)
{
  memory.start_step();
  std::vector<int> first;
  first.reserve(threads);
  for (int t = 0; t < threads; t++) first.push_back(memory.append(batches[t]->remembered));
  for (std::size_t c = 0; c < candidates.size(); c++)
    memory.set_list(candidates[c], first[new_lists[c].batch] + new_lists[c].first,
                    new_lists[c].count);
  memory.end_step();
}

void BodyContacts::remember_velocities(const BodyFrame &frame, const BodyParticleView &view,
                                       EnergyAccount &account)
{
  account.begin_step(view.owned);
  before.clear();
  frame_before = frame;
  for (const int i : candidates) {
    Motion m{view.velocity(i), view.spin(i), view.position(i)};
    if (frame.moves) {
      m.velocity = frame.to_body(m.velocity - frame.velocity_at(m.place));
      m.spin = frame.to_body(m.spin - frame.state.spin);
    }
    before.push_back(m);
  }
}

/* Work is that of the velocities past each other, each the mean of before and after the kick: then
   it is what particles and body lose. */

void BodyContacts::account_for_move(const BodyFrame &frame, const BodyParticleView &view, double dt,
                                    EnergyAccount &to) const
{
  for (std::size_t n = 0; n < candidates.size(); n++) {
    const int i = candidates[n];
    Vector3<double> velocity = view.velocity(i), spin = view.spin(i);
    if (frame_before.moves) {
      const Vector3<double> arm = before[n].place - frame_before.state.position;
      velocity =
          frame_before.to_body(velocity - frame.state.velocity - cross(frame.state.spin, arm));
      spin = frame_before.to_body(spin - frame.state.spin);
    }
    to.move(i, dt, 0.5 * (before[n].velocity + velocity), 0.5 * (before[n].spin + spin));
  }
  to.end_step();
}

double BodyContacts::memory_usage() const
{
  return static_cast<double>((candidates.capacity() + slots.capacity()) * sizeof(int) +
                             listed.capacity() * sizeof(Listed) +
                             parts.capacity() * sizeof(NearPart)) +
         history.memory_usage() + memory.memory_usage();
}

}    // namespace Talus
