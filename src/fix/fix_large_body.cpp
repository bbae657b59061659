// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "fix/fix_large_body.h"

#include "fix/large_body_shapes.h"
#include "fix/region_shape.h"

#include "system/command_words.h"
#include "system/restart_data.h"

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
    Fix(lmp, narg, arg), system(GranularSystem::of(lmp)), body(system->bodies().add(this)),
    motion(lmp), side(lmp), monitor(lmp)
{
  if (!atom->radius_flag || !atom->rmass_flag || !atom->omega_flag || !atom->torque_flag)
    error->all(FLERR, "Fix large/body requires atom attributes radius, rmass, omega and torque: "
                      "use 'atom_style sphere'");
  // `two-sided` is a property of the shape, so it is looked for before the shape is made
  Words words = command_words(lmp, "fix large/body", narg, arg, 3);
  for (int iarg = 4; iarg < narg; iarg++)
    if (strcmp(arg[iarg], "two-sided") == 0) two_sided = true;
  body.set_steered(*this);
  body.set_shape(LargeBodyShapes(lmp, words).parse(two_sided));
  surface = std::make_unique<LargeBodySurface>(lmp, body.shape());
  side.watch(body.shape());
  parse_keywords(words);
  motion.finish(body.shape());
  if (motion.deforms()) {
    vertices = std::make_unique<LargeBodyVertices>(lmp, *body.shape().as_mesh());
    body.set_deforming(*this, vertices->touched());
  }
  body.set_frame(&motion.frame(), motion.moves());
  follow_region();
  if (surface->records()) body.set_touched(surface->touched());
  body.set_picture([this] { return surface->picture(motion.frame()); });
  body.keep_history();
  offer_output();
  keep_history();
  system->run_monitor().add(this, monitor.checks(body, [this] { return motion.moves(); }));
}

FixLargeBody::~FixLargeBody()
{
  system->run_monitor().remove(this);
  if (body.keeps_history()) {
    atom->delete_callback(id, Atom::GROW);
    atom->delete_callback(id, Atom::RESTART);
  }
  system->bodies().remove(body);
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
  restart_global =
      body.keeps_history() || motion.moves() || surface->records() || side.is_open() ? 1 : 0;
  nevery = surface->picture_interval();
  if (!surface->records()) return;
  array_flag = 1;
  size_array_rows = surface->size();
  size_array_cols = surface->columns();
  extarray = 0;
}

/* ---------------------------------------------------------------------- */

void FixLargeBody::parse_keywords(Words &words)
{
  while (!words.at_end()) {
    words.about("");
    if (words.take("contact")) {
      parse_contact_words(words);
    } else if (words.take("type")) {
      parse_type(words);
    } else if (words.take("two-sided") || motion.parse(words) || surface->parse(words)) {
      continue;
    } else {
      words.fail(
          0, "unknown word '" + words.peek() +
                 "', expected contact, type, two-sided, move, servo, surface_velocity, gravity, "
                 "load, pressure, wear, vtk, or in a contact " +
                 contact_keywords);
    }
  }
  if (motion.frame().runs && !body.shape().is_flat())
    error->all(FLERR, "fix large/body: surface_velocity is for plane, rectangle and mesh: give a "
                      "cylinder or cone that turns 'move rotate'");
  for (int type = 1; type <= atom->ntypes; type++)
    if (!body.has_law(type))
      error->all(FLERR,
                 "fix large/body: no contact law for particles of type {}: add 'contact "
                 "NORMAL args ...' or 'contact types {} NORMAL args ...', or 'type N'",
                 type, type);
}

/* The law with particles of another type is that of pair_coeff. */

void FixLargeBody::parse_type(Words &words)
{
  words.about("type");
  const int type = words.integer("atom type", 1);
  if (type > atom->ntypes)
    words.fail(1, fmt::format("there are {} atom types: make one for the body in create_box",
                              atom->ntypes));
  for (int other = 1; other <= atom->ntypes; other++)
    if (body.has_law(other)) refuse_two_laws(words, 2);
  body.set_type_of_laws(type);
}

void FixLargeBody::refuse_two_laws(const Words &words, int back)
{
  words.fail(back, "the laws of a body are those of 'type', once, or of 'contact': remove one");
}

void FixLargeBody::parse_contact_words(Words &words)
{
  if (body.has_type_of_laws()) refuse_two_laws(words, 1);
  int lo = 1, hi = atom->ntypes;
  words.about("contact");
  if (words.take("types"))
    utils::bounds(FLERR, words.text("types, e.g. 1 or 1*3"), 1, atom->ntypes, lo, hi, error);
  const int at_normal = words.index();
  const ContactSpec parsed = parse_contact(words, 1.0 / force->nktv2p);
  if (parsed.law.conducts_heat())
    words.fail(words.index() - at_normal,
               "large bodies have no temperature: remove 'heat', or use fix wall/gran granular");
  if (takes_moduli_of_types(parsed))
    words.fail(words.index() - at_normal,
               "E and nu = NULL are those of two types of particles, in pair_coeff: write numbers, "
               "or give the body a 'type'");
  for (int type = lo; type <= hi; type++) body.set_law(type, parsed);
}

/* ---------------------------------------------------------------------- */

int FixLargeBody::setmask()
{
  return POST_INTEGRATE | PRE_EXCHANGE | POST_NEIGHBOR | MIN_POST_NEIGHBOR | POST_FORCE |
         MIN_POST_FORCE | (nevery ? END_OF_STEP : 0);
}

void FixLargeBody::init()
{
  Talus::require_intact_particles(lmp);
  if (utils::strmatch(update->integrate_style, "^respa"))
    error->all(FLERR, "Fix large/body does not run with run_style respa: use run_style verlet");
  motion.init();
  monitor.start();
  system->run_monitor().start();
  follow_region();
  body.init();
}

/* It may have been deleted and defined again since the last run, and move now. */

void FixLargeBody::follow_region()
{
  auto *shape = dynamic_cast<RegionShape *>(&body.shape());
  if (!shape) return;
  Region *region = domain->get_region_by_id(shape->region_id());
  if (!region)
    error->all(FLERR, "Fix large/body {}: region '{}' is gone: define it again before the run", id,
               shape->region_id());
  const std::string refusal = RegionShape::refusal(*region, motion.has_own());
  if (!refusal.empty()) error->all(FLERR, "Fix large/body {}: {}", id, refusal);
  shape->replace(region, *domain);
  if (motion.has_own()) return;
  motion.follow(*region, shape->reference_point());
  body.set_frame(&motion.frame(), motion.moves());
  if (motion.moves()) restart_global = 1;
}

/* The body goes to the place of this step as the particles have just done; the load is that of the
   step before. */

void FixLargeBody::post_integrate()
{
  body.begin_step();
  motion.advance(motion.driven_by_load() ? body.exact_load() : BodyLoad{},
                 system->integrators().lag());
  if (vertices) vertices->begin_step(system->integrators().kicks());
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
  side.decide(groupbit, motion.frame());
  body.list_particles();
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

void FixLargeBody::setup(int vflag)
{
  post_force(vflag);
  system->run_monitor().look(RunMonitor::Moment::SETUP);
  if (nevery && update->ntimestep % nevery == 0) end_of_step();
}

void FixLargeBody::min_setup(int vflag)
{
  if (MeshShape *mesh = vertices ? body.shape().as_mesh() : nullptr) mesh->moving()->stand_still();
  post_force(vflag);
}

void FixLargeBody::min_post_force(int vflag)
{
  post_force(vflag);
}

std::string FixLargeBody::needs_arrays()
{
  if (motion.asks_variables()) return "its variables may read particles";
  return body.needs_arrays();
}

void FixLargeBody::post_force(int vflag)
{
  v_init(vflag);
  const bool advance = update->setupflag == 0;
  if (evflag) virials.assign(6L * atom->nlocal, 0.0);
  body.compute(advance, evflag ? virials.data() : nullptr);
  for (int i = 0; evflag && i < atom->nlocal; i++) v_tally(i, &virials[6L * i]);
  surface->add_step(advance ? update->dt : 0.0);
  if (vertices) vertices->end_step(advance);
  if (motion.driven_by_load() || body.is_watched()) body.begin_reduction();
}

void FixLargeBody::end_of_step()
{
  surface->write_picture(motion.frame());
}

int FixLargeBody::modify_param(int narg, char **arg)
{
  if (strcmp(arg[0], "state") != 0) return 0;
  int words, steps;
  const BodyState state = motion.state_from(narg, arg, words, steps);
  const std::string problem = guide(state, steps);
  if (!problem.empty()) error->all(FLERR, "fix_modify {} state: {}", id, problem);
  return words;
}

std::string FixLargeBody::guide(const BodyState &state, int steps)
{
  double reach;
  const double reach_here = body.reach();
  MPI_Allreduce(&reach_here, &reach, 1, MPI_DOUBLE, MPI_MAX, world);
  return motion.guide(state, steps, neighbor->skin, reach);
}

std::string FixLargeBody::guide_vertices(const Places &places, const Places *velocities, int steps)
{
  return body.shape().as_mesh()->guide(places, velocities, steps, update->dt, neighbor->skin);
}
