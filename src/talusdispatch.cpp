// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// talusstyles.so of a portable build (CMake: TALUS_PORTABLE): opens the styles for the fastest
// instructions that every rank can run, talusstyles-WORD.so beside it, and lets them register
// themselves. TALUS_ISA=WORD in the environment of the first rank chooses others.
//
// All code of ours, and with it every inline function and template of the C++ library that it
// uses, is compiled again for each set and shows no symbol but the one called here. So the linker
// has no occasion to give a processor code that was meant for a better one. The laws round alike
// on all sets (see contact/simd.h).
//
// Like every part of the plugin this file stays loaded once it was (see CMakeLists.txt): after
// `plugin unload` and `clear` objects of ours may still live.

#include "instruction_sets.h"
#include "talus_abi.h"

#include "error.h"
#include "lammps.h"

#include <dlfcn.h>
#include <mpi.h>

#include <cstdlib>
#include <string>

using namespace LAMMPS_NS;
using namespace Talus;

namespace {

/// The same on all ranks of a run: one that took other instructions would gain nothing, since the
/// slowest rank sets the pace.
int fastest_of_all(MPI_Comm world)
{
  const int mine = fastest_instruction_set();
  int all = 0;
  MPI_Allreduce(&mine, &all, 1, MPI_INT, MPI_MIN, world);
  return all;
}

/// TALUS_ISA as the first rank has it: launchers do not pass the environment to all machines.
std::string asked_for(MPI_Comm world)
{
  constexpr int size = 64;
  char word[size] = "";
  int rank;
  MPI_Comm_rank(world, &rank);
  const char *value = rank == 0 ? std::getenv("TALUS_ISA") : nullptr;
  if (value) std::string(value).copy(word, size - 1);
  MPI_Bcast(word, size, MPI_CHAR, 0, world);
  return word;
}

std::string path_of(const char *word)
{
  Dl_info info{};
  const bool found =
      dladdr(reinterpret_cast<const void *>(&fastest_of_all), &info) && info.dli_fname;
  const std::string self = found ? info.dli_fname : "";
  const auto slash = self.rfind('/');
  return (slash == std::string::npos ? "" : self.substr(0, slash + 1)) + "talusstyles-" + word +
         ".so";
}

using Register = void (*)(void *, void *, void *);

struct Styles {
  Register register_them = nullptr;
  std::string problem;
};

Styles open_styles(const char *word)
{
  const std::string path = path_of(word);
  void *library = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (!library) {
    const char *reason = dlerror();
    return {nullptr, "cannot open a file of the plugin (" + std::string(reason) + ")"};
  }
  const std::string name = std::string(TALUS_TEXT(TALUS_REGISTER)) + "_" + word;
  const auto function = reinterpret_cast<Register>(dlsym(library, name.c_str()));
  return {function, function ? "" : path + " is from another build"};
}

}    // namespace

extern "C" __attribute__((visibility("default"))) void TALUS_REGISTER(void *lmp, void *handle,
                                                                      void *registerfunc)
{
  const auto *host = static_cast<LAMMPS *>(lmp);
  const int fastest = fastest_of_all(host->world);
  const std::string word = asked_for(host->world);
  const std::string complaint = word.empty() ? "" : problem_of_isa(word, fastest);
  if (!complaint.empty()) host->error->all(FLERR, "Talus: {}", complaint);

  const int chosen = word.empty() ? fastest : find_instruction_set(word.c_str());
  const Styles styles = open_styles(instruction_sets[chosen]);
  const int here = styles.register_them != nullptr;
  int everywhere = 0;
  MPI_Allreduce(&here, &everywhere, 1, MPI_INT, MPI_MIN, host->world);
  if (!everywhere)
    host->error->all(FLERR,
                     "Talus: {}; keep talusplugin.so and all files talusstyles*.so of one build in "
                     "one folder, on every machine",
                     here ? "a file of the plugin cannot be opened on another rank"
                          : styles.problem);
  styles.register_them(lmp, handle, registerfunc);
}
