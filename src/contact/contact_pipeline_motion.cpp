// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// How ContactPipeline moves particles that live in its records, and gives them back.

#include "contact/contact_pipeline.h"

#include "base/nearly_sorted.h"

#include <algorithm>
#include <atomic>
#include <iterator>

namespace Talus {

void ContactPipeline::prepare_to_move(const std::function<int(int)> &mover,
                                      const std::vector<int> &sent)
{
  std::atomic<bool> all{true}, all_owned{true};
  role.resize(order.size());
  in_ranges(order.size(), [&](int begin, int end) {
    for (int s = begin; s < end; s++) {
      const int a = order.atom_of_slot[s];
      const int moved_by = order.is_owned(a) ? mover(a) : -1;
      role[s] = !order.is_owned(a) ? ParticleRecords::GHOST
                : moved_by < 0     ? ParticleRecords::RESTS
                                   : ParticleRecords::Role(ParticleRecords::MOVES + moved_by);
      if (role[s] != ParticleRecords::MOVES) all.store(false, std::memory_order_relaxed);
      if (role[s] == ParticleRecords::RESTS) all_owned.store(false, std::memory_order_relaxed);
    }
  });
  if (all) role.clear();
  all_owned_move = all_owned;

  moved_at_once.clear();
  for (const int a : sent) moved_at_once.push_back(order.slot_of_atom[a]);
  sort_and_unite(moved_at_once);
  moved_first.clear();
  std::set_difference(shared_owned.begin(), shared_owned.end(), moved_at_once.begin(),
                      moved_at_once.end(), std::back_inserter(moved_first));
  is_moved_before.clear();
  mark(moved_at_once, is_moved_before);
  mark(moved_first, is_moved_before);
  if (work.in_two_phases()) mark(ghost_slots, is_moved_before);

  prepared = true;
}

void ContactPipeline::advance(const std::vector<RecordStep> &steps)
{
  move = steps;
  particles.extrapolation = steps[0].extrapolation;
  move_pending = true;
  std::fill(speeds.begin(), speeds.end(), Speed{});
  if (moved_at_once.empty()) return;
  in_parallel(threads, threads, [&](int t) {
    speeds[t].join(particles.advance(move, role, of_thread(moved_at_once, t)));
  });
}

void ContactPipeline::set_weightless(const std::function<bool(int)> &is_weightless)
{
  std::vector<unsigned char> marks(is_weightless ? order.size() : 0);
  in_ranges(static_cast<std::int64_t>(marks.size()), [&](int begin, int end) {
    for (int s = begin; s < end; s++) marks[s] = is_weightless(order.atom_of_slot[s]);
  });
  particles.set_weightless(std::move(marks));
}

void ContactPipeline::set_own_masses(const double *of_atom)
{
  std::vector<double> own_mass(of_atom ? order.size() : 0);
  for (std::size_t s = 0; s < own_mass.size(); s++) own_mass[s] = of_atom[order.atom_of_slot[s]];
  particles.set_own_masses(std::move(own_mass));
}

double ContactPipeline::fastest() const
{
  Speed all;
  for (const Speed &one : speeds) all.join(one.largest);
  return all.largest;
}

void ContactPipeline::complete_move()
{
  if (!move_pending) return;
  Talus::in_ranges(order.size(), threads, [&](int t, int begin, int end) {
    speeds[t].join(particles.advance(move, role, of_thread(moved_first, t)));
    SlotChoice slots{begin, end};
    slots.marked = is_moved_before.empty() ? nullptr : is_moved_before.data();
    speeds[t].join(particles.advance(move, role, slots));
  });
  move_pending = false;
}

void ContactPipeline::return_state(const ParticleView &arrays, bool with_forces)
{
  complete_move();
  in_records = false;
  in_ranges(order.owned, [&](int begin, int end) {
    for (int a = begin; a < end; a++) {
      write_state(a, arrays);
      if (with_forces) write_forces(a, arrays);
    }
  });
}

void ContactPipeline::write_state(int atom, const ParticleView &arrays) const
{
  const std::int64_t row = 3L * atom;
  const int slot = order.slot_of_atom[atom];
  particles.write_state(slot, arrays.x + row, arrays.v + row, arrays.omega + row);
  if (with_changes && arrays.change) arrays.change[atom] = particles.change[slot];
}

void ContactPipeline::copy_states_to_arrays(const std::vector<int> &atoms,
                                            const ParticleView &arrays) const
{
  for (const int a : atoms) write_state(a, arrays);
}

void ContactPipeline::write_forces(int atom, const ParticleView &arrays) const
{
  const std::int64_t row = 3L * atom;
  particles.write_forces(order.slot_of_atom[atom], arrays.f + row, arrays.torque + row);
}

void ContactPipeline::show(const ParticleView &arrays, bool proxies, bool forces) const
{
  in_ranges(proxies ? order.size() : order.owned, [&](int begin, int end) {
    for (int a = begin; a < end; a++) {
      write_state(a, arrays);
      if (forces && order.is_owned(a)) write_forces(a, arrays);
    }
  });
}

void ContactPipeline::take_forces(const ParticleView &arrays)
{
  in_ranges(order.owned, [&](int begin, int end) {
    for (int a = begin; a < end; a++)
      particles.set_forces(order.slot_of_atom[a], arrays.f + 3L * a, arrays.torque + 3L * a);
  });
}

void ContactPipeline::keep_changes(bool yes)
{
  with_changes = yes;
  if (particles.has_room()) particles.keep_changes(yes);
}

}    // namespace Talus
