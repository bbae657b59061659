// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "run/verlet_proxy.h"

#include "run/overlap_hazards.h"
#include "system/host/bonded_styles.h"
#include "system/host/command_words.h"
#include "system/monitor/exchange_report.h"

#include "angle.h"
#include "atom.h"
#include "bond.h"
#include "comm.h"
#include "dihedral.h"
#include "domain.h"
#include "error.h"
#include "force.h"
#include "improper.h"
#include "kspace.h"
#include "modify.h"
#include "neighbor.h"
#include "output.h"
#include "pair.h"
#include "timer.h"
#include "update.h"

#include <cstring>

using namespace LAMMPS_NS;
using namespace Talus;

/* As `verlet` it takes the place of LAMMPS', which ignores words. */

VerletProxy::VerletProxy(LAMMPS *lmp, int narg, char **arg) :
    Verlet(lmp, 0, nullptr), system(GranularSystem::of(lmp)), box_speeds(lmp)
{
  system->setup_state().expect_new_run_style();
  if (std::strcmp(update->integrate_style, "verlet") == 0) return;
  Words words = command_words(lmp, "run_style verlet/proxy", narg, arg, 0, 1);
  if (words.at_end()) return;
  if (!words.take("overlap")) words.fail(0, "expected overlap instead of '" + words.peek() + "'");
  words.about("overlap");
  wanted = words.choice("value", {"yes", "no"}) == 0 ? Overlap::YES : Overlap::NO;
  words.about("");
  words.end();
}

std::string VerletProxy::reason_for_stock() const
{
  const std::string of_pair_style = system->pair_style().reason_against();
  if (!of_pair_style.empty()) return of_pair_style;
  return pair_compute_flag ? "" : "'pair_modify compute no' is set";
}

void VerletProxy::init()
{
  Verlet::init();
  if (system->pair_style().reason_against().empty()) system->exchange().start_run();
}

void VerletProxy::setup(int flag)
{
  if (makes_own_steps() && !lists) lists.emplace(lmp);
  decide_on_overlap();
  system->steps_in_records().report(pair_compute_flag);
  Verlet::setup(flag);
  if (lists) lists->list_is_new();
  set_up = true;
  needs_lists = false;
  system->setup_state().record_setup();
}

void VerletProxy::setup_minimal(int flag)
{
  Verlet::setup_minimal(flag);
  if (flag && lists) lists->list_is_new();
}

/* Whether messages between ranks leave a machine: then some neighbors are on two, since the grid of sub-domains is
   connected. Collective. */

static bool spans_machines(MPI_Comm world)
{
  MPI_Comm machine = MPI_COMM_NULL;
  MPI_Comm_split_type(world, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &machine);
  int ranks = 1, ranks_here = 1;
  MPI_Comm_size(world, &ranks);
  MPI_Comm_size(machine, &ranks_here);
  MPI_Comm_free(&machine);
  int mine = ranks_here < ranks, any = 0;
  MPI_Allreduce(&mine, &any, 1, MPI_INT, MPI_MAX, world);
  return any != 0;
}

/* Within one machine it costs more than messages do. */

void VerletProxy::decide_on_overlap()
{
  bool sought = wanted == Overlap::YES;
  if (wanted == Overlap::AUTOMATIC && makes_own_steps()) {
    if (!on_machines) on_machines = spans_machines(world);
    sought = *on_machines;
  }
  const std::string hazard = sought ? hazard_of_overlap(lmp, pair_compute_flag) : "";
  overlaps = sought && hazard.empty();
  // on one rank without periodic images there is nothing to overlap, and so nothing to warn about
  const bool has_proxies =
      comm->nprocs > 1 || domain->xperiodic || domain->yperiodic || domain->zperiodic;
  if (comm->me == 0 && !hazard.empty() && has_proxies && hazard != announced)
    error->warning(FLERR, "Run style {}: overlap is off: {}", update->integrate_style, hazard);
  announced = hazard;
  if (DirectExchange *proxies = system->exchange().direct()) proxies->set_overlap(overlaps);
}

/* ---------------------------------------------------------------------- */

/* `run ... pre no`. LAMMPS calls the fixes that it has listed, and we those that there are. */

void VerletProxy::go_on_without_set_up()
{
  const std::string change = system->setup_state().change_with_particles();
  if (!change.empty())
    error->all(FLERR, "Run: leave 'pre no' out: {} since the last set-up", change);
  needs_lists = system->setup_state().has_other_ghosts();
}

void VerletProxy::run(int n)
{
  if (!set_up &&
      (system->pair_style().is_there() || system->setup_state().has_another_pair_style()))
    go_on_without_set_up();
  set_up = false;
  if (DirectExchange *proxies = system->exchange().direct()) {
    at_start = proxies->counters();
    proxies->set_overlap(overlaps);
  }
  if (!makes_own_steps() || !lists) return Verlet::run(n);
  lists->start_run(system->lists());
  system->step().start_run(pair_compute_flag);
  box_speeds.start();
  reverses = force->newton && others_act_on_ghosts();
  // an error on the way, or the end of the time allowed, must not leave the arrays of LAMMPS behind
  struct End {
    GranularSystem &system;
    ~End() { system.step().return_to_arrays(); }
  } at_the_end{*system};
  for (int i = 0; i < n; i++) {
    if (timer->check_timeout(i)) {
      update->nsteps = i;
      bring_back();
      break;
    }
    step();
  }
  timer->stamp(Timer::MODIFY);
  lists->end_run(system->lists());
}

/* The pair style does not: every rank computes all contacts of its particles. */

bool VerletProxy::others_act_on_ghosts() const
{
  return has_bonded_forces(*force) || force->kspace || modify->n_pre_force ||
         modify->n_pre_reverse || !system->pair_style().is_alone();
}

/* One step of LAMMPS' Verlet loop, in its order; only the marked places differ. With few particles
   the clock takes a good part of a step: it is read where the kind of work changes, and what ends a
   step is timed together with what begins the next one. */

void VerletProxy::step()
{
  const bigint now = ++update->ntimestep;
  ev_set(now);

  FixCalls &fixes = system->steps_in_records().fix_calls();
  fixes.initial_integrate(vflag);
  fixes.post_integrate();
  timer->stamp(Timer::MODIFY);

  // LAMMPS' decide() waits for all ranks
  const bool is_due = lists->decide([this] { return system->step().moved_since_rebuild(); });
  const bool must_rebuild = is_due || needs_lists;
  needs_lists = false;
  if (must_rebuild) rebuild();
  // LAMMPS' forces are not read in a step after which particles stay in the records
  const bool to_arrays = system->step().begin_forces(now, eflag || vflag);
  if (!must_rebuild)
    system->step().update_proxies(overlaps);    // LAMMPS' forward_comm() is complete at its end
  // asked later where particles move on the way through the computation of forces
  const bool in_records = system->pipeline().motion().holds_state();
  if (!in_records) lists->ask(nullptr);
  if (comm->nprocs > 1 || atom->nghost > 0) timer->stamp(Timer::COMM);

  const bool others_in_arrays = system->step().begin_pair_styles();
  if (to_arrays || others_in_arrays) force_clear();
  compute_forces(to_arrays || others_in_arrays);
  if (others_in_arrays) system->step().end_pair_styles();
  if (in_records) lists->ask(system.get());

  fixes.post_force(vflag);
  fixes.final_integrate();
  fixes.end_of_step();
  box_speeds.correct();

  if (now == output->next) {
    timer->stamp(Timer::MODIFY);
    output->write(now);
    timer->stamp(Timer::OUTPUT);
  }
}

/* Before the end of a run by the time limit, ghosts included. */

void VerletProxy::bring_back()
{
  if (system->step().return_to_arrays()) comm->forward_comm();
}

void VerletProxy::rebuild()
{
  system->step().begin_rebuild();
  timer->stamp(Timer::COMM);
  if (modify->n_pre_exchange) {
    modify->pre_exchange();
    timer->stamp(Timer::MODIFY);
  }
  if (triclinic) domain->x2lamda(atom->nlocal);
  domain->pbc();
  if (domain->box_change) {
    domain->reset_box();
    comm->setup();
    if (neighbor->style) neighbor->setup_bins();
  }
  timer->stamp();
  comm->exchange();
  if (atom->sortfreq > 0 && update->ntimestep >= atom->nextsort) atom->sort();
  comm->borders();
  if (triclinic) domain->lamda2x(atom->nlocal + atom->nghost);
  timer->stamp(Timer::COMM);
  if (modify->n_pre_neighbor) {
    modify->pre_neighbor();
    timer->stamp(Timer::MODIFY);
  }
  neighbor->build(1);
  lists->list_is_new();
  timer->stamp(Timer::NEIGH);
  if (modify->n_post_neighbor) {
    modify->post_neighbor();
    timer->stamp(Timer::MODIFY);
  }
}

/* Pairs come first: some bonded styles add to what the pair style has tallied. */

void VerletProxy::compute_forces(bool to_arrays)
{
  if (modify->n_pre_force) {
    modify->pre_force(vflag);
    timer->stamp(Timer::MODIFY);
  }
  if (pair_compute_flag) {
    force->pair->compute(eflag, vflag);
    timer->stamp(Timer::PAIR);
  }
  // the pair style has done that; everything below may read proxies
  if (DirectExchange *proxies = system->exchange().direct()) proxies->finish();

  if (atom->molecular != Atom::ATOMIC) {
    if (force->bond) force->bond->compute(eflag, vflag);
    if (force->angle) force->angle->compute(eflag, vflag);
    if (force->dihedral) force->dihedral->compute(eflag, vflag);
    if (force->improper) force->improper->compute(eflag, vflag);
    timer->stamp(Timer::BOND);
  }
  if (kspace_compute_flag) {
    force->kspace->compute(eflag, vflag);
    timer->stamp(Timer::KSPACE);
  }
  if (modify->n_pre_reverse) {
    modify->pre_reverse(eflag, vflag);
    timer->stamp(Timer::MODIFY);
  }
  // forces in the records are complete, and those of LAMMPS not up to date
  if (reverses && to_arrays) {
    comm->reverse_comm();
    timer->stamp(Timer::COMM);
  }
}

void VerletProxy::cleanup()
{
  Verlet::cleanup();
  system->setup_state().record();
  if (comm->me == 0 && lists) {
    if (lists->num_delayed())
      error->warning(FLERR,
                     "Run style {}: neighbor lists were {} times made too late: particles "
                     "moved by more than half of the skin before the first check that "
                     "'neigh_modify every {} delay {}' allows: reduce these, or increase the skin",
                     update->integrate_style, lists->num_delayed(), neighbor->every,
                     neighbor->delay);
    if (lists->num_unforeseen())
      error->warning(FLERR,
                     "Run style {}: neighbor lists were {} times made too late: between "
                     "two checks a particle was accelerated by more than the largest speed, or "
                     "moved by something else than its velocity: increase the skin",
                     update->integrate_style, lists->num_unforeseen());
  }
  DirectExchange *proxies = system->exchange().direct();
  if (!proxies) return;
  proxies->set_overlap(false);
  const std::string text = summarize_exchange(proxies->counters().since(at_start), world);
  if (comm->me == 0) utils::logmesg(lmp, text);
}
