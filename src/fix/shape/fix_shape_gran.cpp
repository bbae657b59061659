/* Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE */

#include "fix/shape/fix_shape_gran.h"

#include "fix/shape/particle_shapes.h"
#include "system/host/command_words.h"
#include "system/host/restart_data.h"

#include "atom.h"
#include "domain.h"
#include "error.h"
#include "force.h"
#include "update.h"

using namespace LAMMPS_NS;
using namespace FixConst;
using namespace Talus;

/* ---------------------------------------------------------------------- */

FixShapeGran::FixShapeGran(LAMMPS *lmp, int narg, char **arg) :
    Fix(lmp, narg, arg), system(GranularSystem::of(lmp))
{
  time_integrate = 1;
  dynamic_group_allow = 0;
  create_attribute = 1;
  restart_global = restart_peratom = 1;
  peratom_flag = 1;
  size_peratom_cols = 4;
  peratom_freq = 1;
  scalar_flag = vector_flag = 1;
  size_vector = size_sums;
  global_freq = 1;
  extscalar = extvector = 1;
  maxexchange = ShapedParticles::size_orientation;
  comm_border = comm_forward = ShapedParticles::size_orientation;

  if (!atom->radius_flag || !atom->rmass_flag || !atom->omega_flag || !atom->torque_flag)
    error->all(FLERR, "Fix shape/gran requires atom attributes radius, rmass, omega and torque: "
                      "use 'atom_style sphere'");
  if (!atom->tag_enable)
    error->all(FLERR, "Fix shape/gran requires atom IDs: remove 'atom_modify id no'");
  if (domain->dimension != 3)
    error->all(FLERR, "Fix shape/gran: shapes are three-dimensional: use 'dimension 3'");
  if (system->shapes())
    error->all(FLERR, "Fix shape/gran can be used only once: give all types with a shape in one "
                      "command, 'type 1 ... type 2 ...'");
  Words words = command_words(lmp, "fix shape/gran", narg, arg, 3);
  shapes = &system->define_shapes(this, ParticleShapes(lmp, words).parse());
  array_atom = shapes->orientation_rows();

  system->run_monitor().add(this, {check_of_cores()});
  atom->add_callback(Atom::GROW);
  atom->add_callback(Atom::RESTART);
  atom->add_callback(Atom::BORDER);
}

FixShapeGran::~FixShapeGran()
{
  system->run_monitor().remove(this);
  for (const int which : {Atom::GROW, Atom::RESTART, Atom::BORDER})
    atom->delete_callback(id, which);
  system->drop_shapes();
}

void FixShapeGran::post_constructor()
{
  system->contact_store().create();
}

int FixShapeGran::setmask()
{
  return INITIAL_INTEGRATE | PRE_NEIGHBOR;
}

void FixShapeGran::init()
{
  Talus::require_intact_particles(lmp);
  shapes->set_sizes(0, atom->nlocal);
  shapes->orient_new(0, atom->nlocal);
  check_scene();
}

void FixShapeGran::setup_pre_neighbor()
{
  shapes->set_up();
  pre_neighbor();
}

/* Of particles that have come since: owned ones and their ghosts. */

void FixShapeGran::pre_neighbor()
{
  const int nall = atom->nlocal + atom->nghost;
  shapes->set_sizes(0, nall);
  shapes->orient_new(0, nall);
  require_no_other_integrator();
}

std::string FixShapeGran::needs_arrays()
{
  if (!system->pipeline().keeps_omega())
    return "it turns particles and the contacts between them have no friction";
  if (system->account().is_asked())
    return "the energies of contacts of particles with a shape are asked for";
  return "";
}

void FixShapeGran::initial_integrate(int /*vflag*/)
{
  shapes->move();
  RecordStep step{update->dt, update->dt * force->ftm2v, {0.0, 0.0, 0.0}, 0.4};
  step.extrapolation = 0.5;
  system->step().advance(this, step);
}
