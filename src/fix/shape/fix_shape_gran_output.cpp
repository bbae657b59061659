/* Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE */

// What fix shape/gran can be asked: sums over ranks, pictures; and fix_modify.

#include "fix/shape/fix_shape_gran.h"

#include "base/rows.h"
#include "system/host/command_words.h"
#include "system/host/lammps_compat.h"

#include "atom.h"
#include "force.h"
#include "input.h"
#include "modify.h"
#include "update.h"

#include <cstring>

using namespace LAMMPS_NS;
using namespace Talus;

/* Of particles of the group: energies of translation and rotation, angular momentum about their
   centers; and of all contacts between particles: pairs that touch, points. */

std::array<double, FixShapeGran::size_sums> FixShapeGran::sums() const
{
  std::array<double, size_sums> mine{}, all{};
  double *const *const quat = shapes->orientations();
  for (int i = 0; i < atom->nlocal; i++) {
    const ParticleShape *shape = shapes->table().of(atom->type[i]);
    if (!shape || !(atom->mask[i] & groupbit) || !is_known(quat[i])) continue;
    const Vector3<double> v = row(atom->v[i]), omega = row(atom->omega[i]);
    const Eigen::Quaterniond q = quaternion(quat[i]);
    const Vector3<double> momentum = shape->rotation().angular_momentum(q, omega);
    mine[0] += 0.5 * force->mvv2e * atom->rmass[i] * dot(v, v);
    mine[1] += 0.5 * force->mvv2e * dot(omega, momentum);
    mine[2] += momentum.x;
    mine[3] += momentum.y;
    mine[4] += momentum.z;
  }
  const ShapedPairs::Count pairs = shapes->pairs().count();
  mine[5] = pairs.contacts;
  mine[6] = pairs.points;
  MPI_Allreduce(mine.data(), all.data(), size_sums, MPI_DOUBLE, MPI_SUM, world);
  return all;
}

double FixShapeGran::compute_scalar()
{
  const auto all = sums();
  return all[0] + all[1];
}

double FixShapeGran::compute_vector(int n)
{
  return sums()[n];
}

/* The words behind the keyword; of the command line those before it are missing. */

static Words words_of_modify(LAMMPS *lmp, int narg, char **arg)
{
  return command_words(lmp, "fix_modify shape/gran", narg, arg, 1, lmp->input->narg - narg);
}

int FixShapeGran::modify_param(int narg, char **arg)
{
  if (strcmp(arg[0], "picture") == 0) return add_to_picture(narg, arg);
  if (strcmp(arg[0], "orient") != 0) return 0;
  Words words = words_of_modify(lmp, narg, arg);
  words.about("orient");
  const int tag = words.integer("ID of a particle", 1);
  double q[4];
  for (double &component : q) component = words.number("w x y z");
  Eigen::Quaterniond orientation = quaternion(q);
  if (!(orientation.norm() > 0.0)) words.fail(1, "a quaternion must not be zero");
  orientation.normalize();
  int mine = shapes->set_orientation(tag, orientation), all = 0;
  MPI_Allreduce(&mine, &all, 1, MPI_INT, MPI_SUM, world);
  if (!all) words.fail(5, "no particle with this ID has a shape");
  return words.index();
}

int FixShapeGran::add_to_picture(int narg, char **arg)
{
  Words words = words_of_modify(lmp, narg, arg);
  words.about("picture");
  const std::string other = words.text("ID of a fix");
  if (!modify->get_fix_by_id(other) || other == id)
    words.fail(1, "there is no other fix with this ID: define it before");
  const int type = words.integer("type N", 1);
  if (type > atom->ntypes)
    words.fail(1, "there are " + std::to_string(atom->ntypes) +
                      " types: give a larger number to "
                      "create_box for a color of its own");
  also_drawn.emplace_back(other, type);
  return words.index();
}

/* For dump image. Others are drawn along, for a picture has one fix. */

int FixShapeGran::image(int *&kinds, double **&values)
{
  drawn.clear();
  shapes->for_each_triangle([&](int i, const Triangle &one) { drawn.add(atom->type[i], one); });
  for (const auto &[other, type] : also_drawn) {
    Fix *fix = modify->get_fix_by_id(other);
    const int count = fix ? fix->image(kinds, values) : 0;
    for (int k = 0; k < count; k++)
      if (kinds[k] == TALUS_IMAGE_TRIANGLE) drawn.add_row(type, values[k]);
  }
  return drawn.hand_out(kinds, values);
}
