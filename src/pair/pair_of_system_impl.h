// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Members of PairOfSystem: included by the sources of the styles.

#ifndef LMP_PAIR_OF_SYSTEM_IMPL_H
#define LMP_PAIR_OF_SYSTEM_IMPL_H

#include "pair/pair_of_system.h"

#include "contact/state_of_pair.h"
#include "contact/virial_sums.h"
#include "laws/intersection_radius.h"
#include "laws/tangential/end_of_contact.h"
#include "system/host/private_members.h"

#include "atom.h"
#include "comm.h"
#include "force.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>

namespace LAMMPS_NS {

template <class Base> std::string PairOfSystem<Base>::unsupported_settings() const
{
  if (Talus::sends_one_group(*this->comm)) return "'comm_modify group' leaves out proxies";
  return "";
}

template <class Base> void PairOfSystem<Base>::compute_contacts(int eflag, int vflag)
{
  this->ev_init(eflag, vflag);
  const std::function<void(const Talus::TalliedContact &)> to_lammps =
      [this](const Talus::TalliedContact &c) { tally(c); };
  const bool one_by_one = this->vflag_atom || this->cvflag_atom ||
                          (this->vflag_either && system->shapes() != nullptr),
             summed = this->vflag_global && !one_by_one;
  Talus::VirialSums sums;
  bonded_pairs.follow_bonds();
  system->step().compute_contacts(one_by_one ? &to_lammps : nullptr, summed ? &sums : nullptr);
  bonded_pairs.are_used();
  for (int n = 0; n < Talus::VirialSums::size && summed; n++) this->virial[n] += sums.value(n);
}

/* To LAMMPS, as if newton were off, an index of a ghost means that nothing is tallied for it. */

template <class Base> void PairOfSystem<Base>::tally(const Talus::TalliedContact &c)
{
  const int no_particle = this->atom->nlocal;
  this->ev_tally_xyz(c.for_i ? c.i : no_particle, c.for_j ? c.j : no_particle, no_particle, 0, 0.0,
                     0.0, c.force[0], c.force[1], c.force[2], c.separation[0], c.separation[1],
                     c.separation[2]);
}

template <class Base>
std::optional<SinglePair> PairOfSystem<Base>::look_at_pair(int i, int j, int itype, int jtype,
                                                           double rsq)
{
  using Vector = Talus::Vector3<double>;
  const auto row = [](const double *p) { return Vector{p[0], p[1], p[2]}; };
  const Atom *atom = this->atom;

  const Talus::LawTable &laws = system->law_table();
  const double ri = atom->radius[i], rj = atom->radius[j];
  const auto stored = system->contacts().history_of(i, j);
  const int row_of_types = laws.row(itype, jtype);
  const double touch = ri + rj + (stored ? laws.pulloff_distance(row_of_types, ri, rj) : 0.0);
  const bool ended = stored && laws.law(row_of_types).tangential().second_order &&
                     Talus::has_just_ended((*stored)[3], false);
  if ((rsq >= touch * touch && !ended) || rsq == 0.0) return {};

  const double r = std::sqrt(rsq);
  Talus::ContactState<double> s;
  s.normal = (1.0 / r) * (row(atom->x[i]) - row(atom->x[j]));
  s.overlap = ri + rj - r;
  s.velocity = row(atom->v[i]) - row(atom->v[j]);
  s.surface_rotation = ri * row(atom->omega[i]) + rj * row(atom->omega[j]);
  s.inverse_mass = 1.0 / system->masses().mass(i) + 1.0 / system->masses().mass(j);
  s.inverse_radius = 1.0 / ri + 1.0 / rj;
  s.relative_omega = row(atom->omega[i]) - row(atom->omega[j]);
  s.intersection_radius = Talus::intersection_radius_of(ri, rj, s.overlap);
  s.inverse_distance = 1.0 / r;
  s.arm_loss = s.overlap / (ri + rj);
  s.arm_difference = 0.5 * s.arm_loss * (rj - ri);
  const Talus::ParticleState particles = system->step().particles();
  if (const Talus::ChangeRecord *change = particles.change(i)) {
    s.lag = system->integrators().lag();
    Talus::set_changes(s, *change, *particles.change(j), ri, rj);
  }
  if (atom->temperature_flag)
    s.temperature_difference = atom->temperature[j] - atom->temperature[i];

  return SinglePair{Talus::single_contact(laws.law(row_of_types), laws.coefficients(row_of_types),
                                          s, this->update->dt,
                                          stored.value_or(Talus::HistoryValues{})),
                    r, ri, rj};
}

template <class Base>
void PairOfSystem<Base>::describe_pair(const std::optional<SinglePair> &pair, double *extra)
{
  std::fill(extra, extra + num_extra, 0.0);
  if (!pair) return;
  using Vector = Talus::Vector3<double>;
  const Talus::ContactLanes<double> &s = pair->contact;
  const Vector vn = dot(s.velocity, s.normal) * s.normal, vt = s.velocity - vn;
  const Vector ft = s.tangential;
  const double depth = s.overlap / std::min(pair->radius_i, pair->radius_j);
  const double found[] = {ft.x, ft.y, ft.z, std::sqrt(dot(ft, ft)), vn.x, vn.y, vn.z, vt.x,
                          vt.y, vt.z, depth};
  static_assert(std::size(found) == num_extra);
  std::copy(std::begin(found), std::end(found), extra);
}

template <class Base> int PairOfSystem<Base>::pack_masses(int n, const int *send, double *buf) const
{
  for (int k = 0; k < n; k++) buf[k] = system->masses().override_or_null()[send[k]];
  return n;
}

template <class Base> void PairOfSystem<Base>::unpack_masses(int n, int first, const double *buf)
{
  std::copy(buf, buf + n, system->masses().override_or_null() + first);
}

}    // namespace LAMMPS_NS

#endif
