// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "system/step/integrators.h"
#include "system/host/fix_list.h"

#include "atom.h"
#include "fix.h"
#include "modify.h"
#include "update.h"

#include <algorithm>

using namespace LAMMPS_NS;

namespace Talus {
namespace {

constexpr std::size_t most_integrators = 32;    // numbered with 8 bits

bool any_rank(bool here, MPI_Comm world)
{
  int mine = here, all = 0;
  MPI_Allreduce(&mine, &all, 1, MPI_INT, MPI_LOR, world);
  return all != 0;
}

}    // namespace

int Integrators::order() const
{
  int highest = 1;
  for (const auto &fix : fix_list(*modify))
    if (const auto *talus_fix = SystemFix::of(fix)) highest = std::max(highest, talus_fix->order());
  return highest;
}

double Integrators::lag() const
{
  for (const auto &fix : fix_list(*modify)) {
    const auto *talus_fix = SystemFix::of(fix);
    if (talus_fix && talus_fix->order() == 2) return talus_fix->lag();
  }
  return 0.0;
}

double Integrators::next_kick() const
{
  double share = 1.0;
  for (const auto &fix : fix_list(*modify))
    if (const auto *talus_fix = SystemFix::of(fix); talus_fix && talus_fix->integrates())
      share = std::min(share, talus_fix->next_kick_in_steps());
  return share * update->dt;
}

/* Those of LAMMPS are of velocity Verlet. */

Kicks Integrators::kicks() const
{
  bool two = false;
  for (const auto &fix : fix_list(*modify)) {
    const auto *talus_fix = SystemFix::of(fix);
    if (talus_fix && talus_fix->integrates()) return talus_fix->kicks();
    if (fix->time_integrate && (modify->get_fix_mask(fix) & FixConst::FINAL_INTEGRATE)) two = true;
  }
  return two ? Kicks{0.5, 0.5} : Kicks{1.0, 0.0};
}

int Integrators::groups_with_changes() const
{
  int bits = 0;
  for (const auto &fix : fix_list(*modify))
    if (const auto *talus_fix = SystemFix::of(fix); talus_fix && talus_fix->keeps_changes())
      bits |= fix->groupbit;
  return bits;
}

/* ---------------------------------------------------------------------- */

void Integrators::start_run()
{
  of_run.clear();
  given.clear();    // an error may have left some
  for (Fix *fix : fix_list(*modify))
    if (auto *talus_fix = SystemFix::of(fix); talus_fix && talus_fix->integrates())
      of_run.push_back({fix, talus_fix});
}

/* Particles that come later, from fix pour, belong to the group all and to one other. */

std::string Integrators::reason_against_records(const Fix *fix_of_shapes) const
{
  if (of_run.empty()) return "no fix nve/sphere/symplectic or nve/sphere/talus moves particles";
  if (of_run.size() > most_integrators) return "many fixes move particles";
  constexpr int all = 1;
  for (std::size_t n = 1; n < of_run.size(); n++)
    for (std::size_t m = 0; m < n; m++) {
      if (of_run[n].fix == fix_of_shapes || of_run[m].fix == fix_of_shapes) continue;
      const int one = of_run[m].fix->groupbit, other = of_run[n].fix->groupbit;
      bool both = one == other || one == all || other == all;
      for (int i = 0; i < atom->nlocal && !both; i++)
        both = (atom->mask[i] & one) && (atom->mask[i] & other);
      if (any_rank(both, world))
        return std::string("fixes ") + of_run[m].fix->id + " and " + of_run[n].fix->id +
               " may move the same particles";
    }
  return "";
}

/* The first one that there is. -1 as well if none does any more: their groups have no common
   members. */

void Integrators::find_movers(int begin, int end, signed char *mover) const
{
  std::fill_n(mover, end - begin, -1);
  for (std::size_t n = of_run.size(); n-- > 0;) {
    const SystemFix &talus_fix = *of_run[n].talus_fix;
    const int bit = of_run[n].fix->groupbit;
    const auto found = static_cast<signed char>(talus_fix.places_particles() ? -1 : n);
    for (int i = begin; i < end; i++)
      if ((atom->mask[i] & bit) && talus_fix.moves_particle(i)) mover[i - begin] = found;
  }
}

bool Integrators::give(const RecordStep &step)
{
  if (given.size() == of_run.size()) given.clear();    // of the step before
  given.push_back(step);
  return given.size() == of_run.size();
}

void Integrators::turn_particles() const
{
  for (const Integrator &one : of_run) one.talus_fix->turn_particles();
}

void Integrators::leave_records()
{
  for (const Integrator &one : of_run) one.talus_fix->leave_records();
}

}    // namespace Talus
