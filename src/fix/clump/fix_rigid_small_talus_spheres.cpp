/* Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE */

/* ----------------------------------------------------------------------
   Which spheres the clumps of a rank have, and what ranks that share a clump tell each other.

   A message goes to ghosts of spheres of clumps only: both sides know which these are. What it
   holds is a row of numbers for each of them:

     MEMBERS  ID of the body, place in the clump
     STATES   position without periods, velocity, angular velocity, mass, radius
     LOADS    force, torque
------------------------------------------------------------------------- */

#include "fix/clump/fix_rigid_small_talus.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"

#include <algorithm>

using namespace LAMMPS_NS;

namespace {
constexpr int size_members = 4, size_loads = 6;
}

tagint FixRigidSmallTalus::clump_of(int i) const
{
  return i < atom->nlocal ? bodytag[i] : ghost_clump[i - atom->nlocal];
}

/* Of an owned particle. */

void FixRigidSmallTalus::write_row(int i, double *row) const
{
  if (message == Message::MEMBERS) {
    row[0] = ubuf(bodytag[i]).d;
    std::copy(displace[i], displace[i] + 3, row + 1);
  } else if (message == Message::STATES) {
    write_state_row(i, row);
  } else {
    const auto [f, t] = particles.load(i);
    const double loads[size_loads] = {f.x, f.y, f.z, t.x, t.y, t.z};
    std::copy(loads, loads + size_loads, row);
  }
}

void FixRigidSmallTalus::write_state_row(int i, double *row) const
{
  domain->unmap(atom->x[i], atom->image[i], row);
  std::copy(atom->v[i], atom->v[i] + 3, row + 3);
  std::copy(atom->omega[i], atom->omega[i] + 3, row + 6);
  row[9] = atom->rmass[i];
  row[10] = atom->radius[i];
}

/* A ghost may go on to other ranks, as it came. */

int FixRigidSmallTalus::pack_forward_comm(int n, int *list, double *buf, int pbc_flag, int *pbc)
{
  if (message == Message::STOCK)
    return FixRigidSmall::pack_forward_comm(n, list, buf, pbc_flag, pbc);
  int m = 0;
  for (int k = 0; k < n; k++) {
    const int i = list[k];
    if (message != Message::MEMBERS && !clump_of(i)) continue;
    if (i < atom->nlocal)
      write_row(i, buf + m);
    else
      std::copy_n(&ghost_rows[static_cast<std::size_t>(row_size) * (i - atom->nlocal)], row_size,
                  buf + m);
    m += row_size;
  }
  return m;
}

void FixRigidSmallTalus::unpack_forward_comm(int n, int first, double *buf)
{
  if (message == Message::STOCK) return FixRigidSmall::unpack_forward_comm(n, first, buf);
  int m = 0;
  for (int k = 0; k < n; k++) {
    const int ghost = first + k - atom->nlocal;
    if (message == Message::MEMBERS)
      ghost_clump[ghost] = static_cast<tagint>(ubuf(buf[m]).i);
    else if (!ghost_clump[ghost])
      continue;
    std::copy_n(buf + m, row_size, &ghost_rows[static_cast<std::size_t>(row_size) * ghost]);
    m += row_size;
  }
}

void FixRigidSmallTalus::exchange_rows(Message what, int size)
{
  message = what;
  row_size = size;
  ghost_rows.resize(static_cast<std::size_t>(size) * atom->nghost);
  comm->forward_comm(this, size);
  message = Message::STOCK;
}

const double *FixRigidSmallTalus::row_of(const ClumpSphere &sphere) const
{
  return &ghost_rows[static_cast<std::size_t>(row_size) * (sphere.atom - atom->nlocal)];
}

void FixRigidSmallTalus::share_loads()
{
  if (shares_clumps) exchange_rows(Message::LOADS, size_loads);
}

/* ----------------------------------------------------------------------
   after the stock class knows its bodies and ghosts: clumps in the order of their first
   owned spheres, so that what is near in space is near in memory
------------------------------------------------------------------------- */

void FixRigidSmallTalus::make_table()
{
  ghost_clump.assign(atom->nghost, 0);
  exchange_rows(Message::MEMBERS, size_members);

  table = ClumpTable{};
  std::vector<int> clump_of_body(nlocal_body + nghost_body, -1);
  for (int i = 0; i < atom->nlocal; i++) {
    if (atom2body[i] < 0 || clump_of_body[atom2body[i]] >= 0) continue;
    clump_of_body[atom2body[i]] = table.size();
    table.body.push_back(atom2body[i]);
  }

  struct Found {
    int clump;
    ClumpSphere sphere;
  };
  std::vector<Found> found;
  for (int i = 0; i < atom->nlocal + atom->nghost; i++) {
    const bool owned = i < atom->nlocal;
    if (!clump_of(i) || atom->map(atom->tag[i]) != i) continue;
    const int owner = atom->map(clump_of(i));
    const int b = owned ? atom2body[i] : owner >= 0 ? bodyown[owner] : -1;
    if (b < 0 || clump_of_body[b] < 0) continue;
    ClumpSphere s{{}, atom->tag[i], i, owned, false, {0, 0, 0}};
    const double *place = owned ? displace[i] : row_of(s) + 1;
    s.place = {place[0], place[1], place[2]};
    const imageint image = owned ? xcmimage[i] : 0;
    if (owned) {
      s.periods[0] = static_cast<int>(image & IMGMASK) - IMGMAX;
      s.periods[1] = static_cast<int>(image >> IMGBITS & IMGMASK) - IMGMAX;
      s.periods[2] = static_cast<int>(image >> IMG2BITS) - IMGMAX;
      s.wrapped = s.periods[0] || s.periods[1] || s.periods[2];
    }
    found.push_back({clump_of_body[b], s});
  }
  std::sort(found.begin(), found.end(), [](const Found &a, const Found &b) {
    return a.clump != b.clump ? a.clump < b.clump : a.sphere.tag < b.sphere.tag;
  });

  table.first.assign(table.size() + 1, 0);
  table.spheres.reserve(found.size());
  bool shares = false, incomplete = false;
  for (const Found &one : found) {
    table.first[one.clump + 1]++;
    table.spheres.push_back(one.sphere);
    shares = shares || !one.sphere.owned;
  }
  for (int c = 0; c < table.size(); c++) {
    incomplete = incomplete || table.first[c + 1] != body[table.body[c]].natoms;
    table.first[c + 1] += table.first[c];
  }
  // spheres that have left the box are missing as well, and are not needed
  int mine[2] = {shares, incomplete && comm->mode != Comm::SINGLE}, any[2];
  MPI_Allreduce(mine, any, 2, MPI_INT, MPI_MAX, world);
  shares_clumps = any[0];
  if (any[1])
    error->all(FLERR, Error::NOLASTLINE,
               "Fix {} {}: a clump has spheres that are farther from each other than ghosts reach: "
               "use 'comm_modify mode single'",
               style, id);
}

/* Fix deform with remap x, before and after the box changes: clumps of other ranks, of which spheres are here, move here
   by themselves. */

void FixRigidSmallTalus::deform(int flag)
{
  FixRigidSmall::deform(flag);
  if (!reason.empty()) return;
  for (int b = nlocal_body; b < nlocal_body + nghost_body; b++)
    if (flag == 0)
      domain->x2lamda(body[b].xcm, body[b].xcm);
    else
      domain->lamda2x(body[b].xcm, body[b].xcm);
}

void FixRigidSmallTalus::pre_neighbor()
{
  FixRigidSmall::pre_neighbor();
  if (reason.empty()) make_table();
}
