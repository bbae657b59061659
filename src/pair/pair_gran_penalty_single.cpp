// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Pair style gran/penalty: one pair of particles on request.

#include "pair/pair_gran_penalty.h"

#include "laws/circle_of_intersection.h"

#include "atom.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <iterator>

using namespace LAMMPS_NS;
using namespace Talus;

namespace {

Vector3<double> row(const double *p)
{
  return {p[0], p[1], p[2]};
}

}    // namespace

double PairGranPenalty::single(int i, int j, int itype, int jtype, double rsq, double, double,
                               double &fforce)
{
  fforce = 0.0;
  const LawTable &laws = system->law_table();
  std::fill(svector, svector + single_extra, 0.0);
  const double ri = atom->radius[i], rj = atom->radius[j];
  if (rsq >= (ri + rj) * (ri + rj) || rsq == 0.0) return 0.0;

  const double r = std::sqrt(rsq);
  ContactState<double> s;
  s.normal = (1.0 / r) * (row(atom->x[i]) - row(atom->x[j]));
  s.overlap = ri + rj - r;
  s.velocity = row(atom->v[i]) - row(atom->v[j]);
  s.surface_rotation = ri * row(atom->omega[i]) + rj * row(atom->omega[j]);
  s.inverse_mass = 1.0 / system->mass_in_contacts(i) + 1.0 / system->mass_in_contacts(j);
  s.inverse_radius = 1.0 / ri + 1.0 / rj;
  s.relative_omega = row(atom->omega[i]) - row(atom->omega[j]);
  s.circle = circle_of_intersection(ri, rj, s.overlap);
  s.inverse_distance = 1.0 / r;

  ContactImpact<double> impact;
  const TangentialHistory<double> history = system->history_of(i, j, impact);
  const int row_of_types = laws.row(itype, jtype);
  const Vector3<double> &d = history.displacement;
  const ContactLanes<double> out =
      single_contact(laws.law(row_of_types), laws.coefficients(row_of_types), s, update->dt,
                     {{d.x, d.y, d.z, history.sliding, impact.speed, impact.age, impact.begun}});

  const Vector3<double> vn = dot(s.velocity, s.normal) * s.normal, vt = s.velocity - vn;
  const Vector3<double> ft = out.tangential;
  // ten entries as the stock gran/* styles, then overlap/radius
  const double extra[] = {ft.x, ft.y, ft.z, std::sqrt(dot(ft, ft)),      vn.x, vn.y, vn.z,
                          vt.x, vt.y, vt.z, s.overlap / std::min(ri, rj)};
  std::copy(std::begin(extra), std::end(extra), svector);
  fforce = dot(out.force - out.tangential, s.normal) / r;    // with adhesion
  return 0.0;
}
