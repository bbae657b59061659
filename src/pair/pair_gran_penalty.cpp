// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "pair/pair_gran_penalty.h"

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
#include "update.h"

#include <algorithm>
#include <cmath>
#include <cstring>

using namespace LAMMPS_NS;
using namespace Talus;

namespace {

constexpr int num_extra = 11;    // svector: ten entries as the stock gran/* styles, then overlap/radius

Vector3<double> row(const double *p)
{
  return {p[0], p[1], p[2]};
}

std::string describe(ContactLaw law)
{
  std::string text = fmt::format("{} + {}", name_of(law.normal), name_of(law.tangential));
  if (law.resists) text += law.delayed ? " + delayed resistance" : " + resistance";
  if (law.adheres) text += " + adhesion";
  return text;
}

}    // namespace

/* ---------------------------------------------------------------------- */

PairGranPenalty::PairGranPenalty(LAMMPS *lmp) : Pair(lmp), masses(lmp)
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

  // keeps the place of the internal fix in the list of fixes until init_style() creates it: only then
  // read_restart has brought what it is to continue with. The ID must be the same in every process.
  store_id = "TALUS_CONTACTS";
  for (int n = 2; modify->get_fix_by_id(store_id) || modify->get_fix_by_id(store_id + "_LATER"); n++)
    store_id = "TALUS_CONTACTS" + std::to_string(n);
  placeholder_id = store_id + "_LATER";
  modify->add_fix(placeholder_id + " all DUMMY");
}

PairGranPenalty::~PairGranPenalty()
{
  if (copymode) return;
  delete[] svector;
  delete[] pvector;
  modify->delete_fix(store ? store_id : placeholder_id);
  if (allocated) {
    memory->destroy(setflag);
    memory->destroy(cutsq);
  }
}

void PairGranPenalty::allocate()
{
  allocated = 1;
  atom_types = atom->ntypes;
  const int n = atom_types + 1;
  memory->create(setflag, n, n, "pair:setflag");
  memory->create(cutsq, n, n, "pair:cutsq");
  for (int i = 0; i < n; i++)
    for (int j = 0; j < n; j++) setflag[i][j] = 0;
  specs.assign(n * n, ContactSpec{});
}

/* ---------------------------------------------------------------------- */

void PairGranPenalty::settings(int narg, char **arg)
{
  friction_mix = FrictionMix::MINIMUM;
  if (narg == 0) return;
  if (strcmp(arg[0], "mix") != 0)
    error->all(FLERR, 1, "pair_style gran/penalty: unknown word '{}', expected mix", arg[0]);
  if (narg < 2)
    error->all(FLERR, 1, "pair_style gran/penalty: missing rule after mix: "
               "min, arithmetic or geometric");
  if (strcmp(arg[1], "min") == 0)
    friction_mix = FrictionMix::MINIMUM;
  else if (strcmp(arg[1], "arithmetic") == 0)
    friction_mix = FrictionMix::ARITHMETIC;
  else if (strcmp(arg[1], "geometric") == 0)
    friction_mix = FrictionMix::GEOMETRIC;
  else
    error->all(FLERR, 2, "pair_style gran/penalty: unknown rule '{}' after mix, "
               "expected min, arithmetic or geometric", arg[1]);
  if (narg > 2)
    error->all(FLERR, 3, "pair_style gran/penalty: surplus word '{}'", arg[2]);
}

void PairGranPenalty::coeff(int narg, char **arg)
{
  if (!allocated) allocate();
  // under pair hybrid the name of the style has been taken out of the words
  const int shift = utils::strmatch(force->pair_style, "^hybrid") ? 1 : 0;
  const CommandWords words{lmp, "pair_coeff gran/penalty", narg, arg, shift};
  if (narg < 3)
    error->all(FLERR, "pair_coeff gran/penalty: expected two types and a contact law, e.g. "
               "'pair_coeff * * hertz kn gn tangential multistep NULL NULL mu'");

  int ilo, ihi, jlo, jhi;
  utils::bounds(FLERR, arg[0], 1, atom->ntypes, ilo, ihi, error);
  utils::bounds(FLERR, arg[1], 1, atom->ntypes, jlo, jhi, error);

  int iarg = 2;
  const ContactSpec parsed = parse_contact(words, iarg);
  if (iarg < narg)
    error->all(FLERR, iarg + shift, "pair_coeff gran/penalty: unknown word '{}', expected {}",
               arg[iarg], contact_keywords);

  int count = 0;
  for (int i = ilo; i <= ihi; i++)
    for (int j = std::max(jlo, i); j <= jhi; j++) {
      spec(i, j) = parsed;
      setflag[i][j] = 1;
      count++;
    }
  if (count == 0)
    error->all(FLERR, "pair_coeff gran/penalty: no pair of types in '{} {}', write the lower type "
               "first", arg[0], arg[1]);
  laws_current = false;
}

/* ---------------------------------------------------------------------- */

void PairGranPenalty::init_style()
{
  check_host();
  neighbor->add_request(this, NeighConst::REQ_SIZE);
  masses.find_fixes();
  find_largest_radii();
  create_store();
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

void PairGranPenalty::largest_future_radii(std::vector<double> &radius)
{
  for (const char *style : {"^pour", "^deposit"})
    for (const auto &ifix : modify->get_fix_by_style(style))
      for (int type = 1; type <= atom->ntypes; type++) {
        int itype = type;
        auto *largest = static_cast<double *>(ifix->extract("radius", itype));
        if (largest) radius[type] = std::max(radius[type], *largest);
      }
}

void PairGranPenalty::find_largest_radii()
{
  const int n = atom->ntypes + 1;
  std::vector<double> mine(n, 0.0), mine_frozen(n, 0.0);
  largest_future_radii(mine);
  for (int i = 0; i < atom->nlocal; i++) {
    double &r = (atom->mask[i] & masses.frozen_groups() ? mine_frozen : mine)[atom->type[i]];
    r = std::max(r, atom->radius[i]);
  }
  largest_free.resize(n);
  largest_frozen.resize(n);
  MPI_Allreduce(mine.data(), largest_free.data(), n, MPI_DOUBLE, MPI_MAX, world);
  MPI_Allreduce(mine_frozen.data(), largest_frozen.data(), n, MPI_DOUBLE, MPI_MAX, world);
  largest_radius = std::max(*std::max_element(largest_free.begin(), largest_free.end()),
                            *std::max_element(largest_frozen.begin(), largest_frozen.end()));
}

void PairGranPenalty::create_store()
{
  if (!store) {
    const double cell = largest_radius > 0.0 ? 2.0 * largest_radius : 1.0;
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
    const ContactLaw a = spec(i, i).law, b = spec(j, j).law;
    if (a != b)
      error->all(FLERR, "Pair style gran/penalty: types {} ({}) and {} ({}) have different laws: "
                 "add 'pair_coeff {} {} ...'", i, describe(a), j, describe(b), i, j);
  }
  return std::max({largest_free[i] + largest_free[j], largest_frozen[i] + largest_free[j],
                   largest_free[i] + largest_frozen[j]});
}

/* Once all pairs of types are known. Pairs that another sub-style of a hybrid style computes never come
   up: they get the row of a pair that does, so that uniform laws are recognised as such. */

void PairGranPenalty::prepare_laws()
{
  LawTable table;
  table.reset(atom_types);
  const auto is_mine = [&](int i, int j) {
    return setflag[i][j] || (setflag[i][i] && setflag[j][j] && spec(i, i).law == spec(j, j).law);
  };
  int any_i = 1, any_j = 1;
  for (int i = atom_types; i >= 1; i--)
    for (int j = atom_types; j >= i; j--)
      if (is_mine(i, j)) {
        any_i = i;
        any_j = j;
      }
  for (int i = 1; i <= atom_types; i++)
    for (int j = i; j <= atom_types; j++) {
      const bool mine = is_mine(i, j);
      table.set(i, j, law_of(mine ? i : any_i, mine ? j : any_j),
                coefficients_of(mine ? i : any_i, mine ? j : any_j));
    }
  table.finish();
  store->keep_onsets(table.has_onset());
  pipeline.set_laws(table);
  laws_current = true;

  const std::string description = describe_laws();
  if (comm->me == 0 && description != announced) utils::logmesg(lmp, description);
  announced = description;
  warn_small_periods();
}

/* Law and coefficients of a pair of types: as set, or mixed from those of the two types. */

ContactLaw PairGranPenalty::law_of(int i, int j)
{
  return (setflag[i][j] ? spec(i, j) : spec(i, i)).law;
}

ContactCoefficients PairGranPenalty::coefficients_of(int i, int j)
{
  if (setflag[i][j]) return contact_coefficients(spec(i, j), spec(i, j), friction_mix);
  return contact_coefficients(spec(i, i), spec(j, j), friction_mix);
}

const ContactSpec *PairGranPenalty::own_spec(int type)
{
  return allocated && setflag[type][type] ? &spec(type, type) : nullptr;
}

std::string PairGranPenalty::describe_laws() const
{
  const LawTable &table = pipeline.law_table();
  std::string laws, left_out;
  for (int n = 0; n < table.num_laws(); n++) {
    const ContactLaw law = table.distinct_law(n);
    laws += (n ? ", " : "") + describe(law);
  }
  if (!table.has_resistance()) left_out += " rolling and spinning resistance;";
  if (!table.has_onset()) left_out += " impact speed and age of contacts;";
  if (!table.has_history()) left_out += " contact history (no multistep law);";
  if (!table.has_friction()) left_out += " spins and torques (no friction);";
  if (table.uniform()) left_out += " look-up by type (one set of coefficients);";
  if (!left_out.empty()) left_out.back() = '\n';
  return fmt::format("Talus gran/penalty: kernels {}; {}\n", laws, instruction_set()) +
      (left_out.empty() ? "" : "  left out:" + left_out);
}

void PairGranPenalty::warn_small_periods()
{
  if (!pipeline.keeps_history() || comm->me) return;
  const double cut = 2.0 * largest_radius;
  for (int d = 0; d < 3; d++)
    if (domain->periodicity[d] && !(domain->dimension == 2 && d == 2) && domain->prd[d] < 2.0 * cut)
      error->warning(FLERR, "Pair style gran/penalty: the box is periodic in {} with a period below "
                     "two diameters: particles that touch from both sides share one contact history",
                     "xyz"[d]);
}

/* ---------------------------------------------------------------------- */

void PairGranPenalty::file_history(PartnerLists &partners)
{
  pipeline.file_history(partners);
}

void PairGranPenalty::renumber_pairs()
{
  if (!laws_current) prepare_laws();
  const int nall = atom->nlocal + atom->nghost;
  std::vector<std::uint64_t> keys(nall);
  std::vector<std::int64_t> tags(nall);
  for (int i = 0; i < nall; i++) {
    keys[i] = store->key(i);
    tags[i] = atom->tag[i];
  }
  pipeline.pairs.order_particles(atom->nlocal, keys, std::move(tags));
  add_candidate_pairs();
  pipeline.pairs.finish();
  pipeline.start_pairs(atom->type, store->partner_lists());
  masses.update();
  if (masses.needed()) comm->forward_comm(this);
}

void PairGranPenalty::add_candidate_pairs()
{
  const double *special = force->special_lj;
  for (int ii = 0; ii < list->inum; ii++) {
    const int i = list->ilist[ii];
    const int *neighbors = list->firstneigh[i];
    for (int jj = 0; jj < list->numneigh[i]; jj++) {
      const double weight = special[sbmask(neighbors[jj])];
      if (weight != 0.0) pipeline.pairs.add_pair(i, neighbors[jj] & NEIGHMASK, weight);
    }
  }
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
  return {any ? atom->x[0] : nullptr,     any ? atom->v[0] : nullptr,
          any ? atom->omega[0] : nullptr, atom->radius,
          atom->rmass,                    masses.override_or_null()};
}

/* ---------------------------------------------------------------------- */

void PairGranPenalty::compute(int eflag, int vflag)
{
  ev_init(eflag, vflag);
  if (pipeline.pairs.num_particles() != atom->nlocal + atom->nghost) renumber_pairs();

  reported.clear();
  const bool advance = update->setupflag == 0;
  pipeline.compute(view(), update->dt, advance, vflag_either ? &reported : nullptr);
  store->pairs_are_current();
  if (atom->nlocal) pipeline.add_forces(atom->f[0], atom->torque[0]);

  if (vflag_either) tally(reported);
  if (eflag_global) count_contacts();
}

void PairGranPenalty::tally(const std::vector<ReportedContact> &contacts)
{
  for (const ReportedContact &c : contacts)
    ev_tally_xyz(c.i, c.j, atom->nlocal, 0, 0.0, 0.0, c.force[0], c.force[1], c.force[2],
                 c.separation[0], c.separation[1], c.separation[2]);
}

/* For compute pair: contacts and candidate pairs. One that two ranks compute counts half on each. */

void PairGranPenalty::count_contacts()
{
  pvector[0] = pipeline.count_contacts();
  pvector[1] = pipeline.count_candidates();
}

double PairGranPenalty::single(int i, int j, int itype, int jtype, double rsq, double, double,
                               double &fforce)
{
  fforce = 0.0;
  if (!laws_current) prepare_laws();
  std::fill(svector, svector + single_extra, 0.0);
  const double ri = atom->radius[i], rj = atom->radius[j];
  if (rsq >= (ri + rj) * (ri + rj) || rsq == 0.0) return 0.0;

  const double r = std::sqrt(rsq);
  ContactState<double> s;
  s.normal = (1.0 / r) * (row(atom->x[i]) - row(atom->x[j]));
  s.overlap = ri + rj - r;
  s.velocity = row(atom->v[i]) - row(atom->v[j]);
  s.spin = ri * row(atom->omega[i]) + rj * row(atom->omega[j]);
  s.inverse_mass = 1.0 / masses.mass(i) + 1.0 / masses.mass(j);
  s.inverse_radius = 1.0 / ri + 1.0 / rj;
  s.relative_spin = row(atom->omega[i]) - row(atom->omega[j]);
  s.circle = circle_of_intersection(ri, rj, s.overlap);

  const int row_of_types = pipeline.law_table().row(itype, jtype);
  const ContactForce<double> out = single_contact(
      pipeline.law_table().law(row_of_types), pipeline.law_table().coefficients(row_of_types), s,
      update->dt, pipeline.history_of(i, j), pipeline.onset_of(i, j));

  const Vector3<double> vn = dot(s.velocity, s.normal) * s.normal, vt = s.velocity - vn;
  const Vector3<double> ft = out.tangential;
  const double extra[num_extra] = {ft.x, ft.y, ft.z, std::sqrt(dot(ft, ft)), vn.x, vn.y, vn.z,
                                   vt.x, vt.y, vt.z, s.overlap / std::min(ri, rj)};
  std::copy(extra, extra + num_extra, svector);
  fforce = out.normal / r;
  return 0.0;
}

/* ---------------------------------------------------------------------- */

void PairGranPenalty::write_restart(FILE *fp)
{
  write_restart_settings(fp);
  for (int i = 1; i <= atom_types; i++)
    for (int j = i; j <= atom_types; j++) {
      fwrite(&setflag[i][j], sizeof(int), 1, fp);
      fwrite(&spec(i, j), sizeof(ContactSpec), 1, fp);
    }
}

void PairGranPenalty::read_restart(FILE *fp)
{
  read_restart_settings(fp);
  if (!allocated) allocate();
  for (int i = 1; i <= atom_types; i++)
    for (int j = i; j <= atom_types; j++) {
      if (comm->me == 0) {
        utils::sfread(FLERR, &setflag[i][j], sizeof(int), 1, fp, nullptr, error);
        utils::sfread(FLERR, &spec(i, j), sizeof(ContactSpec), 1, fp, nullptr, error);
      }
      MPI_Bcast(&setflag[i][j], 1, MPI_INT, 0, world);
      MPI_Bcast(&spec(i, j), sizeof(ContactSpec), MPI_BYTE, 0, world);
    }
}

void PairGranPenalty::write_restart_settings(FILE *fp)
{
  fwrite(&friction_mix, sizeof friction_mix, 1, fp);
}

void PairGranPenalty::read_restart_settings(FILE *fp)
{
  if (comm->me == 0)
    utils::sfread(FLERR, &friction_mix, sizeof friction_mix, 1, fp, nullptr, error);
  MPI_Bcast(&friction_mix, sizeof friction_mix, MPI_BYTE, 0, world);
}

/* ---------------------------------------------------------------------- */

double PairGranPenalty::memory_usage()
{
  return pipeline.memory_usage() +
      static_cast<double>(reported.capacity() * sizeof(ReportedContact));
}

double PairGranPenalty::atom2cut(int i)
{
  return 2.0 * atom->radius[i];
}

double PairGranPenalty::radii2cut(double r1, double r2)
{
  return r1 + r2;
}
