/* Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE */

// Steps in the records: particles are moved there, and contacts see them in rows of the arrays of
// the host, where those of particles with a shape and of their partners are copied to. Orientations
// are with this fix in any case. The order of sums is that of a step in the arrays.

#include "fix/fix_shape_gran.h"

#include "base/in_parallel.h"
#include "fix/orientations.h"

#include "atom.h"
#include "comm.h"
#include "force.h"
#include "update.h"

#include <algorithm>

using namespace LAMMPS_NS;
using namespace Talus;

std::string FixShapeGran::needs_host_arrays()
{
  if (!system->pipeline().keeps_spins())
    return "it turns particles and the contacts between them have no friction";
  if (system->account().is_asked())
    return "the energies of contacts of particles with a shape are asked for";
  return "";
}

/* At a rebuild, when pairs are known. */

void FixShapeGran::list_lent()
{
  lent = pairs.members();
  for (int i = 0; i < atom->nlocal; i++)
    if (is_shaped(atom->type[i])) lent.push_back(i);
  std::sort(lent.begin(), lent.end());
  lent.erase(std::unique(lent.begin(), lent.end()), lent.end());
  const auto first_ghost = std::lower_bound(lent.begin(), lent.end(), atom->nlocal);
  lent_owned = static_cast<int>(first_ghost - lent.begin());
}

void FixShapeGran::show_lent()
{
  const ParticleRecords &records = system->records();
  const int *slot = system->slot_of_atom();
  ChangeRecord *changes = records.keeps_changes() ? system->velocity_changes() : nullptr;
  in_ranges(static_cast<std::int64_t>(lent.size()), comm->nthreads, [&](int, int begin, int end) {
    for (int n = begin; n < end; n++) {
      const int i = lent[n];
      records.write_state(slot[i], atom->x[i], atom->v[i], atom->omega[i]);
      if (changes) changes[i] = records.change[slot[i]];
    }
  });
  show_forces();
}

void FixShapeGran::show_forces()
{
  const ParticleRecords &records = system->records();
  const int *slot = system->slot_of_atom();
  in_ranges(lent_owned, comm->nthreads, [&](int, int begin, int end) {
    for (int n = begin; n < end; n++)
      records.write_forces(slot[lent[n]], atom->f[lent[n]], atom->torque[lent[n]]);
  });
}

void FixShapeGran::take_forces()
{
  ParticleRecords &records = system->records();
  const int *slot = system->slot_of_atom();
  in_ranges(lent_owned, comm->nthreads, [&](int, int begin, int end) {
    for (int n = begin; n < end; n++) {
      const int i = lent[n], s = slot[i];
      records.settle_torque(s);
      std::copy_n(atom->f[i], 3, records.load[2L * s].c);
      std::copy_n(atom->torque[i], 3, records.load[2L * s + 1].c);
    }
  });
}

/* The forces on frozen particles are not cleared there. */

void FixShapeGran::advance_in_records()
{
  ParticleRecords &records = system->records();
  const int *slot = system->slot_of_atom();
  in_ranges(atom->nlocal, comm->nthreads, [&](int, int begin, int end) {
    for (int i = begin; i < end; i++) {
      if (!moves_particle(i)) continue;
      const int s = slot[i];
      Record *motion = &records.motion[2L * s];
      Record turn;
      store(turn, records.torque(s));
      Loads loads{{0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}};
      if (motion[0].c[3] > 0.0) loads = {row(records.load[2L * s].c), row(turn.c)};
      if (records.keeps_changes()) keep_change(records.change[s], i, loads);
      move(i, loads, records.position[s].c, motion[0].c, motion[1].c);
    }
  });
  RecordStep step{update->dt, update->dt * force->ftm2v, {0.0, 0.0, 0.0}, 0.4};
  step.extrapolation = 0.5;
  system->advance(step);
}
