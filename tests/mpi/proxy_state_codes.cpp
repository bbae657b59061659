// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Encoded values through the host, without physics: every owned particle gets a code as velocity
// and spin and a small move, ghosts are filled with NaN, and after forward_comm() every ghost must
// hold what its owner has. The same is then asked of the host's staged exchange, bit for bit.
//
// proxy_state_codes FILE...: each file is an input script that ends with a box, particles and a
// neighbor list ('run 0'), with 'comm_proxy yes'. Prints "codes right" when all were.

#include "comm_brick.h"
#include "comm_tiled.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "input.h"
#include "lammps.h"

#include <mpi.h>

#include <cmath>
#include <cstdio>
#include <cstring>
#include <exception>
#include <limits>
#include <map>
#include <string>
#include <vector>

using namespace LAMMPS_NS;

namespace {

int failures = 0;

void expect(bool holds, const std::string &what)
{
  if (holds) return;
  if (failures++ < 10) std::fprintf(stderr, "failed: %s\n", what.c_str());
}

double code(tagint tag, int round, int entry)
{
  return static_cast<double>(tag) + 1.0 / (1 + round) + 0.001 * entry;
}

struct Owner {
  double x[3], v[3], omega[3];
};

class CodedGhosts {
 public:
  CodedGhosts(LAMMPS *lmp, const std::string &name) :
      atom(lmp->atom), comm(lmp->comm), domain(lmp->domain), scene(name),
      rotation(atom->omega_flag && comm->ghost_velocity)
  {
  }

  void check_round(int round)
  {
    encode(round);
    const std::map<tagint, Owner> owners = gather();
    poison();
    comm->forward_comm();    // the direct exchange
    const std::vector<double> direct = ghost_states();
    for (int i = atom->nlocal; i < atom->nlocal + atom->nghost; i++)
      compare(i, owners.at(atom->tag[i]));

    poison();
    if (comm->style == Comm::TILED)    // the staged one
      static_cast<CommTiled *>(comm)->CommTiled::forward_comm();
    else
      static_cast<CommBrick *>(comm)->CommBrick::forward_comm();
    const std::vector<double> staged = ghost_states();
    // no ghosts, no storage: nothing to hand to memcmp
    expect(direct.empty() ||
               std::memcmp(direct.data(), staged.data(), sizeof(double) * direct.size()) == 0,
           scene + ": not the bits of the staged exchange");
  }

 private:
  void encode(int round)
  {
    for (int i = 0; i < atom->nlocal; i++)
      for (int d = 0; d < 3; d++) {
        atom->x[i][d] += 1e-4 * std::sin(static_cast<double>(atom->tag[i]) + d + round);
        atom->v[i][d] = code(atom->tag[i], round, d);
        if (rotation) atom->omega[i][d] = code(atom->tag[i], round, 3 + d);
      }
  }

  std::map<tagint, Owner> gather() const
  {
    std::vector<double> mine, all;
    for (int i = 0; i < atom->nlocal; i++) {
      mine.push_back(static_cast<double>(atom->tag[i]));
      for (double **array : {atom->x, atom->v, rotation ? atom->omega : atom->v})
        mine.insert(mine.end(), array[i], array[i] + 3);
    }
    int ranks = 1, count = static_cast<int>(mine.size());
    MPI_Comm_size(MPI_COMM_WORLD, &ranks);
    std::vector<int> counts(ranks), first(ranks, 0);
    MPI_Allgather(&count, 1, MPI_INT, counts.data(), 1, MPI_INT, MPI_COMM_WORLD);
    for (int r = 1; r < ranks; r++) first[r] = first[r - 1] + counts[r - 1];
    all.resize(first[ranks - 1] + counts[ranks - 1]);
    MPI_Allgatherv(mine.data(), count, MPI_DOUBLE, all.data(), counts.data(), first.data(),
                   MPI_DOUBLE, MPI_COMM_WORLD);
    std::map<tagint, Owner> owners;
    for (std::size_t k = 0; k < all.size(); k += 10) {
      Owner o;
      std::memcpy(&o, &all[k + 1], sizeof o);
      owners[static_cast<tagint>(all[k])] = o;
    }
    return owners;
  }

  void poison()
  {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (int i = atom->nlocal; i < atom->nlocal + atom->nghost; i++)
      for (int d = 0; d < 3; d++) {
        atom->x[i][d] = nan;
        if (comm->ghost_velocity) atom->v[i][d] = nan;
        if (rotation) atom->omega[i][d] = nan;
      }
  }

  std::vector<double> ghost_states() const
  {
    std::vector<double> states;
    for (int i = atom->nlocal; i < atom->nlocal + atom->nghost; i++) {
      states.insert(states.end(), atom->x[i], atom->x[i] + 3);
      if (comm->ghost_velocity) states.insert(states.end(), atom->v[i], atom->v[i] + 3);
      if (rotation) states.insert(states.end(), atom->omega[i], atom->omega[i] + 3);
    }
    return states;
  }

  void compare(int i, const Owner &owner) const
  {
    const std::string who = scene + ": ghost of " + std::to_string(atom->tag[i]);
    // of images in a box that changes its shape it is another one: that of LAMMPS, see check_round()
    if (comm->ghost_velocity && !domain->deform_vremap)
      expect(std::memcmp(atom->v[i], owner.v, sizeof owner.v) == 0, who + ": v");
    if (rotation)
      expect(std::memcmp(atom->omega[i], owner.omega, sizeof owner.omega) == 0, who + ": w");

    // whole periods away, across periodic boundaries only
    double periods[3], distance[3];
    for (int d = 0; d < 3; d++) distance[d] = atom->x[i][d] - owner.x[d];
    if (domain->triclinic) {
      periods[2] = distance[2] / domain->zprd;
      periods[1] = (distance[1] - periods[2] * domain->yz) / domain->yprd;
      periods[0] = (distance[0] - periods[1] * domain->xy - periods[2] * domain->xz) / domain->xprd;
    } else
      for (int d = 0; d < 3; d++) periods[d] = distance[d] / domain->prd[d];
    for (int d = 0; d < 3; d++) {
      const double whole = std::round(periods[d]);
      expect(std::abs(periods[d] - whole) < 1e-12, who + ": not whole periods away");
      expect(whole == 0.0 || domain->periodicity[d], who + ": across a wall");
    }
  }

  Atom *atom;
  Comm *comm;
  Domain *domain;
  std::string scene;
  bool rotation;
};

int check_scene(const char *file)
{
  const char *words[] = {"codes", "-log", "none", "-screen", "none"};
  auto **arguments = const_cast<char **>(words);
  auto *lmp = new LAMMPS(5, arguments, MPI_COMM_WORLD);
  lmp->input->file(file);
  CodedGhosts ghosts(lmp, file);
  for (int round = 0; round < 3; round++) ghosts.check_round(round);
  int mine = lmp->atom->nghost, count = 0;
  MPI_Allreduce(&mine, &count, 1, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
  delete lmp;
  return count;
}

}    // namespace

int main(int argc, char **argv)
{
  MPI_Init(&argc, &argv);
  int me = 0, all = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &me);
  for (int k = 1; k < argc; k++) {
    try {
      const int ghosts = check_scene(argv[k]);
      if (me == 0) std::printf("%s %d ghosts\n", argv[k], ghosts);
    } catch (const std::exception &problem) {    // an error message of the host
      std::fprintf(stderr, "%s: %s\n", argv[k], problem.what());
      MPI_Abort(MPI_COMM_WORLD, 1);
    }
  }
  MPI_Allreduce(&failures, &all, 1, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
  if (me == 0 && all == 0) std::puts("codes right");
  MPI_Finalize();
  return all != 0;
}
