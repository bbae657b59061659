// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// An error thrown between begin and finish of an exchange, through the library interface, and what
// can follow it: another run, the stock exchange, `clear`, the end. Also looks into the window
// itself, from a pair style that stands where gran/penalty does: the exchange is pending, and with
// `comm_proxy check yes` proxies hold NaN until it is finished.
//
// Prints "windows N" (steps whose window was seen on rank 0) and "survived" when all went well.

#include "comm/pending_exchange.h"
#include "comm/proxy_reader.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "force.h"
#include "input.h"
#include "lammps.h"
#include "memory.h"
#include "neighbor.h"
#include "pair.h"
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

class WindowPair : public Pair, public Talus::ProxyReader {
 public:
  explicit WindowPair(LAMMPS *lmp) : Pair(lmp) {}
  ~WindowPair() override
  {
    memory->destroy(setflag);
    memory->destroy(cutsq);
  }

  void settings(int, char **) override {}
  void coeff(int, char **) override
  {
    const int n = atom->ntypes + 1;
    if (!allocated) {
      allocated = 1;
      memory->create(setflag, n, n, "pair:setflag");
      memory->create(cutsq, n, n, "pair:cutsq");
    }
    for (int i = 1; i < n; i++)
      for (int j = i; j < n; j++) setflag[i][j] = 1;
  }
  double init_one(int, int) override { return 1.0; }
  double share_without_proxies() const override { return 0.0; }

  void compute(int eflag, int vflag) override
  {
    ev_init(eflag, vflag);
    auto *exchange = dynamic_cast<Talus::PendingExchange *>(comm);
    if (!exchange) return;
    const bool in_window = !update->setupflag && neighbor->ago > 0;
    expect(exchange->pending() == in_window, "pending exactly in steps without a rebuild");
    if (!in_window) return;
    windows++;
    expect(count_poisoned() == atom->nghost, "all proxies poisoned");
    if (update->ntimestep == fail_at) error->all(FLERR, "stop in the window");
    exchange->progress();
    exchange->finish();
    expect(!exchange->pending() && count_poisoned() == 0, "all proxies valid");
  }

 private:
  int count_poisoned() const
  {
    int count = 0;
    for (int i = atom->nlocal; i < atom->nlocal + atom->nghost; i++)
      count +=
          std::isnan(atom->x[i][0]) && std::isnan(atom->v[i][2]) && std::isnan(atom->omega[i][1]);
    return count;
  }
};

Pair *create_window_pair(LAMMPS *lmp)
{
  return new WindowPair(lmp);
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
pair_style window
pair_coeff * *
neighbor 0.3 bin
neigh_modify every 1 delay 0 check yes
timestep 0.01
fix step all nve/sphere
comm_proxy yes
comm_proxy check yes
run_style verlet/proxy
)";

void set_up(LAMMPS *lmp)
{
  (*lmp->force->pair_map)["window"] = &create_window_pair;
  const std::string text = scene;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = text.find('\n', at);
    lmp->input->one(text.substr(at, end - at));
    at = end + 1;
  }
  fail_at = -1;
  lmp->input->one("run 30");
}

void fail_in_window(LAMMPS *lmp)
{
  fail_at = lmp->update->ntimestep + 1;    // the step after set-up has no rebuild
  std::string message;
  try {
    lmp->input->one("run 10");
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
