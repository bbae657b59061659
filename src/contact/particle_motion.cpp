// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "contact/particle_motion.h"

#include "contact/contact_pipeline.h"

#include "base/nearly_sorted.h"

#include <algorithm>
#include <atomic>
#include <iterator>

namespace Talus {

void ParticleMotion::prepare(const Movers &find_movers, const std::vector<int> &sent)
{
  std::vector<signed char> mover(of.order.owned);
  of.in_ranges(of.order.owned,
               [&](int begin, int end) { find_movers(begin, end, mover.data() + begin); });
  std::atomic<bool> all{true}, all_owned{true};
  role.resize(of.order.size());
  of.in_ranges(of.order.size(), [&](int begin, int end) {
    bool all_here = true, all_owned_here = true;
    for (int s = begin; s < end; s++) {
      const int a = of.order.atom_of_slot[s];
      const int found = !of.order.is_owned(a) ? ParticleRecords::GHOST
                        : mover[a] < 0        ? ParticleRecords::RESTS
                                              : ParticleRecords::MOVES + mover[a];
      role[s] = ParticleRecords::Role(found);
      all_here = all_here && found == ParticleRecords::MOVES;
      all_owned_here = all_owned_here && found != ParticleRecords::RESTS;
    }
    if (!all_here) all = false;
    if (!all_owned_here) all_owned = false;
  });
  if (all) role.clear();
  all_owned_move = all_owned;

  moved_at_once.clear();
  for (const int a : sent) moved_at_once.push_back(of.order.slot_of_atom[a]);
  sort_and_unite(moved_at_once);
  moved_first.clear();
  std::set_difference(of.shared_owned.begin(), of.shared_owned.end(), moved_at_once.begin(),
                      moved_at_once.end(), std::back_inserter(moved_first));
  is_moved_before.clear();
  of.mark(moved_at_once, is_moved_before);
  of.mark(moved_first, is_moved_before);
  if (of.work.in_two_phases()) of.mark(of.ghost_slots, is_moved_before);

  prepared = true;
}

void ParticleMotion::advance(const std::vector<RecordStep> &steps)
{
  steps_of_move = steps;
  of.particles.extrapolation = steps[0].extrapolation;
  pending = true;
  std::fill(speeds.begin(), speeds.end(), Speed{});
  if (moved_at_once.empty()) return;
  in_parallel(of.threads, of.threads, [&](int t) {
    speeds[t].join(of.particles.advance(steps_of_move, role, of.of_thread(moved_at_once, t)));
  });
}

double ParticleMotion::fastest() const
{
  Speed all;
  for (const Speed &one : speeds) all.join(one.largest);
  return all.largest;
}

void ParticleMotion::complete()
{
  if (!pending) return;
  const std::int64_t n = of.order.size();
  const auto move_range = [&](int t) {
    move_on_the_way(
        t, {static_cast<int>(n * t / of.threads), static_cast<int>(n * (t + 1) / of.threads)});
  };
  in_parallel(
      of.threads, of.threads, [this](int t) { move_shared(t); }, move_range);
  pending = false;
  completed = true;
}

void ParticleMotion::move_shared(int thread)
{
  speeds[thread].join(of.particles.advance(steps_of_move, role, of.of_thread(moved_first, thread)));
}

void ParticleMotion::move_on_the_way(int range, SlotChoice slots)
{
  slots.marked = is_moved_before.empty() ? nullptr : is_moved_before.data();
  speeds[range].join(of.particles.advance(steps_of_move, role, slots));
}

void ParticleMotion::return_state(const ParticleView &arrays, bool with_forces)
{
  complete();
  in_records = false;
  of.in_ranges(of.order.owned, [&](int begin, int end) {
    for (int a = begin; a < end; a++) {
      write_state(a, arrays);
      if (with_forces) write_forces(a, arrays);
    }
  });
}

void ParticleMotion::write_state(int atom, const ParticleView &arrays) const
{
  const std::int64_t row = 3L * atom;
  const int slot = of.order.slot_of_atom[atom];
  of.particles.write_state(slot, arrays.x + row, arrays.v + row, arrays.omega + row);
  if (with_changes && arrays.change) arrays.change[atom] = of.particles.change[slot];
}

void ParticleMotion::copy_states(const std::vector<int> &atoms, const ParticleView &arrays) const
{
  for (const int a : atoms) write_state(a, arrays);
}

void ParticleMotion::write_forces(int atom, const ParticleView &arrays) const
{
  const std::int64_t row = 3L * atom;
  of.particles.write_forces(of.order.slot_of_atom[atom], arrays.f + row, arrays.torque + row);
}

void ParticleMotion::show(const ParticleView &arrays, bool proxies, bool forces) const
{
  of.in_ranges(proxies ? of.order.size() : of.order.owned, [&](int begin, int end) {
    for (int a = begin; a < end; a++) {
      write_state(a, arrays);
      if (forces && of.order.is_owned(a)) write_forces(a, arrays);
    }
  });
}

void ParticleMotion::take_forces(const ParticleView &arrays)
{
  of.in_ranges(of.order.owned, [&](int begin, int end) {
    for (int a = begin; a < end; a++)
      of.particles.set_forces(of.order.slot_of_atom[a], arrays.f + 3L * a, arrays.torque + 3L * a);
  });
}

void ParticleMotion::keep_changes(bool yes)
{
  with_changes = yes;
  if (of.particles.has_room()) of.particles.keep_changes(yes);
}

}    // namespace Talus
