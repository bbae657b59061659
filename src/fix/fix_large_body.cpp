// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "fix/fix_large_body.h"

#include "body/plane.h"
#include "body/rectangle.h"

#include "pair/pair_gran_penalty.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "force.h"
#include "modify.h"
#include "neighbor.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>

using namespace LAMMPS_NS;
using namespace FixConst;
using namespace Talus;

namespace {
constexpr int first_shape_word = 4;    // fix ID group large/body SHAPE ...
constexpr int size_load = 7;
constexpr int size_record = 4;
}    // namespace

/* ---------------------------------------------------------------------- */

FixLargeBody::FixLargeBody(LAMMPS *lmp, int narg, char **arg) : Fix(lmp, narg, arg), masses(lmp)
{
  if (!atom->radius_flag || !atom->rmass_flag || !atom->omega_flag || !atom->torque_flag)
    error->all(FLERR, "Fix large/body requires atom attributes radius, rmass, omega and torque: "
                      "use 'atom_style sphere'");
  specs.resize(atom->ntypes + 1);
  spec_is_set.assign(atom->ntypes + 1, false);

  // `two-sided` is a property of the shape, so it is looked for before the shape is made
  for (int iarg = first_shape_word; iarg < narg; iarg++)
    if (strcmp(arg[iarg], "two-sided") == 0) two_sided = true;
  parse_keywords(parse_shape(narg, arg), narg, arg);
  with_history = std::any_of(specs.begin(), specs.end(),
                             [](const ContactSpec &s) { return s.law.has_history(); });
  with_onset = std::any_of(specs.begin(), specs.end(),
                           [](const ContactSpec &s) { return s.law.has_onset(); });

  vector_flag = 1;
  size_vector = 20;
  global_freq = 1;
  extvector = 0;
  dynamic_group_allow = 1;
  if (!with_history) return;

  restart_global = 1;
  restart_peratom = 1;
  create_attribute = 1;
  maxexchange = size_packed();
  FixLargeBody::grow_arrays(atom->nmax);
  atom->add_callback(Atom::GROW);
  atom->add_callback(Atom::RESTART);
  for (int i = 0; i < atom->nlocal; i++) FixLargeBody::set_arrays(i);
}

FixLargeBody::~FixLargeBody()
{
  if (!with_history) return;
  atom->delete_callback(id, Atom::GROW);
  atom->delete_callback(id, Atom::RESTART);
}

/* ---------------------------------------------------------------------- */

double FixLargeBody::number(int iarg, int narg, char **arg, const char *name)
{
  if (iarg >= narg)
    error->all(FLERR, narg - 1, "fix large/body {}: missing {}", narg > 3 ? arg[3] : "", name);
  const double value = utils::is_double(arg[iarg]) ? std::strtod(arg[iarg], nullptr) : NAN;
  if (!std::isfinite(value))
    error->all(FLERR, iarg, "fix large/body {}: expected a number for {} instead of '{}'", arg[3],
               name, arg[iarg]);
  return value;
}

Vector3<double> FixLargeBody::vector(int iarg, int narg, char **arg, const char *name)
{
  const double x = number(iarg, narg, arg, name), y = number(iarg + 1, narg, arg, name);
  return {x, y, number(iarg + 2, narg, arg, name)};
}

Vector3<double> FixLargeBody::direction(int iarg, int narg, char **arg, const char *name)
{
  const Vector3<double> v = vector(iarg, narg, arg, name);
  const double length = std::sqrt(dot(v, v));
  if (!(length > 0.0))
    error->all(FLERR, iarg, "fix large/body {}: {} must not be zero", arg[3], name);
  return 1.0 / length * v;
}

/* Returns the index of the first word behind the shape. */

int FixLargeBody::parse_shape(int narg, char **arg)
{
  if (narg < first_shape_word)
    error->all(FLERR, "fix large/body: missing shape: plane or rectangle");
  if (strcmp(arg[3], "plane") == 0) {
    make_plane(narg, arg);
    return first_shape_word + 6;
  }
  if (strcmp(arg[3], "rectangle") == 0) {
    make_rectangle(narg, arg);
    return first_shape_word + 11;
  }
  error->all(FLERR, 3, "fix large/body: unknown shape '{}', expected plane or rectangle", arg[3]);
}

void FixLargeBody::make_plane(int narg, char **arg)
{
  const Vector3<double> point = vector(4, narg, arg, "point (px py pz)");
  shape = std::make_unique<Plane>(point, direction(7, narg, arg, "normal (nx ny nz)"), two_sided);
}

void FixLargeBody::make_rectangle(int narg, char **arg)
{
  const Vector3<double> centre = vector(4, narg, arg, "centre (px py pz)");
  const Vector3<double> normal = direction(7, narg, arg, "normal (nx ny nz)");
  const Vector3<double> edge = direction(10, narg, arg, "first edge (ux uy uz)");
  const double lu = number(13, narg, arg, "edge length lu"),
               lv = number(14, narg, arg, "edge length lv");
  if (!(lu > 0.0) || !(lv > 0.0))
    error->all(FLERR, 13, "fix large/body rectangle: edge lengths must be positive");

  // the part of the edge that lies in the plane, so that users need not orthogonalise
  const Vector3<double> inside = edge - dot(edge, normal) * normal;
  const double length = std::sqrt(dot(inside, inside));
  if (length < 1.0e-6)
    error->all(FLERR, 10, "fix large/body rectangle: first edge is parallel to the normal");
  shape = std::make_unique<Rectangle>(centre, normal, 1.0 / length * inside, lu, lv, two_sided);
}

void FixLargeBody::parse_keywords(int iarg, int narg, char **arg)
{
  const CommandWords words{lmp, "fix large/body contact", narg, arg};
  while (iarg < narg) {
    if (strcmp(arg[iarg], "contact") == 0) {
      parse_contact_words(words, ++iarg);
    } else if (strcmp(arg[iarg], "two-sided") == 0) {
      iarg++;
    } else {
      error->all(
          FLERR, iarg,
          "fix large/body: unknown word '{}', expected contact, two-sided, or in a contact {}",
          arg[iarg], contact_keywords);
    }
  }
  for (int type = 1; type <= atom->ntypes; type++)
    if (!spec_is_set[type])
      error->all(FLERR,
                 "fix large/body: no contact law for particles of type {}: add 'contact "
                 "NORMAL args ...' or 'contact types {} NORMAL args ...'",
                 type, type);
}

void FixLargeBody::parse_contact_words(const CommandWords &words, int &iarg)
{
  int lo = 1, hi = atom->ntypes;
  if (iarg < words.narg && strcmp(words.arg[iarg], "types") == 0) {
    if (++iarg >= words.narg)
      error->all(FLERR, iarg - 1, "fix large/body contact: missing types, e.g. 1 or 1*3");
    utils::bounds(FLERR, words.arg[iarg++], 1, atom->ntypes, lo, hi, error);
  }
  const ContactSpec parsed = parse_contact(words, iarg);
  for (int type = lo; type <= hi; type++) {
    specs[type] = parsed;
    spec_is_set[type] = true;
  }
}

void FixLargeBody::set_laws()
{
  LawTable table;
  table.reset(atom->ntypes);
  for (int i = 1; i <= atom->ntypes; i++)    // only the rows (t, t) are used
    for (int j = i; j <= atom->ntypes; j++) table.set(i, j, specs[i].law, coefficients_of(i));
  table.finish();
  contacts.set_laws(table);
}

/* A body given by numbers is used as given; a body given by its material is mixed with the material
   of the particles. Friction and resistance of particles whose own law has none are those of the
   body. */

ContactCoefficients FixLargeBody::coefficients_of(int type)
{
  const ContactSpec &body = specs[type];
  if (!body.is_material()) return contact_coefficients(body, body, FrictionMix::MINIMUM);

  auto *pair = dynamic_cast<PairGranPenalty *>(force->pair_match("gran/penalty", 1, 0));
  const ContactSpec *own = pair ? pair->own_spec(type) : nullptr;
  if (!own || !own->is_material())
    error->all(
        FLERR,
        "Fix large/body {}: the material law {} needs the material of particles of type {}: set "
        "'pair_style gran/penalty' and 'pair_coeff {} {}' with a material law",
        id, name_of(body.law.normal), type, type, type);
  ContactSpec particle = body;
  particle.young = own->young;
  particle.poisson = own->poisson;
  particle.restitution = own->restitution;
  particle.limit_damping = own->limit_damping;
  if (own->law.tangential != TangentialLaw::NONE) particle.given.mu = own->given.mu;
  if (own->law.resists) {
    particle.given.mu_roll = own->given.mu_roll;
    particle.given.mu_spin = own->given.mu_spin;
  }
  return contact_coefficients(body, particle, pair->mix_rule());
}

/* ---------------------------------------------------------------------- */

int FixLargeBody::setmask()
{
  return POST_INTEGRATE | POST_NEIGHBOR | MIN_POST_NEIGHBOR | POST_FORCE | MIN_POST_FORCE;
}

void FixLargeBody::init()
{
  if (utils::strmatch(update->integrate_style, "^respa"))
    error->all(FLERR, "Fix large/body does not run with run_style respa: use run_style verlet");
  masses.find_fixes();
  find_frozen();
  set_laws();
}

double FixLargeBody::contact_period(int type, double mass, double radius)
{
  const double k =
      tangent_stiffness(specs[type].law, coefficients_of(type), 0.01 * radius, mass, radius);
  return k > 0.0 ? std::sqrt(mass / k) : 0.0;
}

/* A fix freeze that stands before this fix in the input has done its work when forces are added
 * here. */

void FixLargeBody::find_frozen()
{
  already_frozen = 0;
  for (const auto &ifix : modify->get_fix_list()) {
    if (ifix == this) break;
    if (utils::strmatch(ifix->style, "^freeze")) already_frozen |= ifix->groupbit;
  }
}

void FixLargeBody::clear_frozen()
{
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(atom->mask[i] & already_frozen)) continue;
    std::fill(atom->f[i], atom->f[i] + 3, 0.0);
    std::fill(atom->torque[i], atom->torque[i] + 3, 0.0);
  }
}

void FixLargeBody::post_integrate()
{
  if (account.waits_for_move()) contacts.account_for_move(view(), update->dt, account);
}

void FixLargeBody::setup_post_neighbor()
{
  post_neighbor();
}

void FixLargeBody::min_post_neighbor()
{
  post_neighbor();
}

void FixLargeBody::post_neighbor()
{
  masses.update();
  contacts.find_candidates(*shape, view(), atom->mask, groupbit, neighbor->skin);
}

void FixLargeBody::setup(int vflag)
{
  post_force(vflag);
}

void FixLargeBody::min_setup(int vflag)
{
  post_force(vflag);
}

void FixLargeBody::min_post_force(int vflag)
{
  post_force(vflag);
}

BodyParticleView FixLargeBody::view() const
{
  if (atom->nlocal == 0) return {};
  return {atom->nlocal,
          atom->x[0],
          atom->v[0],
          atom->omega[0],
          atom->radius,
          atom->rmass,
          masses.override_or_null(),
          atom->type,
          atom->f[0],
          atom->torque[0]};
}

void FixLargeBody::post_force(int /*vflag*/)
{
  const BodyLoad mine = contacts.compute(*shape, view(), update->dt, update->setupflag == 0,
                                         keeps_account ? &account : nullptr);
  if (already_frozen) clear_frozen();
  const double values[size_load] = {mine.force.x,  mine.force.y,  mine.force.z, mine.torque.x,
                                    mine.torque.y, mine.torque.z, mine.contacts};
  std::copy(values, values + size_load, load);
  reduced_at = -1;
}

void FixLargeBody::reduce_load()
{
  if (reduced_at == update->ntimestep) return;
  MPI_Allreduce(load, total_load, size_load, MPI_DOUBLE, MPI_SUM, world);
  reduced_at = update->ntimestep;
}

double FixLargeBody::compute_vector(int n)
{
  reduce_load();
  const Vector3<double> p = shape->reference_point();
  const double at_rest[] = {p.x, p.y, p.z, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
  if (n < 6) return total_load[n];
  return n < 19 ? at_rest[n - 6] : total_load[6];
}

/* ---------------------------------------------------------------------- */

int FixLargeBody::size_packed() const
{
  return with_onset ? 2 * size_record : size_record;
}

void FixLargeBody::grow_arrays(int nmax)
{
  contacts.history.resize(nmax);
  if (with_onset) contacts.onset.resize(nmax);
}

void FixLargeBody::copy_arrays(int i, int j, int /*delflag*/)
{
  contacts.history[j] = contacts.history[i];
  if (with_onset) contacts.onset[j] = contacts.onset[i];
}

void FixLargeBody::set_arrays(int i)
{
  contacts.history[i] = Record{};
  if (with_onset) contacts.onset[i] = Record{};
}

int FixLargeBody::pack_exchange(int i, double *buf)
{
  std::copy(contacts.history[i].c, contacts.history[i].c + size_record, buf);
  if (with_onset)
    std::copy(contacts.onset[i].c, contacts.onset[i].c + size_record, buf + size_record);
  return size_packed();
}

int FixLargeBody::unpack_exchange(int i, double *buf)
{
  std::copy(buf, buf + size_record, contacts.history[i].c);
  if (with_onset) std::copy(buf + size_record, buf + 2 * size_record, contacts.onset[i].c);
  return size_packed();
}

/* The host does not move what it has read for us when particles are deleted before this fix is
 * defined. */

void FixLargeBody::write_restart(FILE *fp)
{
  if (comm->me) return;
  const double count = static_cast<double>(atom->natoms);
  const int size = sizeof count;
  fwrite(&size, sizeof size, 1, fp);
  fwrite(&count, size, 1, fp);
}

void FixLargeBody::restart(char *buf)
{
  double count;
  std::memcpy(&count, buf, sizeof count);
  if (count != static_cast<double>(atom->natoms))
    error->all(FLERR,
               "Fix large/body {}: particles were added or deleted between read_restart and this "
               "command, so "
               "that contact history cannot be assigned: define the fix right after read_restart",
               id);
}

int FixLargeBody::pack_restart(int i, double *buf)
{
  buf[0] = size_restart(i);
  return 1 + pack_exchange(i, buf + 1);
}

/* The restart file may hold less than this fix keeps, or more, if its words have changed. */

void FixLargeBody::unpack_restart(int i, int nth)
{
  double *extra = atom->extra[i];
  int m = 0;
  for (int n = 0; n < nth; n++) m += static_cast<int>(extra[m]);
  const int stored = static_cast<int>(extra[m]) - 1;
  double values[2 * size_record] = {};
  std::copy(extra + m + 1, extra + m + 1 + std::min(stored, 2 * size_record), values);
  unpack_exchange(i, values);
}

int FixLargeBody::size_restart(int /*i*/)
{
  return 1 + size_packed();
}

int FixLargeBody::maxsize_restart()
{
  return 1 + size_packed();
}

double FixLargeBody::memory_usage()
{
  return contacts.memory_usage();
}
