/* Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE */

/* ----------------------------------------------------------------------
   What clumps are when a run begins, with the same bits on any number of ranks, and what restart
   files hold of them.
------------------------------------------------------------------------- */

#include "fix/clump/fix_rigid_small_talus.h"

#include "system/host/restart_data.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "math_const.h"
#include "molecule.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <cstring>

using namespace LAMMPS_NS;
using ClumpState = Talus::ClumpState<double>;
using Vector = Talus::Vector3<double>;

namespace {

constexpr int size_states = 11;

struct SphereState {
  Vector x, v, omega;
  double mass, radius;

  explicit SphereState(const double *row) :
      x{row[0], row[1], row[2]}, v{row[3], row[4], row[5]}, omega{row[6], row[7], row[8]},
      mass(row[9]), radius(row[10])
  {
  }
};

Eigen::Matrix3d inertia_of(const SphereState &s, const Vector &arm)
{
  const Eigen::Vector3d d = Talus::to_eigen(arm);
  return s.mass * ((d.squaredNorm() + 0.4 * s.radius * s.radius) * Eigen::Matrix3d::Identity() -
                   d * d.transpose());
}

/* Ascending principal moments and the turn to their axes; in two dimensions the last is z. */

void find_axes(const Eigen::Matrix3d &inertia, bool flat, ClumpState &state, double *moments)
{
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  if (flat) {
    const double angle = 0.5 * std::atan2(2.0 * inertia(0, 1), inertia(0, 0) - inertia(1, 1));
    axes.topLeftCorner<2, 2>() << std::cos(angle), -std::sin(angle), std::sin(angle),
        std::cos(angle);
    const Eigen::Matrix3d turned = axes.transpose() * inertia * axes;
    moments[0] = turned(0, 0);
    moments[1] = turned(1, 1);
    moments[2] = inertia(2, 2);
  } else {
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(inertia);
    axes = solver.eigenvectors();
    axes.col(2) = axes.col(0).cross(axes.col(1));
    for (int d = 0; d < 3; d++) moments[d] = solver.eigenvalues()(d);
  }
  const Eigen::Quaterniond q(axes);
  state.quat = Talus::Quaternion<double>{q.w(), q.x(), q.y(), q.z()}.normalized();
  state.inverse_inertia = {1.0 / moments[0], 1.0 / moments[1], 1.0 / moments[2]};
  state.axes = state.quat.axes();
}

}    // namespace

/* The stock class takes masses that a template lacks from those of atom types, also where the atom
   style has none. Returns the words. */

char **FixRigidSmallTalus::with_masses(LAMMPS *lmp, int narg, char **arg)
{
  const auto lacks_masses = [](const Molecule &m) {
    return !m.rmassflag && !(m.massflag && m.comflag && m.inertiaflag);
  };
  Atom *const atom = lmp->atom;
  for (int n = 3; n + 1 < narg && !atom->mass; n++) {
    const int first = std::strcmp(arg[n], "mol") == 0 ? atom->find_molecule(arg[n + 1]) : -1;
    for (int k = 0; first >= 0 && k < atom->molecules[first]->nset; k++)
      if (lacks_masses(*atom->molecules[first + k]))
        lmp->error->all(FLERR,
                        "Fix {} {}: spheres of molecule template {} have no masses: give it a "
                        "section Masses",
                        arg[2], arg[0], arg[n + 1]);
  }
  return arg;
}

/* delete_atoms may take the sphere that the stock class keeps the body with, or give others new IDs;
   the stock class reads on then. Ghosts do not tell yet what they own. */

void FixRigidSmallTalus::require_whole_clumps() const
{
  tagint mine = MAXTAGINT, first = 0;
  for (int i = 0; i < atom->nlocal; i++) {
    if (!bodytag[i]) continue;
    // of an ID beyond the largest one that is left map() reads whatever is there
    const int owner = bodytag[i] <= atom->map_tag_max ? atom->map(bodytag[i]) : -1;
    const bool found = owner >= atom->nlocal || (owner >= 0 && bodyown[owner] >= 0);
    const bool renamed = bodyown[i] >= 0 && bodytag[i] != atom->tag[i];
    if (!found || renamed) mine = std::min(mine, atom->tag[i]);
  }
  for (int b = 0; b < nlocal_body; b++)
    if (body[b].ilocal >= atom->nlocal || bodyown[body[b].ilocal] != b)
      mine = std::min<tagint>(mine, 0);
  MPI_Allreduce(&mine, &first, 1, MPI_LMP_TAGINT, MPI_MIN, world);
  if (first == MAXTAGINT) return;
  error->all(
      FLERR,
      "Fix {} {}: spheres of clumps are missing or have new IDs{}: delete whole clumps and keep "
      "IDs (delete_atoms with 'mol yes' and 'compress no'), or, if none was deleted, make "
      "'comm_modify cutoff' larger than the clumps",
      style, id, first ? fmt::format(", in that of particle {}", first) : "");
}

void FixRigidSmallTalus::setup_pre_neighbor()
{
  if (!reason.empty()) return FixRigidSmall::setup_pre_neighbor();
  require_whole_clumps();
  bool keep = false;
  states_known = false;
  if (setupflag || restored) {
    if (setupflag)
      FixRigidSmall::pre_neighbor();
    else
      restore_bodies();
    make_table();
    states_known = keeps_states();
    keep = !reinitflag || states_known;
  }
  restored = false;
  if (!keep) {
    setup_bodies_static();
    if (!inpfile) setup_bodies_dynamic();
    make_table();
    if (!inpfile) find_bodies();
  }
  setupflag = 1;
}

/* The stock class sets up all that goes with bodies, and then gets back what they were. */

void FixRigidSmallTalus::restore_bodies()
{
  const std::vector<Body> bodies(body, body + nlocal_body);
  std::vector<double> places(3L * atom->nlocal);
  for (int i = 0; i < atom->nlocal; i++) std::copy_n(displace[i], 3, &places[3L * i]);
  setup_bodies_static();
  std::copy(bodies.begin(), bodies.end(), body);
  for (int i = 0; i < atom->nlocal; i++) std::copy_n(&places[3L * i], 3, displace[i]);
  FixRigidSmall::pre_neighbor();
}

/* Clumps that no command has touched since they moved, on all ranks. */

bool FixRigidSmallTalus::keeps_states()
{
  exchange_rows(Message::STATES, size_states);
  int mine = 1, all = 1;
  for (int c = 0; c < table.size(); c++)
    if (!is_kept(c)) mine = 0;
  MPI_Allreduce(&mine, &all, 1, MPI_INT, MPI_MIN, world);
  return all != 0;
}

bool FixRigidSmallTalus::is_kept(int clump) const
{
  constexpr double of_states = 1.0e-8, of_masses = 1.0e-10;
  const Body &b = body[table.body[clump]];
  const ClumpState state = state_of(b);
  const Talus::SphereMotion<double> motion = sphere_motion_of(state);
  double mass = 0.0;
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
  for (const ClumpSphere *s = table.begin(clump); s != table.end(clump); s++) {
    double row[size_states];
    if (s->owned)
      write_state_row(s->atom, row);
    else
      std::copy_n(row_of(*s), size_states, row);
    const SphereState sphere(row);
    mass += sphere.mass;
    inertia += inertia_of(sphere, s->place);
    if (!s->owned) continue;
    const Vector arm = state.axes.to_space(s->place);
    double x[3];
    domain->unmap(atom->x[s->atom], xcmimage[s->atom], x);
    const Vector place = Vector{x[0], x[1], x[2]} - (state.position + arm);
    const Vector v = sphere.v - motion.velocity_at(s->place);
    const double speed =
        length(state.velocity) + length(state.omega) * (length(arm) + sphere.radius);
    if (!(length(place) <= of_states * (length(arm) + sphere.radius)) ||
        !(length(v) <= of_states * speed) ||
        !(length(sphere.omega - motion.omega) * sphere.radius <= of_states * speed))
      return false;
  }
  if (given_masses_stay()) return true;
  const Eigen::Vector3d moments(b.inertia[0], b.inertia[1], b.inertia[2]);
  inertia.diagonal() -= moments;
  return std::fabs(mass - state.mass) <= of_masses * mass &&
         inertia.cwiseAbs().maxCoeff() <= of_masses * moments.maxCoeff();
}

/* ---------------------------------------------------------------------- */

void FixRigidSmallTalus::find_bodies()
{
  exchange_rows(Message::STATES, size_states);
  for (int c = 0; c < table.size(); c++) find_body(c);
  FixRigidSmall::pre_neighbor();    // into the box, for all ranks
  make_table();
}

void FixRigidSmallTalus::find_body(int clump)
{
  std::vector<SphereState> spheres;
  for (const ClumpSphere *s = table.begin(clump); s != table.end(clump); s++) {
    double row[size_states];
    if (s->owned) write_state_row(s->atom, row);
    spheres.emplace_back(s->owned ? row : row_of(*s));
  }
  ClumpState state{};
  Vector middle{0.0, 0.0, 0.0};
  for (const SphereState &s : spheres) {
    state.mass += s.mass;
    state.position = state.position + s.mass * s.x;
    state.velocity = state.velocity + s.mass * s.v;
    middle = middle + s.x;
  }
  state.position = (1.0 / state.mass) * state.position;
  state.velocity = (1.0 / state.mass) * state.velocity;
  middle = (1.0 / static_cast<double>(spheres.size())) * middle;

  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
  for (const SphereState &s : spheres) {
    const Vector arm = s.x - state.position;
    inertia += inertia_of(s, arm);
    state.momentum = state.momentum +
                     (s.mass * cross(arm, s.v) + (0.4 * s.mass * s.radius * s.radius) * s.omega);
  }
  Body &b = body[table.body[clump]];
  find_axes(inertia, domain->dimension == 2, state, b.inertia);
  state.omega = state.omega_now();

  put_state(state, b);
  b.mass = state.mass;
  b.natoms = static_cast<int>(spheres.size());
  b.image = (static_cast<imageint>(IMGMAX) << IMG2BITS) |
            (static_cast<imageint>(IMGMAX) << IMGBITS) | IMGMAX;
  const Vector off = middle - state.position, off_in_body = state.axes.to_body(off);
  const double center[3] = {middle.x, middle.y, middle.z};
  const double in_body[3] = {off_in_body.x, off_in_body.y, off_in_body.z};
  std::copy(center, center + 3, b.xgc);
  std::copy(in_body, in_body + 3, b.xgc_body);

  int n = 0;
  for (const ClumpSphere *s = table.begin(clump); s != table.end(clump); s++, n++) {
    if (!s->owned) continue;
    const Vector place = state.axes.to_body(spheres[n].x - state.position);
    const double values[3] = {place.x, place.y, place.z};
    std::copy(values, values + 3, displace[s->atom]);
  }
}

/* ----------------------------------------------------------------------
   restart files: of each particle whether a set-up has been made, the ID of its body and its place in
   it, of the one that owns the body the state as well, number by number: the struct of LAMMPS may change
------------------------------------------------------------------------- */

static constexpr tagint no_setup = -1;    // in the place of the ID

static constexpr int row_begin = Talus::size_particle_head + 5, num_numbers = 1 + 12 * 3 + 2 * 4,
                     num_whole = 2 + 4;

template <class Body, class Visit> static void for_each_number(Body &b, Visit visit)
{
  visit(&b.mass, 1);
  for (auto *three : {b.xcm, b.xgc, b.vcm, b.fcm, b.torque, b.inertia, b.ex_space, b.ey_space,
                      b.ez_space, b.xgc_body, b.angmom, b.omega})
    visit(three, 3);
  for (auto *four : {b.quat, b.conjqm}) visit(four, 4);
}

int FixRigidSmallTalus::size_restart(int i)
{
  return row_begin + (bodyown[i] >= 0 ? num_numbers + num_whole : 0);
}

int FixRigidSmallTalus::maxsize_restart()
{
  return row_begin + num_numbers + num_whole;
}

int FixRigidSmallTalus::pack_restart(int i, double *buf)
{
  const bool known = setupflag || restored, owns = bodyown[i] >= 0 && known;
  double *const row = buf + Talus::size_particle_head;
  row[0] = ubuf(known ? bodytag[i] : no_setup).d;
  std::copy_n(displace[i], 3, row + 1);
  row[4] = owns ? 1.0 : 0.0;
  if (bodyown[i] < 0) return Talus::complete_particle_data(buf, size_restart(i));
  Body &b = body[bodyown[i]];
  double *next = buf + row_begin;
  for_each_number(b, [&](const double *value, int n) { next = std::copy_n(value, n, next); });
  *next++ = b.natoms;
  *next++ = ubuf(b.image).d;
  std::copy_n(b.remapflag, 4, next);
  return Talus::complete_particle_data(buf, size_restart(i));
}

void FixRigidSmallTalus::unpack_restart(int i, int nth)
{
  const double *const row =
      Talus::particle_data(lmp, std::string("Fix ") + style + " " + id, i, nth);
  if (!row) return;
  const tagint tag = static_cast<tagint>(ubuf(row[0]).i);
  if (tag == no_setup) return;
  if (!restored) {    // the constructor has looked for bodies on its own
    nlocal_body = 0;
    std::fill_n(bodytag, atom->nlocal, 0);
    std::fill_n(bodyown, atom->nlocal, -1);
  }
  restored = true;
  bodytag[i] = tag;
  std::copy_n(row + 1, 3, displace[i]);
  if (row[4] == 0.0) return;
  if (nlocal_body == nmax_body) grow_body();
  Body &b = body[nlocal_body];
  const double *next = row - Talus::size_particle_head + row_begin;
  for_each_number(b, [&](double *value, int n) {
    std::copy_n(next, n, value);
    next += n;
  });
  b.natoms = static_cast<int>(*next++);
  b.image = static_cast<imageint>(ubuf(*next++).i);
  std::copy_n(next, 4, b.remapflag);
  body[nlocal_body].ilocal = i;
  bodyown[i] = nlocal_body++;
}
