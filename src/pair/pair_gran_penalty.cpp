// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "pair/pair_gran_penalty.h"

#include "comm/pending_exchange.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "fix.h"
#include "force.h"
#include "memory.h"
#include "modify.h"
#include "neigh_list.h"
#include "neighbor.h"
#include "timer.h"
#include "update.h"

#include <algorithm>
#include <functional>
#include <new>
#include <stdexcept>

using namespace LAMMPS_NS;
using namespace Talus;

namespace {

constexpr int num_extra = 11;    // svector, see single()

}    // namespace

/* ---------------------------------------------------------------------- */

PairGranPenalty::PairGranPenalty(LAMMPS *lmp) :
    Pair(lmp), neighbors(lmp), masses(lmp), radii(lmp), monitor(lmp), time_step(lmp)
{
  single_enable = 1;
  no_virial_fdotr_compute = 1;
  centroidstressflag = CENTROID_NOTAVAIL;
  finitecutflag = 1;
  restartinfo = 1;
  respa_enable = 0;
  writedata = 0;
  comm_forward = 1;

  single_extra = num_extra;
  svector = new double[single_extra]();
  nextra = 2;
  pvector = new double[nextra]();

  // keeps the place of the internal fix in the list of fixes until init_style() creates it: only
  // then read_restart has brought what it is to continue with. The ID must be the same in every
  // process.
  store_id = "TALUS_CONTACTS";
  for (int n = 2; modify->get_fix_by_id(store_id) || modify->get_fix_by_id(store_id + "_LATER");
       n++)
    store_id = "TALUS_CONTACTS" + std::to_string(n);
  placeholder_id = store_id + "_LATER";
  modify->add_fix(placeholder_id + " all DUMMY");
}

PairGranPenalty::~PairGranPenalty()
{
  if (copymode) return;
  delete[] svector;
  delete[] pvector;
  for (const auto &internal : {store_id, placeholder_id})
    if (modify->get_fix_by_id(internal)) modify->delete_fix(internal);
  if (allocated) {
    memory->destroy(setflag);
    memory->destroy(cutsq);
  }
}

void PairGranPenalty::allocate()
{
  allocated = 1;
  const int n = atom->ntypes + 1;
  memory->create(setflag, n, n, "pair:setflag");
  memory->create(cutsq, n, n, "pair:cutsq");
  for (int i = 0; i < n; i++)
    for (int j = 0; j < n; j++) setflag[i][j] = 0;
  book.resize(atom->ntypes);
}

/* ---------------------------------------------------------------------- */

void PairGranPenalty::init_style()
{
  check_host();
  neighbors.init(this);
  masses.find_fixes();
  radii.find(masses.frozen_groups());
  create_store();
  monitor.start();
  time_step.start();
  laws_current = false;    // init_one() will mix what is not set
}

void PairGranPenalty::check_host()
{
  if (!atom->radius_flag || !atom->rmass_flag || !atom->omega_flag || !atom->torque_flag)
    error->all(FLERR, "Pair style gran/penalty requires atom attributes radius, rmass, omega and "
                      "torque: use 'atom_style sphere'");
  if (comm->ghost_velocity == 0)
    error->all(FLERR, "Pair style gran/penalty requires ghost atoms to store velocity: "
                      "add 'comm_modify vel yes'");
  if (force->newton_pair)
    error->all(FLERR, "Pair style gran/penalty requires 'newton off': put it before the simulation "
                      "box is defined");
  if (!atom->tag_enable)
    error->all(FLERR, "Pair style gran/penalty requires atom IDs: remove 'atom_modify id no'");
  if (lmp->kokkos)
    error->all(FLERR, "Pair style gran/penalty does not run with the KOKKOS package: "
                      "start LAMMPS without '-k on'");
}

void PairGranPenalty::create_store()
{
  const std::string &expected = store ? store_id : placeholder_id;
  if (!modify->get_fix_by_id(expected))
    error->all(FLERR,
               "Pair style gran/penalty: its internal fix {} has been deleted: remove the unfix "
               "command",
               expected);
  if (!store) {
    // well below the smallest particle of usual scenes: tags decide only where keys are equal
    const double cell = radii.largest() > 0.0 ? 0.125 * radii.largest() : 1.0;
    const auto command = fmt::format("{} all CONTACT_STORE {:.17g}", store_id, cell);
    store = dynamic_cast<FixContactStore *>(modify->replace_fix(placeholder_id, command, 1));
    if (!store) error->all(FLERR, "Pair style gran/penalty: cannot create fix {}", store_id);
    store->serve(this);
  }
}

double PairGranPenalty::init_one(int i, int j)
{
  if (setflag[i][j] == 0) {
    if (setflag[i][i] == 0 || setflag[j][j] == 0)
      error->all(FLERR, "Pair style gran/penalty: no pair_coeff for types {} and {}", i, j);
    if (book.spec(i, i).law != book.spec(j, j).law)
      error->all(FLERR,
                 "Pair style gran/penalty: types {} ({}) and {} ({}) have different laws: "
                 "add 'pair_coeff {} {} ...'",
                 i, describe_law(book.law(i, i)), j, describe_law(book.law(j, j)), i, j);
    if (!book.can_mix(i, j))
      error->all(FLERR,
                 "Pair style gran/penalty: types {} and {} have a number and NULL for kt or gt, or "
                 "adhesion of different kinds: add 'pair_coeff {} {} ...'",
                 i, j, i, j);
  }
  return radii.cutoff(i, j);
}

/* Once all pairs of types are known: at the first rebuild of a run, or the first question. */

void PairGranPenalty::prepare_laws()
{
  const LawTable table = book.table();
  store->keep_impacts(table.has_impact());
  pipeline.set_laws(table);
  laws_current = true;

  const std::string description = "Talus gran/penalty: " + book.describe(table);
  if (comm->me == 0 && description != announced) utils::logmesg(lmp, description);
  announced = description;
  warn_small_periods();
}

const ContactSpec *PairGranPenalty::own_spec(int type) const
{
  return allocated && book.is_set(type, type) ? &book.spec(type, type) : nullptr;
}

void PairGranPenalty::warn_small_periods()
{
  if (!pipeline.keeps_history() || comm->me) return;
  const double cut = 2.0 * radii.largest();
  for (int d = 0; d < 3; d++)
    if (domain->periodicity[d] && !(domain->dimension == 2 && d == 2) && domain->prd[d] < 2.0 * cut)
      error->warning(
          FLERR,
          "Pair style gran/penalty: the box is periodic in {} with a period below "
          "two diameters: particles that touch from both sides share one contact history",
          "xyz"[d]);
}

/* ---------------------------------------------------------------------- */

void PairGranPenalty::look_at_pairs()
{
  monitor.look(pipeline);
  time_step.look_for_smaller_particles(book);
}

void PairGranPenalty::keep_history(HistoryStore &to, HistoryStore::Scope scope, bool pairs_stay)
{
  pipeline.keep_history(to, scope, pairs_stay);
}

void PairGranPenalty::release_records()
{
  if (!account.waits_for_move()) pipeline.release_records();
}

void PairGranPenalty::velocities_have_moved()
{
  if (account.waits_for_move())
    pipeline.account_for_move(atom->v[0], atom->omega[0], update->dt, account);
}

/* Called after a rebuild by the host, so that its timer stands at the fixes; the work is that of
   neighbor lists. */

void PairGranPenalty::renumber_pairs()
{
  if (!laws_current) prepare_laws();
  timer->stamp(Timer::MODIFY);
  pipeline.release();
  const int nall = atom->nlocal + atom->nghost;
  const std::vector<std::int64_t> tags(atom->tag, atom->tag + nall);
  const auto *exchange = dynamic_cast<PendingExchange *>(comm);
  pipeline.set_work(comm->nthreads, exchange && exchange->overlaps());
  try {
    pipeline.set_pairs({atom->nlocal, store->all_keys(), tags, atom->type}, neighbors.find(list));
    neighbors.release();
    pipeline.start_pairs(store->histories());
  } catch (const std::length_error &problem) {
    error->one(FLERR, "Pair style gran/penalty: {}: use more ranks", problem.what());
  } catch (const std::bad_alloc &) {
    error->one(FLERR,
               "Pair style gran/penalty: not enough memory for the pairs of {} particles and {} "
               "ghosts of a rank: use more machines",
               atom->nlocal, atom->nghost);
  }
  store->pairs_are_numbered(pipeline.particle_order());
  timer->stamp(Timer::NEIGH);
  masses.update();
  if (masses.needed()) comm->forward_comm(this);
}

int PairGranPenalty::pack_forward_comm(int n, int *send, double *buf, int, int *)
{
  for (int k = 0; k < n; k++) buf[k] = masses.override_or_null()[send[k]];
  return n;
}

void PairGranPenalty::unpack_forward_comm(int n, int first, double *buf)
{
  std::copy(buf, buf + n, masses.override_or_null() + first);
}

ParticleView PairGranPenalty::view() const
{
  const bool any = atom->nlocal + atom->nghost > 0;
  return {any ? atom->x[0] : nullptr,
          any ? atom->v[0] : nullptr,
          any ? atom->omega[0] : nullptr,
          atom->radius,
          atom->rmass,
          masses.override_or_null(),
          any ? atom->f[0] : nullptr,
          any ? atom->torque[0] : nullptr};
}

/* ---------------------------------------------------------------------- */

void PairGranPenalty::compute(int eflag, int vflag)
{
  ev_init(eflag, vflag);
  if (!pipeline.has_pairs() || pipeline.num_particles() != atom->nlocal + atom->nghost) {
    finish_exchange();
    renumber_pairs();    // as after `run pre no`
  }

  const bool advance = update->setupflag == 0;
  const std::function<void(const ReportedContact &)> to_host = [this](const ReportedContact &c) {
    tally(c);
  };
  ContactStep step{update->dt, advance, vflag_either ? &to_host : nullptr,
                   keeps_account ? &account : nullptr};
  step.read = !pipeline.holds_state();
  step.read_ghosts = !proxies_are_there;
  step.deliver = !keeps_state;
  const std::size_t joined = others_that_join();
  const std::function<void(int, int, int)> add_others = [&](int thread, int begin, int end) {
    for (std::size_t n = 0; n < joined; n++) others[n]->add_to_slots(thread, begin, end);
  };
  if (joined) step.add_more = &add_others;
  proxies_are_there = false;
  if (pipeline.in_two_phases()) {
    auto *exchange = dynamic_cast<PendingExchange *>(comm);
    const std::function<void()> progress = [exchange] { exchange->progress(); };
    if (exchange && exchange->pending()) step.meanwhile = &progress;
    pipeline.compute_early(view(), step);
    step.meanwhile = nullptr;
    finish_exchange();
    pipeline.compute_late(view(), step);
  } else {
    finish_exchange();
    pipeline.compute(view(), step);
  }
  if (step.deliver && !step.read && atom->nlocal)
    pipeline.write_state(atom->x[0], atom->v[0], atom->omega[0]);
  store->pairs_are_current();

  if (update->setupflag) time_step.judge_start(book, pipeline);
  if (eflag_global) count_contacts();
}

/* Under run style verlet/proxy: from here on proxies are valid. What was done before counts as
   pair time, the rest as communication. */

void PairGranPenalty::finish_exchange()
{
  auto *exchange = dynamic_cast<PendingExchange *>(comm);
  if (!exchange || !exchange->pending()) return;
  timer->stamp(Timer::PAIR);
  exchange->finish();
  timer->stamp(Timer::COMM);
}

bool PairGranPenalty::reads_proxy_spins() const
{
  return !laws_current || pipeline.keeps_spins() || pipeline.law_table().has_resistance();
}

double PairGranPenalty::share_without_proxies() const
{
  return pipeline.in_two_phases() ? pipeline.early_share() : 0.0;
}

/* To the host, with newton off, an index of a ghost means that nothing is tallied for it. */

void PairGranPenalty::tally(const ReportedContact &c)
{
  const int nobody = atom->nlocal;
  ev_tally_xyz(c.for_i ? c.i : nobody, c.for_j ? c.j : nobody, nobody, 0, 0.0, 0.0, c.force[0],
               c.force[1], c.force[2], c.separation[0], c.separation[1], c.separation[2]);
}

/* For compute pair: contacts and candidate pairs. One that two ranks compute counts half on each.
 */

void PairGranPenalty::count_contacts()
{
  pvector[0] = pipeline.count_contacts();
  pvector[1] = pipeline.count_candidates();
}

/* ---------------------------------------------------------------------- */

double PairGranPenalty::memory_usage()
{
  return pipeline.memory_usage() + neighbors.memory_usage();
}

double PairGranPenalty::atom2cut(int i)
{
  return 2.0 * atom->radius[i];
}

double PairGranPenalty::radii2cut(double r1, double r2)
{
  return r1 + r2;
}
