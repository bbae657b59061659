/* Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE */

// What fix shape/gran refuses: whatever would take its particles for spheres; and what it warns of.

#include "fix/shape/fix_shape_gran.h"
#include "system/host/fix_list.h"

#include "atom.h"
#include "comm.h"
#include "compute.h"
#include "error.h"
#include "force.h"
#include "group.h"
#include "modify.h"
#include "neighbor.h"
#include "pair.h"
#include "update.h"

#include <algorithm>
#include <cstring>

using namespace LAMMPS_NS;
using namespace Talus;

void FixShapeGran::check_scene()
{
  if (update->whichflag == 2)
    error->all(FLERR, Error::NOLASTLINE, "Fix shape/gran cannot be used with minimize");
  if (utils::strmatch(update->integrate_style, "^respa"))
    error->all(FLERR, Error::NOLASTLINE,
               "Fix shape/gran cannot be used with run_style respa: use run_style verlet");
  if (system->integrators().order() == 2)
    error->all(FLERR, Error::NOLASTLINE,
               "Fix shape/gran: contacts of shapes are of first order: use 'order 1' in all fixes "
               "nve/sphere/symplectic and rigid/small/symplectic");
  if (!system->pair_style().is_alone())
    error->all(FLERR, Error::NOLASTLINE,
               "Fix shape/gran: contacts of shapes are computed by Talus alone, but {}: use "
               "'pair_style gran/penalty', or a granular pair style with the suffix talus, alone",
               system->pair_style().is_there() ? "the pair style is hybrid"
                                               : system->pair_style().reason_against());
  const std::string lists = system->neighbors().reason_for_lammps_lists();
  if (!lists.empty())
    error->all(FLERR, Error::NOLASTLINE,
               "Fix shape/gran: neighbor lists are those of LAMMPS because of {}: leave it out",
               lists);
  check_pairs();
  check_fixes();
  check_computes();
  check_bodies();
}

void FixShapeGran::check_pairs()
{
  const LawTable &laws = system->law_table();
  const auto name = [this](int type) {
    return shapes->is_shaped(type) ? shapes->table().of(type)->shape().name() : "sphere";
  };
  for (int i = 1; i <= atom->ntypes; i++)
    for (int j = i; j <= atom->ntypes; j++) {
      if (!shapes->is_shaped(i) && !shapes->is_shaped(j)) continue;
      if (!shapes->table().collision(i, j))
        error->all(
            FLERR, Error::NOLASTLINE,
            "Fix shape/gran: contacts of types {} and {}, which have the shapes {} and {}, are "
            "not known: give particles of this script other shapes",
            i, j, name(i), name(j));
      const std::string reason = PointBatch::refusal(laws.law(laws.row(i, j)));
      if (!reason.empty())
        error->all(FLERR, Error::NOLASTLINE,
                   "Fix shape/gran: the contact of types {} and {}, of which one has a shape, {}",
                   i, j, reason);
    }
}

void FixShapeGran::check_bodies()
{
  shapes->forget_bodies();
  for (LargeBody *body : system->bodies().in_order()) {
    const std::string surface = shapes->refusal(*body);
    if (!surface.empty()) error->all(FLERR, Error::NOLASTLINE, "{}: {}", body->name(), surface);
    for (int type = 1; type <= shapes->table().last_type(); type++) {
      if (!shapes->is_shaped(type)) continue;
      const std::string law = PointBatch::refusal(body->law_of(type));
      if (!law.empty())
        error->all(FLERR, Error::NOLASTLINE,
                   "{}: its contact with particles of type {}, which have a shape, {}",
                   body->name(), type, law);
    }
  }
}

void FixShapeGran::check_fixes()
{
  other_integrators = 0;
  for (auto &fix : Talus::fix_list(*modify)) {
    if (fix == this) continue;
    if (fix->time_integrate) other_integrators |= fix->groupbit;
    if (utils::strmatch(fix->style, "^wall/gran"))
      error->all(FLERR, Error::NOLASTLINE,
                 "Fix shape/gran: fix {} ({}) takes particles for spheres: use fix large/body",
                 fix->id, fix->style);
    if (!utils::strmatch(fix->style, "^pour")) continue;    // fix deposit asks for distances
    for (int type = 1; type <= shapes->table().last_type(); type++) {
      int of_type = type;
      const auto *largest = static_cast<double *>(fix->extract("radius", of_type));
      const double needed = shapes->table().bounding_radius(type);
      if (largest && *largest > 0.0 && needed > 0.0 && *largest < needed * (1.0 - 1.0e-6))
        error->all(FLERR, Error::NOLASTLINE,
                   "Fix shape/gran: fix {} ({}) puts particles of type {} where a sphere with a "
                   "diameter of {:.8g} has room, but the sphere around their shape has one of "
                   "{:.8g}: give it a diameter of {:.8g}",
                   fix->id, fix->style, type, 2.0 * *largest, 2.0 * needed,
                   2.0 * needed * (1.0 + 1.0e-6));
    }
  }
  require_no_other_integrator();
  // of the group only some move: LAMMPS would warn of two integrators of spheres in it
  time_integrate = other_integrators == 0;
}

/* They compare distances with radii, or ask the pair style for contacts of spheres. */

void FixShapeGran::check_computes()
{
  struct {
    const char *style, *instead;
  } constexpr of_spheres[] = {
      {"pair/local", "compute contact/gran/local"},
      {"contact/atom", "compute contact/gran/atom"},
      {"rattlers/atom", "compute contact/gran/atom"},
      {"fabric", "the normals of compute contact/gran/local"},
      {"group/group", "the rows of compute contact/gran/local"},
      {"stress/cartesian", "compute coarse/grid"},
      {"stress/cylinder", "compute coarse/grid"},
      {"stress/spherical", "compute coarse/grid"},
      {"stress/mop", "compute coarse/grid"},
      {"stress/mop/profile", "compute coarse/grid"},
  };
  for (auto &compute : modify->get_compute_list())
    for (const auto &one : of_spheres)
      if (strcmp(compute->style, one.style) == 0)
        error->all(FLERR, Error::NOLASTLINE,
                   "Fix shape/gran: compute {} ({}) knows contacts of spheres only: use {}",
                   compute->id, compute->style, one.instead);
}

/* Collective: what a rank says alone may be lost when the others are aborted. */

void FixShapeGran::require_no_other_integrator() const
{
  if (!other_integrators) return;
  bigint mine[2] = {MAXBIGINT, 0}, first = 0;    // ID and type
  for (int i = 0; i < atom->nlocal; i++)
    if (shapes->is_shaped(atom->type[i]) && (atom->mask[i] & other_integrators) &&
        atom->tag[i] < mine[0]) {
      mine[0] = atom->tag[i];
      mine[1] = atom->type[i];
    }
  MPI_Allreduce(mine, &first, 1, MPI_LMP_BIGINT, MPI_MIN, world);
  if (first == MAXBIGINT) return;
  bigint type = mine[0] == first ? mine[1] : 0;
  MPI_Allreduce(MPI_IN_PLACE, &type, 1, MPI_LMP_BIGINT, MPI_MAX, world);
  error->all(FLERR, Error::NOLASTLINE,
             "Fix shape/gran: particle {} of type {} has a shape and belongs to the group of "
             "another fix that moves particles: give that fix a group of spheres only",
             first, type);
}

/* ---- warnings ---- */

/* An overlap of cores is deeper than both radii: contacts are those of sharp bodies from there on. */

RunMonitor::Check FixShapeGran::check_of_cores()
{
  const auto look = [this]() -> RunMonitor::Finding {
    const ShapedPairs::CoreOverlap deepest = shapes->pairs().deepest_core_overlap();
    if (!(deepest.depth > 0.0)) return {};
    const auto [low, high] = std::minmax(atom->tag[deepest.first], atom->tag[deepest.second]);
    return {deepest.ratio, {static_cast<double>(low), static_cast<double>(high)}};
  };
  const auto say = [this](const RunMonitor::Finding &worst) {
    if (comm->me == 0)
      error->warning(
          FLERR,
          "Fix shape/gran: the cores of the rounded particles {:.0f} and {:.0f} overlap, "
          "by {:.3g} of the smaller rounding radius, at step {} or since the last "
          "rebuild: forces jump there and energy is not kept. Use stiffer contacts and a "
          "smaller time step, round more, or look for particles that overlap from the "
          "beginning. Said once, unless it becomes much worse",
          worst.details[0], worst.details[1], worst.value, update->ntimestep);
    return true;
  };
  return {0.0, look, say, 3.0};
}
