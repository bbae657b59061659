// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// An error thrown between begin and finish of an exchange, through the library interface, and what
// can follow it: another run, the stock exchange, `clear`, the end. Also looks into the window
// itself: the exchange is pending, and with `comm_proxy check yes` all proxies hold NaN until it is
// finished. The look is taken, and the error thrown, in the first call of MPI_Wtime() in the window,
// which stands at the beginning of finish(): this program has an MPI_Wtime() of its own.
//
// Prints "windows N" (steps whose window was seen on rank 0) and "survived" when all went well.

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "input.h"
#include "lammps.h"
#include "neighbor.h"
#include "update.h"

#include <mpi.h>

#include <cmath>
#include <cstdio>
#include <exception>
#include <memory>
#include <string>

using namespace LAMMPS_NS;

namespace {

int failures = 0, windows = 0;
bigint fail_at = -1;    // step in which the pair style stops with an error

void expect(bool holds, const char *what)
{
  if (holds) return;
  if (failures++ < 10) std::fprintf(stderr, "failed: %s\n", what);
}

LAMMPS *observed = nullptr;    // while a run goes on
bigint last_window = -1;       // step in which a window was seen

int count_poisoned(const Atom *atom)
{
  int count = 0;
  for (int i = atom->nlocal; i < atom->nlocal + atom->nghost; i++)
    count +=
        std::isnan(atom->x[i][0]) && std::isnan(atom->v[i][2]) && std::isnan(atom->omega[i][1]);
  return count;
}

void look_for_window()
{
  if (!observed) return;
  int dimension = 0;
  const auto *pending =
      static_cast<const int *>(observed->comm->extract("proxies_pending", dimension));
  const bigint step = observed->update->ntimestep;
  if (!pending || !*pending || observed->update->setupflag || step == last_window) return;
  if (count_poisoned(observed->atom) != observed->atom->nghost) return;    // still being packed
  expect(observed->neighbor->ago > 0, "pending only in steps without a rebuild");
  windows++;
  last_window = step;
  if (step == fail_at) observed->error->all(FLERR, "stop in the window");
}

/// Runs while windows are looked for; an error of the run goes on.
void run_observed(LAMMPS *lmp, const char *command)
{
  struct End {
    ~End() { observed = nullptr; }
  } at_the_end;
  observed = lmp;
  last_window = -1;
  lmp->input->one(command);
}

const char *const scene = R"(
units lj
atom_style sphere
newton off
comm_modify vel yes
region box block 0 8 0 7 0 6
create_box 1 box
lattice sc 1.0
create_atoms 1 random 250 77 box
set group all diameter 1.0 density 1.0
velocity all create 1.0 4711 loop geom
pair_style gran/penalty
pair_coeff * * hooke 1.0e-6 0.0 tangential dashpot 0.0 0.0
neighbor 0.3 bin
neigh_modify every 1 delay 0 check yes
timestep 0.01
fix step all nve/sphere
comm_proxy yes
comm_proxy check yes
run_style verlet/proxy overlap yes
)";

void set_up(LAMMPS *lmp)
{
  const std::string text = scene;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = text.find('\n', at);
    lmp->input->one(text.substr(at, end - at));
    at = end + 1;
  }
  fail_at = -1;
  const int before = windows;
  run_observed(lmp, "run 30");
  expect(windows - before == 30 - lmp->neighbor->ncalls, "a window in each step without a rebuild");
  expect(count_poisoned(lmp->atom) == 0, "all proxies valid");
}

void fail_in_window(LAMMPS *lmp)
{
  fail_at = lmp->update->ntimestep + 1;    // the step after set-up has no rebuild
  std::string message;
  try {
    run_observed(lmp, "run 10");
  } catch (const std::exception &problem) {
    message = problem.what();
  }
  fail_at = -1;
  expect(message.find("stop in the window") != std::string::npos, "the error was thrown");
}

void check_after(const char *commands)
{
  const char *words[] = {"window", "-log", "none", "-screen", "none"};
  auto lmp = std::make_unique<LAMMPS>(5, const_cast<char **>(words), MPI_COMM_WORLD);
  set_up(lmp.get());
  for (int again = 0; again < 3; again++) {
    fail_in_window(lmp.get());
    const std::string text = commands;
    if (text == "end") break;
    if (text == "clear") {
      lmp->input->one("clear");
      set_up(lmp.get());
      continue;
    }
    for (std::size_t at = 0; at < text.size();) {
      const std::size_t end = text.find(';', at);
      lmp->input->one(text.substr(at, end - at));
      at = end + 1;
    }
  }
}

}    // namespace

extern "C" __attribute__((visibility("default"))) double MPI_Wtime()
{
  look_for_window();
  return PMPI_Wtime();
}

int main(int argc, char **argv)
{
  MPI_Init(&argc, &argv);
  int me = 0, all = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &me);
  try {
    for (const char *commands :
         {"end", "clear", "run 20;", "run 0;run 20 pre no;",
          "comm_proxy no;comm_proxy yes;"
          "comm_proxy check yes;run 20;",
          "delete_atoms random fraction 0.1 yes all NULL 77;run 20;",
          "balance 1.0 shift xyz 5 1.01;run 20;", "write_restart there;run 5;"})
      check_after(commands);
  } catch (const std::exception &problem) {    // an error message of the host
    std::fprintf(stderr, "%s\n", problem.what());
    MPI_Abort(MPI_COMM_WORLD, 1);
  }
  MPI_Allreduce(&failures, &all, 1, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
  if (me == 0) std::printf("windows %d\n%s\n", windows, all == 0 ? "survived" : "failed");
  MPI_Finalize();
  return all != 0;
}
