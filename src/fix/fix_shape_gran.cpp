/* Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE */

#include "fix/fix_shape_gran.h"

#include "base/in_parallel.h"
#include "fix/orientations.h"
#include "fix/particle_shapes.h"
#include "shaped/shape_list.h"
#include "system/command_words.h"
#include "system/fix_contact_store.h"
#include "system/restart_data.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "force.h"
#include "group.h"
#include "memory.h"
#include "modify.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <cstring>

using namespace LAMMPS_NS;
using namespace FixConst;
using namespace Talus;

/* ---------------------------------------------------------------------- */

FixShapeGran::FixShapeGran(LAMMPS *lmp, int narg, char **arg) :
    Fix(lmp, narg, arg), system(GranularSystem::of(lmp)), table(collisions_of_shapes()),
    pairs(table), exchange(world)
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
  maxexchange_dynamic = 1;
  histories.keep(point_history_size);
  set_maxexchange();
  comm_border = comm_forward = 4;

  if (!atom->radius_flag || !atom->rmass_flag || !atom->omega_flag || !atom->torque_flag)
    error->all(FLERR, "Fix shape/gran requires atom attributes radius, rmass, omega and torque: "
                      "use 'atom_style sphere'");
  if (!atom->tag_enable)
    error->all(FLERR, "Fix shape/gran requires atom IDs: remove 'atom_modify id no'");
  if (domain->dimension != 3)
    error->all(FLERR, "Fix shape/gran: shapes are three-dimensional: use 'dimension 3'");
  if (!system->take_shapes(this))
    error->all(FLERR, "Fix shape/gran can be used only once: give all types with a shape in one "
                      "command, 'type 1 ... type 2 ...'");
  Words words = command_words(lmp, "fix shape/gran", narg, arg, 3);
  table = ParticleShapes(lmp, words).parse();

  system->run_monitor().add(this, {check_of_cores()});
  FixShapeGran::grow_arrays(atom->nmax);
  atom->add_callback(Atom::GROW);
  atom->add_callback(Atom::RESTART);
  atom->add_callback(Atom::BORDER);
  for (int i = 0; i < atom->nlocal; i++) FixShapeGran::set_arrays(i);
  set_sizes(0, atom->nlocal);
}

FixShapeGran::~FixShapeGran()
{
  system->run_monitor().remove(this);
  system->drop_shapes(this);
  for (const int which : {Atom::GROW, Atom::RESTART, Atom::BORDER})
    atom->delete_callback(id, which);
  memory->destroy(quat);
}

int FixShapeGran::setmask()
{
  return INITIAL_INTEGRATE | PRE_NEIGHBOR;
}

void FixShapeGran::init()
{
  Talus::require_intact_particles(lmp);
  set_sizes(0, atom->nlocal);
  orient_new(0, atom->nlocal);
  check_scene();
  set_maxexchange();
}

void FixShapeGran::setup_pre_neighbor()
{
  is_set_up = true;
  pre_neighbor();
}

/* Radius and mass belong to the type; LAMMPS makes new particles with others. */

void FixShapeGran::set_sizes(int first, int last)
{
  for (int i = first; i < last; i++)
    if (const ParticleShape *shape = table.of(atom->type[i])) {
      atom->radius[i] = shape->shape().bounding_radius();
      atom->rmass[i] = shape->mass();
    }
}

/* By ID, which some commands give after they have made the particle. */

void FixShapeGran::orient_new(int first, int last)
{
  for (int i = first; i < last; i++) {
    const ParticleShape *shape = table.of(atom->type[i]);
    if (shape && atom->tag[i] > 0 && !is_known(quat[i]))
      put(shape->new_orientation(atom->tag[i]), quat[i]);
  }
}

/* ---- a rebuild ---- */

void FixShapeGran::keep_histories()
{
  if (histories_are_current) return;
  histories.clear();
  if (domain->xperiodic || domain->yperiodic || domain->zperiodic) {
    ShapedPairs::Messages messages;
    const HistoryStore &store = system->store()->histories();
    pairs.save_in_periodic_box(
        histories, comm->me, [&](int i) { return store.owner_of_ghost(atom->nlocal, i); },
        messages);
    exchange.run(messages, 0,
                 [this](const std::vector<double> &m) { pairs.receive(m, histories); });
  } else {
    pairs.save(histories);
  }
  for (auto &[body, wall] : walls)
    if (wall.points) wall.points->save(histories);
  histories_are_current = true;
  set_maxexchange();
}

void FixShapeGran::set_maxexchange()
{
  int mine = histories.largest_packed(quat ? atom->nlocal : 0), most = 0;
  MPI_Allreduce(&mine, &most, 1, MPI_INT, MPI_MAX, world);
  maxexchange = 4 + most;
}

/* Of particles that have come since: owned ones and their ghosts. */

void FixShapeGran::pre_neighbor()
{
  const int nall = atom->nlocal + atom->nghost;
  set_sizes(0, nall);
  orient_new(0, nall);
  require_no_other_integrator();
}

void FixShapeGran::set_pairs(std::vector<std::array<int, 2>> found)
{
  require_set_up();
  const int nall = atom->nlocal + atom->nghost;
  const std::vector<std::int64_t> tags(atom->tag, atom->tag + nall);
  pairs.set_pairs(view(), found, tags, system->law_table());
  pairs.restore(histories);
  for (auto &[body, wall] : walls)
    if (wall.points) list_particles(*body, *wall.points);
}

void FixShapeGran::list_particles(const LargeBody &body, WallPoints &points)
{
  std::vector<int> particles;
  for (int i = 0; i < atom->nlocal; i++)
    if (is_shaped(atom->type[i]) && (atom->mask[i] & body.group_bits())) particles.push_back(i);
  points.set_particles(particles);
  points.restore(histories);
}

/* ---- a step ---- */

std::string FixShapeGran::needs_arrays()
{
  if (!system->pipeline().keeps_omega())
    return "it turns particles and the contacts between them have no friction";
  if (system->account().is_asked())
    return "the energies of contacts of particles with a shape are asked for";
  return "";
}

ShapedView FixShapeGran::view() const
{
  if (atom->nlocal + atom->nghost == 0) return {};
  return {system->particles(), atom->nlocal + atom->nghost, quat[0]};
}

/* The direct exchange brings them with positions, a rebuild with its ghosts. */

void FixShapeGran::send_orientations()
{
  const ProxyUpdates *direct = system->exchange().direct();
  if (direct && direct->has_plan() && !orientations_were_set) return;
  comm->forward_comm(this, 4);
  orientations_were_set = false;
}

void FixShapeGran::compute_contacts(const ContactStep &step)
{
  require_set_up();
  send_orientations();
  pairs.compute(view(), system->law_table(),
                {step.dt, step.advance, comm->nthreads, step.account, step.weight_of_changes});
  if (step.advance) histories_are_current = false;
  if (!step.tally) return;
  pairs.for_each_force([&](int i, int j, const Vector3<double> &force) {
    const double *a = atom->x[i], *b = atom->x[j];
    (*step.tally)({i,
                   j,
                   i < atom->nlocal,
                   j < atom->nlocal,
                   {force.x, force.y, force.z},
                   {a[0] - b[0], a[1] - b[1], a[2] - b[2]}});
  });
}

FixShapeGran::Wall &FixShapeGran::wall_of(LargeBody &body)
{
  Wall &wall = walls[&body];
  if (!wall.surfaces) wall.surfaces = std::make_unique<BodySurfaces>(body.shape(), table);
  return wall;
}

BodyLoad FixShapeGran::touch_body(LargeBody &body, const BodyStep &step)
{
  Wall &wall = wall_of(body);
  if (!wall.points) {
    wall.points = std::make_unique<WallPoints>(table, name_of(body));
    list_particles(body, *wall.points);
  }
  if (step.advance) histories_are_current = false;
  wall.surfaces->follow();
  return wall.points->compute(*wall.surfaces, body.present_frame(), view(), body.law_table(), step);
}

/* Negative, for IDs of particles are positive; the same in a run that goes on from a file. */

std::int64_t FixShapeGran::name_of(const LargeBody &body)
{
  std::uint64_t hash = 14695981039346656037U;    // FNV-1a
  for (const char *c = body.command()->id; *c; c++)
    hash = (hash ^ static_cast<unsigned char>(*c)) * 1099511628211U;
  return -static_cast<std::int64_t>(hash >> 1) - 1;
}

bool FixShapeGran::moves_particle(int i) const
{
  return is_shaped(atom->type[i]) && (atom->mask[i] & groupbit);
}

/* Half of what the kick gives to velocities: of omega not what free rotation changes, for this is
   exact at the positions on both sides of a step. */

void FixShapeGran::keep_change(ChangeRecord &change, int i, const Load &load) const
{
  const double half = 0.5 * update->dt * force->ftm2v;
  const Vector3<double> v = (half / atom->rmass[i]) * load.force;
  const Vector3<double> omega =
      table.of(atom->type[i])
          ->rotation()
          .omega_of(quaternion(quat[i]), (half * atom->radius[i]) * load.torque);
  change = {{static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z), 0.0F,
             static_cast<float>(omega.x), static_cast<float>(omega.y), static_cast<float>(omega.z),
             0.0F}};
}

void FixShapeGran::move(const ParticleState &particles, int i)
{
  const Load load = particles.load(i);
  if (ChangeRecord *change = particles.change(i)) keep_change(*change, i, load);
  double *const x = particles.x(i), *const v = particles.v(i), *const w = particles.w(i);
  const double dt = update->dt, kick = dt * force->ftm2v / atom->rmass[i];
  const double f[3] = {load.force.x, load.force.y, load.force.z};
  for (int d = 0; d < 3; d++) {
    v[d] += kick * f[d];
    x[d] += dt * v[d];
  }
  Eigen::Quaterniond q = quaternion(quat[i]);
  Vector3<double> omega = row(w);
  table.of(atom->type[i])->rotation().advance(q, omega, force->ftm2v * load.torque, dt);
  put(q, quat[i]);
  w[0] = omega.x;
  w[1] = omega.y;
  w[2] = omega.z;
}

void FixShapeGran::initial_integrate(int /*vflag*/)
{
  const ParticleState particles = system->particles();
  in_ranges(atom->nlocal, comm->nthreads, [&](int, int begin, int end) {
    for (int i = begin; i < end; i++)
      if (moves_particle(i)) move(particles, i);
  });
  RecordStep step{update->dt, update->dt * force->ftm2v, {0.0, 0.0, 0.0}, 0.4};
  step.extrapolation = 0.5;
  system->advance(this, step);
}
