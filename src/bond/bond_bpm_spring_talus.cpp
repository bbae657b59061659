/* Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE */

#include "bond/bond_bpm_spring_talus.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "fix_bond_history.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <utility>

using namespace LAMMPS_NS;

BondBPMSpringTalus::BondBPMSpringTalus(LAMMPS *lmp) :
    BondBPMTalus(lmp, {1.0, TALUS_HOST_HAS_SPRING_ENERGY != 0})
{
}

std::string BondBPMSpringTalus::lacking_words() const
{
  return TALUS_HOST_HAS_BOND_FRAMES ? "" : "no 'break'";
}

/* LAMMPS sends one number of each particle, here there are two; after read_restart it knows of none. */

void BondBPMSpringTalus::init_style()
{
  BondBPMTalus::init_style();
  if (!volume_flag) return;
  comm_forward = reason_for_stock().empty() ? 2 : 1;
  comm_reverse = 1;
}

void BondBPMSpringTalus::prepare()
{
  check_strengths({{"ecrit", ecrit}}, "strain to break at");
  Talus::SpringModel of_all;
  of_all.per_length = normalize_flag != 0;
  of_all.smooth = smooth_flag != 0 && break_flag != 0;
  of_all.dimension = domain->dimension;
  of_all.coeffs.resize(atom->nbondtypes + 1);
  for (int t = 1; t <= atom->nbondtypes; t++)
    of_all.coeffs[t] = {k[t], ecrit[t], gamma[t], volume_flag ? av[t] : 0.0};
  bonds.set_model(of_all);
}

/* ---------------------------------------------------------------------- */

void BondBPMSpringTalus::load_bonds(bool first)
{
  if (volume_flag) find_volumes(first);
  added.clear();
  if (bonds.count() == 0) return;
  const Talus::ParticleState now = system->step().particles();
  const bool breaks =
      break_flag != 0 && !(TALUS_HOST_KEEPS_SPRINGS_IN_SETUP && update->setupflag != 0);
  bonds.compute({now.positions(), now.velocities(), fix_bond_history->bondstore[0],
                 volume_flag ? atom->dvector[index_vol] : nullptr,
                 volume_flag ? atom->dvector[index_vol0] : nullptr},
                breaks, comm->nthreads);
}

void BondBPMSpringTalus::store_new(int n, int i, int j, bool first)
{
  const double *const *x = atom->x;
  const double length = std::sqrt((x[i][0] - x[j][0]) * (x[i][0] - x[j][0]) +
                                  (x[i][1] - x[j][1]) * (x[i][1] - x[j][1]) +
                                  (x[i][2] - x[j][2]) * (x[i][2] - x[j][2]));
  fix_bond_history->bondstore[n][0] = length;
  for (const auto &[end, other] : {std::pair(i, j), std::pair(j, i)}) {
    if (end >= atom->nlocal) continue;
    for (int m = 0; m < atom->num_bond[end]; m++)
      if (atom->bond_atom[end][m] == atom->tag[other])
        fix_bond_history->update_atom_value(end, m, 0, length);
  }
  if (!first) added.push_back(n);
}

/* ---------------------------------------------------------------------- */

bool BondBPMSpringTalus::has_no_volumes(bool first) const
{
#if TALUS_HOST_FLAGS_SPRING_VOLUMES
  return first || !vol0_calculated;
#else
  return first;
#endif
}

/* Volumes of owned particles at present and at rest, and both of ghosts. */

void BondBPMSpringTalus::find_volumes(bool first)
{
  double *const now = atom->dvector[index_vol], *const at_rest = atom->dvector[index_vol0];
  bonds.sum_volumes(system->step().particles().positions(), now, comm->nthreads);
  if (has_no_volumes(first))
    std::copy(now, now + atom->nlocal, at_rest);
  else
    add_volumes_at_rest(added, 1.0);
#if TALUS_HOST_FLAGS_SPRING_VOLUMES
  vol0_calculated = 1;
#endif
  comm->forward_comm(this);
}

void BondBPMSpringTalus::add_volumes_at_rest(const std::vector<int> &of, double sign)
{
  if (of.empty()) return;
  bonds.add_volumes_at_rest(of, fix_bond_history->bondstore[0], sign, atom->dvector[index_vol0],
                            comm->nthreads);
}

/* Forces of this step are known: it counts from the next one on. */

void BondBPMSpringTalus::account_for_broken()
{
  if (!volume_flag) return;
  std::vector<int> broken;
  bonds.for_each_broken([&](int n) { broken.push_back(n); });
  add_volumes_at_rest(broken, -1.0);
}

int BondBPMSpringTalus::pack_forward_comm(int n, int *list, double *buf, int pbc_flag, int *pbc)
{
  if (!reason_for_stock().empty())
    return BondBPMSpring::pack_forward_comm(n, list, buf, pbc_flag, pbc);
  const double *const now = atom->dvector[index_vol], *const at_rest = atom->dvector[index_vol0];
  for (int k = 0; k < n; k++) {
    *buf++ = now[list[k]];
    *buf++ = at_rest[list[k]];
  }
  return 2 * n;
}

void BondBPMSpringTalus::unpack_forward_comm(int n, int first, double *buf)
{
  if (!reason_for_stock().empty()) return BondBPMSpring::unpack_forward_comm(n, first, buf);
  double *const now = atom->dvector[index_vol], *const at_rest = atom->dvector[index_vol0];
  for (int i = first; i < first + n; i++) {
    now[i] = *buf++;
    at_rest[i] = *buf++;
  }
}
