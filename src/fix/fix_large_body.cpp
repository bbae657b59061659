// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "fix/fix_large_body.h"

#include "fix/large_body_shapes.h"
#include "fix/region_shape.h"

#include "system/command_words.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "force.h"
#include "modify.h"
#include "neighbor.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <cstring>

using namespace LAMMPS_NS;
using namespace FixConst;
using namespace Talus;

/* ---------------------------------------------------------------------- */

FixLargeBody::FixLargeBody(LAMMPS *lmp, int narg, char **arg) :
    Fix(lmp, narg, arg), system(GranularSystem::of(lmp)), motion(lmp), monitor(lmp), masses(lmp)
{
  if (!atom->radius_flag || !atom->rmass_flag || !atom->omega_flag || !atom->torque_flag)
    error->all(FLERR, "Fix large/body requires atom attributes radius, rmass, omega and torque: "
                      "use 'atom_style sphere'");
  specs.resize(atom->ntypes + 1);
  spec_is_set.assign(atom->ntypes + 1, false);

  // `two-sided` is a property of the shape, so it is looked for before the shape is made
  Words words = command_words(lmp, "fix large/body", narg, arg, 3);
  for (int iarg = 4; iarg < narg; iarg++)
    if (strcmp(arg[iarg], "two-sided") == 0) two_sided = true;
  shape = LargeBodyShapes(lmp, words).parse(two_sided);
  surface = std::make_unique<LargeBodySurface>(lmp, *shape);
  parse_keywords(words);
  motion.finish(shape->reference_point());
  with_history = std::any_of(specs.begin(), specs.end(),
                             [](const ContactSpec &s) { return s.law.has_history(); });
  with_impact = std::any_of(specs.begin(), specs.end(),
                            [](const ContactSpec &s) { return s.law.has_impact(); });
  offer_output();
  keep_history();
  system->run_monitor().add(this,
                            monitor.checks([this] { return find_worst(); }, motion.moves(), id));
}

FixLargeBody::~FixLargeBody()
{
  system->run_monitor().remove(this);
  finish_reduction();
  if (!with_history) return;
  atom->delete_callback(id, Atom::GROW);
  atom->delete_callback(id, Atom::RESTART);
}

void FixLargeBody::offer_output()
{
  scalar_flag = vector_flag = 1;
  extscalar = 1;
  size_vector = 20;
  extvector = 0;
  global_freq = 1;
  energy_global_flag = 1;
  virial_global_flag = virial_peratom_flag = 1;
  dynamic_group_allow = 1;
  time_depend = motion.depends_on_time() ? 1 : 0;
  restart_global = with_history || motion.moves() || surface->records() ? 1 : 0;
  nevery = surface->picture_interval();
  if (!surface->records()) return;
  array_flag = 1;
  size_array_rows = surface->size();
  size_array_cols = LargeBodySurface::columns;
  extarray = 0;
}

/* ---------------------------------------------------------------------- */

void FixLargeBody::parse_keywords(Words &words)
{
  while (!words.at_end()) {
    words.about("");
    if (words.take("contact")) {
      parse_contact_words(words);
    } else if (words.take("two-sided") || motion.parse(words) || surface->parse(words)) {
      continue;
    } else {
      words.fail(0, "unknown word '" + words.peek() +
                        "', expected contact, two-sided, move, servo, gravity, load, pressure, "
                        "vtk, or in a contact " +
                        contact_keywords);
    }
  }
  for (int type = 1; type <= atom->ntypes; type++)
    if (!spec_is_set[type])
      error->all(FLERR,
                 "fix large/body: no contact law for particles of type {}: add 'contact "
                 "NORMAL args ...' or 'contact types {} NORMAL args ...'",
                 type, type);
}

void FixLargeBody::parse_contact_words(Words &words)
{
  int lo = 1, hi = atom->ntypes;
  words.about("contact");
  if (words.take("types"))
    utils::bounds(FLERR, words.text("types, e.g. 1 or 1*3"), 1, atom->ntypes, lo, hi, error);
  const ContactSpec parsed = parse_contact(words, 1.0 / force->nktv2p);
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

  const ContactSpec *own = system->own_law(type);
  if (!own || !own->is_material())
    error->all(
        FLERR,
        "Fix large/body {}: the material law {} needs the material of particles of type {}: set "
        "'pair_style gran/penalty' and 'pair_coeff {} {}' with a material law",
        id, body.law.normal().name, type, type, type);
  ContactSpec particle = body;
  for (const char *name : {"E", "nu", "e", "mu", "limit_damping"})
    if (own->given.has(name)) particle.given[name] = own->given.value(name);
  if (own->law.resists())
    for (const char *name : {"mu_r", "mu_s"}) particle.given[name] = own->given.value(name);
  return contact_coefficients(body, particle, system->laws().mix);
}

double FixLargeBody::contact_period(int type, double mass, double radius)
{
  const double k =
      tangent_stiffness(specs[type].law, coefficients_of(type), 0.01 * radius, mass, radius);
  return k > 0.0 ? std::sqrt(mass / k) : 0.0;
}

/* ---------------------------------------------------------------------- */

int FixLargeBody::setmask()
{
  return POST_INTEGRATE | PRE_EXCHANGE | POST_NEIGHBOR | MIN_POST_NEIGHBOR | POST_FORCE |
         MIN_POST_FORCE | (nevery ? END_OF_STEP : 0);
}

void FixLargeBody::init()
{
  if (utils::strmatch(update->integrate_style, "^respa"))
    error->all(FLERR, "Fix large/body does not run with run_style respa: use run_style verlet");
  if (thermo_energy) keeps_account = true;
  joined = false;    // a step that an error ended may have left it
  motion.init();
  system->run_monitor().start();
  masses.find_fixes();
  find_region();
  find_frozen();
  set_laws();
}

void FixLargeBody::find_region()
{
  auto *its = dynamic_cast<RegionShape *>(shape.get());
  if (!its) return;
  Region *region = domain->get_region_by_id(its->region_id());
  if (!region) error->all(FLERR, "Fix large/body {}: region '{}' is gone", id, its->region_id());
  its->replace(region);
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

/* The body goes to the place of this step as the particles have just done; the load is that of the
   step before. */

void FixLargeBody::post_integrate()
{
  if (motion.driven_by_load()) reduce_exactly();
  motion.advance(total);
  if (account.waits_for_move())
    contacts.account_for_move(motion.frame(), view(), update->dt, account);
}

void FixLargeBody::setup_post_neighbor()
{
  motion.place();
  post_neighbor();
}

void FixLargeBody::min_post_neighbor()
{
  post_neighbor();
}

void FixLargeBody::post_neighbor()
{
  masses.update();
  list_particles();
}

/* Pair style gran/penalty looks earlier for all; without it the first body does. */

void FixLargeBody::pre_exchange()
{
  system->run_monitor().look(RunMonitor::Moment::REBUILD);
}

void FixLargeBody::post_run()
{
  system->run_monitor().look(RunMonitor::Moment::END);
}

BodyFindings FixLargeBody::find_worst()
{
  return contacts.look_for_trouble(*shape, motion.frame(), view(), comm->nthreads);
}

void FixLargeBody::list_particles()
{
  const BodyParticleView particles = view();
  if (shape->wants_focus())
    shape->focus(BodyCandidates::bounds_of_search(motion.frame(), particles, atom->mask, groupbit,
                                                  neighbor->skin));
  contacts.find_candidates(*shape, motion.frame(), particles, atom->mask, groupbit, neighbor->skin,
                           comm->nthreads);
}

void FixLargeBody::setup(int vflag)
{
  post_force(vflag);
  system->run_monitor().look(RunMonitor::Moment::SETUP);
  if (nevery && update->ntimestep % nevery == 0) end_of_step();
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
  const bool in_records = system->residence() == Residence::RECORDS;
  return {atom->nlocal,
          atom->x[0],
          atom->v[0],
          atom->omega[0],
          atom->radius,
          atom->rmass,
          masses.override_or_null(),
          atom->type,
          atom->f[0],
          atom->torque[0],
          nullptr,
          in_records ? &system->records() : nullptr,
          in_records ? system->slot_of_atom() : nullptr};
}

std::string FixLargeBody::needs_host_arrays()
{
  if (keeps_account) return "its energies are accounted for";
  if (motion.asks_variables()) return "its variables may read particles";
  const auto *its = dynamic_cast<const RegionShape *>(shape.get());
  if (its && its->moves()) return "its region may read particles";
  const bool turns = std::any_of(specs.begin() + 1, specs.end(),
                                 [](const ContactSpec &s) { return s.law.has_friction(); });
  if (turns && !system->turns_particles())
    return "it has friction and the contacts between particles have none";
  return "";
}

BodyStep FixLargeBody::step_of(bool advance)
{
  BodyStep step;
  step.dt = update->dt;
  step.advance = advance;
  step.threads = comm->nthreads;
  step.account = keeps_account ? &account : nullptr;
  step.exact = motion.moves() ? &exact : nullptr;
  step.touched = surface->records() ? surface->touched() : nullptr;
  return step;
}

void FixLargeBody::compute_contacts(const BodyParticleView &to, bool advance)
{
  mine = contacts.compute(*shape, motion.frame(), to, step_of(advance));
}

void FixLargeBody::add_contacts(bool advance)
{
  BodyParticleView particles = view();
  if (evflag) {
    virials.assign(6L * atom->nlocal, 0.0);
    particles.virial = virials.data();
  }
  if (contacts.is_stale(motion.frame(), neighbor->skin)) list_particles();
  compute_contacts(particles, advance);
}

bool FixLargeBody::join_step()
{
  joined = (comm->nthreads == 1 || shape->thread_safe()) &&
           contacts.begin_static(*shape, motion.frame(), view(), step_of(true));
  return joined;
}

void FixLargeBody::post_force(int vflag)
{
  finish_reduction();
  v_init(vflag);
  const bool advance = update->setupflag == 0;
  if (joined)
    mine = contacts.static_load();
  else
    add_contacts(advance);
  joined = false;
  if (evflag) tally_virial();
  if (already_frozen) clear_frozen();
  surface->add_step(advance ? update->dt : 0.0);
  reduced = total_is_known = false;
  has_forces = true;
  if (motion.driven_by_load()) begin_reduction();
}

void FixLargeBody::tally_virial()
{
  for (int i = 0; i < atom->nlocal; i++) v_tally(i, &virials[6L * i]);
}

void FixLargeBody::end_of_step()
{
  surface->write_picture(motion.frame());
}

int FixLargeBody::modify_param(int narg, char **arg)
{
  if (strcmp(arg[0], "state") != 0) return 0;
  double reach;
  const double reach_here = contacts.reach();
  MPI_Allreduce(&reach_here, &reach, 1, MPI_DOUBLE, MPI_MAX, world);
  return motion.set_state(narg, arg, neighbor->skin, reach);
}
