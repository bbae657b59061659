// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "compute/compute_coarse_grid.h"

#include "base/rows.h"
#include "base/words.h"
#include "system/host/command_words.h"
#include "system/host/particle_volume.h"

#include "atom.h"
#include "domain.h"
#include "error.h"
#include "force.h"
#include "memory.h"
#include "neighbor.h"
#include "update.h"

#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;
using namespace Talus;

namespace {

/* What is summed up in each cell. */

enum Moment { NUMBER, MASS, VOLUME, MOMENTUM, FLOW = MOMENTUM + 3, CONTACT = FLOW + 6 };
constexpr int num_moments = CONTACT + 9;
const int row_of[6] = {0, 1, 2, 0, 0, 1}, column_of[6] = {0, 1, 2, 1, 2, 2};

/* Words of the command, in this order. */

const std::vector<std::string> names = {
    "number", "density", "fraction", "vx",  "vy",  "vz",  "temp", "kxx", "kyy",  "kzz",
    "kxy",    "kxz",     "kyz",      "cxx", "cxy", "cxz", "cyx",  "cyy", "cyz",  "czx",
    "czy",    "czz",     "sxx",      "syy", "szz", "sxy", "sxz",  "syz", "press"};
enum Quantity { Q_NUMBER, Q_DENSITY, Q_FRACTION, Q_V, Q_TEMP = Q_V + 3, Q_KINETIC, Q_CONTACT = 13 };
enum { Q_STRESS = Q_CONTACT + 9, Q_PRESSURE = Q_STRESS + 6 };

}    // namespace

ComputeCoarseGrid::ComputeCoarseGrid(LAMMPS *lmp, int narg, char **arg) :
    Compute(lmp, narg, arg), system(GranularSystem::of(lmp)), contacts(lmp)
{
  Words words = command_words(lmp, "compute coarse/grid", narg, arg, 3);
  for (const auto &[d, name] : {std::pair{0, "Nx"}, std::pair{1, "Ny"}, std::pair{2, "Nz"}})
    cells[d] = words.integer(name, 1);
  width = words.positive("width W");
  if (words.at_end()) words.text("a value, e.g. density");
  while (!words.at_end()) quantities.push_back(words.choice("value", names));
  for (const int q : quantities) {
    with_contacts = with_contacts || q >= Q_CONTACT;
    with_volumes = with_volumes || q == Q_FRACTION;
  }
  if (!atom->radius_flag || !atom->rmass_flag)
    error->all(FLERR, "compute coarse/grid requires atom attributes radius and rmass: use "
                      "'atom_style sphere'");
  check_box();
  pergrid_flag = 1;
  reset_grid();
  if (with_contacts) system->account().add_observer(this);
}

ComputeCoarseGrid::~ComputeCoarseGrid()
{
  system->account().drop_observer(this);
  free_data();
}

void ComputeCoarseGrid::check_box()
{
  if (domain->dimension != 3 || domain->triclinic)
    error->all(FLERR, "compute coarse/grid requires 'dimension 3' and a box that is not triclinic");
  for (int d = 0; d < 3; d++) {
    const double edge = domain->prd[d] / cells[d];
    mean_of[d] = cells[d] == 1 && width < edge;
    if (mean_of[d]) continue;
    if (width < edge)
      error->all(FLERR,
                 "compute coarse/grid: the width {} is less than the edge {} of the cells along "
                 "{}: take more cells or a larger width",
                 width, edge, "xyz"[d]);
    if (domain->periodicity[d] && 2.0 * width > domain->prd[d])
      error->all(FLERR,
                 "compute coarse/grid: the width {} is more than half the period {} along {}",
                 width, domain->prd[d], "xyz"[d]);
  }
}

void ComputeCoarseGrid::init()
{
  if (with_contacts) {
    const std::string problem = contacts.problem();
    if (!problem.empty()) error->all(FLERR, "compute coarse/grid: no contact stress: {}", problem);
    contacts.request(this);
  }
  check_box();
}

/* ---- the grid ------------------------------------------------------------------------------- */

/* A rank adds what its particles have, which may have left its sub-domain, and branches of their
   partners. */

double ComputeCoarseGrid::reach() const
{
  double radius = 0.0;
  for (int i = 0; i < atom->nlocal && with_volumes; i++) radius = std::max(radius, atom->radius[i]);
  MPI_Allreduce(MPI_IN_PLACE, &radius, 1, MPI_DOUBLE, MPI_MAX, world);
  return width + std::max({neighbor->cutneighmax, radius, 0.0}) + neighbor->skin;
}

void ComputeCoarseGrid::free_data()
{
  if (!sums) return;
  const int *lo = sums->lo();
  memory->destroy3d_offset(vector_of_cells, lo[2], lo[1], lo[0]);
  memory->destroy4d_offset_last(array_of_cells, lo[2], lo[1], lo[0]);
}

/* Numbers of messages and arrays are counted with int, and a rank may own a part of the box only. */

void ComputeCoarseGrid::require_countable() const
{
  double numbers = num_moments;
  for (int d = 0; d < 3; d++)
    numbers *= cells[d] + 2.0 * (reach_of_grid * cells[d] / domain->prd[d] + 1.0);
  if (numbers > MAXSMALLINT)
    error->all(
        FLERR,
        "compute coarse/grid: the grid and what is nearer to it than the width {} have {:.3g} "
        "numbers: take less cells or a smaller width",
        width, numbers);
}

void ComputeCoarseGrid::reset_grid()
{
  free_data();
  reach_of_grid = reach();
  require_countable();
  std::copy(domain->prd, domain->prd + 3, box_of_grid);
  sums = std::make_unique<GridSum>(lmp, cells, num_moments, reach_of_grid);
  const int *lo = sums->lo(), *hi = sums->hi(), columns = static_cast<int>(quantities.size());
  if (columns == 1)
    memory->create3d_offset(vector_of_cells, lo[2], hi[2], lo[1], hi[1], lo[0], hi[0],
                            "coarse/grid:vector");
  else
    memory->create4d_offset_last(array_of_cells, lo[2], hi[2], lo[1], hi[1], lo[0], hi[0], columns,
                                 "coarse/grid:array");
}

int ComputeCoarseGrid::get_grid_by_name(const std::string &name, int &dimension)
{
  if (name != "grid") return -1;
  dimension = 3;
  return 0;
}

void *ComputeCoarseGrid::get_grid_by_index(int index)
{
  return index == 0 ? sums->lammps_grid() : nullptr;
}

int ComputeCoarseGrid::get_griddata_by_name(int grid, const std::string &name, int &columns)
{
  if (grid != 0 || name != "data") return -1;
  columns = quantities.size() == 1 ? 0 : static_cast<int>(quantities.size());
  return 0;
}

void *ComputeCoarseGrid::get_griddata_by_index(int index)
{
  if (index != 0) return nullptr;
  if (vector_of_cells) return vector_of_cells;
  return array_of_cells;
}

double ComputeCoarseGrid::memory_usage()
{
  const int *lo = sums->lo(), *hi = sums->hi();
  double count = static_cast<double>(quantities.size());
  for (int d = 0; d < 3; d++) count *= hi[d] - lo[d] + 1;
  return count * sizeof(double) + sums->memory_usage();
}

/* ---- sums over particles and contacts ------------------------------------------------------- */

void ComputeCoarseGrid::compute_pergrid()
{
  invoked_pergrid = update->ntimestep;
  if (reach() > reach_of_grid || !std::equal(box_of_grid, box_of_grid + 3, domain->prd)) {
    check_box();
    reset_grid();
  }
  const Vector3<double> edge{domain->prd[0] / cells[0], domain->prd[1] / cells[1],
                             domain->prd[2] / cells[2]};
  kernel = std::make_unique<CoarseKernel>(row(domain->boxlo), edge, width, CoarseKernel::no_ends,
                                          mean_of);

  sums->clear();
  add_particles();
  if (with_contacts) add_contacts();
  sums->add_up();

  const int *lo = sums->owned_lo(), *hi = sums->owned_hi();
  for (int z = lo[2]; z <= hi[2]; z++)
    for (int y = lo[1]; y <= hi[1]; y++)
      for (int x = lo[0]; x <= hi[0]; x++) {
        double *to = vector_of_cells ? &vector_of_cells[z][y][x] : array_of_cells[z][y][x];
        for (const int q : quantities) *to++ = value(q, sums->at(x, y, z));
      }
}

/* nullptr: outside the box, where no field is asked for. */

double *ComputeCoarseGrid::moments_of(const CoarseKernel::Share &share)
{
  if (sums->has(share.cell)) return sums->at(share.cell[0], share.cell[1], share.cell[2]);
  for (int d = 0; d < 3; d++)
    if (!domain->periodicity[d] && (share.cell[d] < 0 || share.cell[d] >= cells[d])) return nullptr;
  error->one(FLERR,
             "compute coarse/grid: a particle is too far outside of the sub-domain of its rank");
  return nullptr;
}

void ComputeCoarseGrid::add_particles()
{
  const ShapedParticles *shapes = system->shapes();
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(atom->mask[i] & groupbit)) continue;
    const double m = atom->rmass[i], *v = atom->v[i];
    if (with_volumes) add_volume(row(atom->x[i]), particle_volume(*atom, shapes, i));
    for (const CoarseKernel::Share &share : kernel->of_point(row(atom->x[i]))) {
      double *to = moments_of(share);
      if (!to) continue;
      to[NUMBER] += share.weight;
      to[MASS] += share.weight * m;
      for (int d = 0; d < 3; d++) to[MOMENTUM + d] += share.weight * (m * v[d]);
      for (int k = 0; k < 6; k++)
        to[FLOW + k] += share.weight * (m * v[row_of[k]] * v[column_of[k]]);
    }
  }
}

/* Of the ball with this volume: of a shape that is not round, near enough where the width is not less than its size. */

void ComputeCoarseGrid::add_volume(const Vector3<double> &x, double volume)
{
  constexpr double of_ball = 0.23873241463784300365;    // 3/(4 pi)
  for (const CoarseKernel::Share &share : kernel->of_ball(x, std::cbrt(of_ball * volume)))
    if (double *const to = moments_of(share)) to[VOLUME] += share.weight * volume;
}

/* The line of a contact is divided where the surfaces meet: each particle has a branch from its
   center to there, which counts if the particle is in the group. A body has none. */

void ComputeCoarseGrid::add_contacts()
{
  contacts.for_each([&](const ContactReport &c) {
    const Vector3<double> &x = c.center[0], meeting = x + c.arm[0];
    if (atom->mask[c.i] & groupbit) add_branch(x, meeting, c.force);
    if (c.j >= 0 && (atom->mask[c.j] & groupbit)) add_branch(meeting - c.arm[1], meeting, -c.force);
  });
}

void ComputeCoarseGrid::add_branch(const Vector3<double> &from, const Vector3<double> &to,
                                   const Vector3<double> &force)
{
  const Vector3<double> branch = to - from;
  const double f[3] = {force.x, force.y, force.z}, b[3] = {branch.x, branch.y, branch.z};
  for (const CoarseKernel::Share &share : kernel->of_line(from, to)) {
    double *moments = moments_of(share);
    if (!moments) continue;
    for (int k = 0; k < 9; k++) moments[CONTACT + k] += share.weight * (f[k / 3] * b[k % 3]);
  }
}

/* ---- fields --------------------------------------------------------------------------------- */

double ComputeCoarseGrid::value(int q, const double *moments) const
{
  const double density = moments[MASS];
  const auto v = [&](int d) { return density > 0.0 ? moments[MOMENTUM + d] / density : 0.0; };
  const auto kinetic = [&](int k) {
    const double flow = moments[FLOW + k] - density * v(row_of[k]) * v(column_of[k]);
    return -flow * force->mvv2e * force->nktv2p;
  };
  const auto contact = [&](int a, int b) { return moments[CONTACT + 3 * a + b] * force->nktv2p; };

  if (q == Q_NUMBER) return moments[NUMBER];
  if (q == Q_DENSITY) return density * force->mv2d;
  if (q == Q_FRACTION) return moments[VOLUME];
  if (q < Q_TEMP) return v(q - Q_V);
  if (q == Q_TEMP) {
    if (!(density > 0.0)) return 0.0;
    double sum = 0.0;
    for (int k = 0; k < 3; k++) sum += moments[FLOW + k] - density * v(k) * v(k);
    return std::max(0.0, sum / (3.0 * density));
  }
  if (q < Q_CONTACT) return kinetic(q - Q_KINETIC);
  if (q < Q_STRESS) return contact((q - Q_CONTACT) / 3, (q - Q_CONTACT) % 3);
  if (q < Q_PRESSURE) {
    const int k = q - Q_STRESS;
    return kinetic(k) + contact(row_of[k], column_of[k]);
  }
  double trace = 0.0;
  for (int k = 0; k < 3; k++) trace += kinetic(k) + contact(k, k);
  return -trace / 3.0;
}
