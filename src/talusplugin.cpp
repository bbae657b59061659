// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The ABI gate: what LAMMPS opens. It compares the host with the one this plugin was built for and
// registers nothing if they differ, because the layout of LAMMPS classes changes between versions
// and the result would be a crash or wrong numbers.
//
// Nothing here may use a symbol of LAMMPS or MPI at link time: LAMMPS binds all symbols when it
// opens a plugin, and a missing one would stop it before the gate could say why. So the styles are
// in a second file, talusstyles.so, which is opened only after the check.

#include "coupling/calls.h"
#include "instruction_sets.h"
#include "talus_abi.h"

#include "lmptype.h"

#include <dlfcn.h>
#include <mpi.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <thread>

namespace {

constexpr int error_on_one_rank = 1;    // LMP_ERROR_ONE of lammps_error()

// Everything that must agree between the host and this binary.
struct Abi {
  int version;        // yyyymmdd
  int tagint_size;    // bytes of an atom ID
  int bigint_size;
  int mpi_size;    // bytes of an MPI_Comm; 0 for a host without MPI

  bool operator==(const Abi &other) const
  {
    return version == other.version && tagint_size == other.tagint_size &&
           bigint_size == other.bigint_size && mpi_size == other.mpi_size;
  }
};

constexpr Abi OURS = {TALUS_LAMMPS_VERSION, sizeof(LAMMPS_NS::tagint), sizeof(LAMMPS_NS::bigint),
                      sizeof(MPI_Comm)};

// The C library interface of LAMMPS: plain C functions, safe to call before any layout is known.
struct HostLibrary {
  int (*version)(void *);
  int (*extract_setting)(void *, const char *);
  int (*has_mpi)();
  int (*has_package)(const char *);
  void (*error)(void *, int, const char *);

  bool complete() const { return version && extract_setting && has_mpi && has_package && error; }
};

template <typename Function> void look_up(void *library, const char *name, Function &function)
{
  function = reinterpret_cast<Function>(dlsym(library, name));
}

HostLibrary find_host_library()
{
  HostLibrary host{};
  look_up(RTLD_DEFAULT, "lammps_version", host.version);
  look_up(RTLD_DEFAULT, "lammps_extract_setting", host.extract_setting);
  look_up(RTLD_DEFAULT, "lammps_config_has_mpi_support", host.has_mpi);
  look_up(RTLD_DEFAULT, "lammps_config_has_package", host.has_package);
  look_up(RTLD_DEFAULT, "lammps_error", host.error);
  return host;
}

Abi abi_of(const HostLibrary &host, void *lmp)
{
  return {host.version(lmp), host.extract_setting(lmp, "tagint"),
          host.extract_setting(lmp, "bigint"), host.has_mpi()};
}

std::string describe(const Abi &abi)
{
  char text[128];
  std::snprintf(text, sizeof(text),
                "LAMMPS %d, tagint %d bytes, bigint %d bytes, MPI handle %d bytes", abi.version,
                abi.tagint_size, abi.bigint_size, abi.mpi_size);
  return text;
}

// One line, on one rank. Not through LAMMPS: its own printing may be what does not match.
void complain(bool first_rank, const std::string &text)
{
  if (!first_rank) return;
  std::fprintf(stderr, "talus: %s; no style registered\n", text.c_str());
  std::fflush(stderr);
}

/* One rank may lack what another one has, and could not be told from here: it ends the run. Where all lack it
   the first one does: it writes the log, it says so once, and some versions of mpiexec crash when two ranks
   end the run at the same time. */

void end_run(const HostLibrary &host, void *lmp, bool first_rank, const std::string &missing)
{
  if (!first_rank) std::this_thread::sleep_for(std::chrono::seconds(1));
  host.error(lmp, error_on_one_rank,
             ("Talus: this plugin was built for another processor than that of this machine, "
              "which lacks the instructions " +
              missing +
              "; build it here with scripts/build, or for all machines with "
              "scripts/build --portable")
                 .c_str());
}

// For developers who know better, for instance when bisecting the host.
bool check_disabled()
{
  const char *value = std::getenv("TALUS_SKIP_ABI_CHECK");
  return value && *value && std::strcmp(value, "0") != 0;
}

// The path that the host opened may be a link, which is followed: the second file is beside the
// first itself.
std::string own_path()
{
  Dl_info info{};
  if (!dladdr(reinterpret_cast<const void *>(&OURS), &info) || !info.dli_fname) return {};
  char *resolved = realpath(info.dli_fname, nullptr);
  std::string self = resolved ? resolved : info.dli_fname;
  std::free(resolved);
  return self;
}

std::string styles_path()
{
  const std::string self = own_path();
  const auto slash = self.rfind('/');
  return (slash == std::string::npos ? std::string() : self.substr(0, slash + 1)) +
         "talusstyles.so";
}

}    // namespace

extern "C" __attribute__((visibility("default"))) void lammpsplugin_init(void *lmp, void *handle,
                                                                         void *registerfunc)
{
  const HostLibrary host = find_host_library();
  if (!host.complete())
    return complain(true, "the host does not show its C library interface to plugins; build LAMMPS "
                          "as a shared library or with PKG_PLUGIN on");

  const bool first_rank = host.extract_setting(lmp, "universe_rank") == 0;
  const Abi theirs = abi_of(host, lmp);
  if (!(theirs == OURS) && !check_disabled())
    return complain(first_rank, "this plugin was built for " + describe(OURS) +
                                    ", but the host is " + describe(theirs) +
                                    "; build it for this host with scripts/build --host");

  // accelerated styles derive from those of the package: their symbols would be missing
  if (TALUS_HOST_HAS_GRANULAR && !host.has_package("GRANULAR"))
    return complain(first_rank,
                    "this plugin was built for a LAMMPS with package GRANULAR, which the "
                    "host lacks; build LAMMPS with PKG_GRANULAR on, or this plugin for "
                    "this host with scripts/build --host");

  const std::string missing = Talus::missing_instructions(Talus::needed_instructions);
  if (!missing.empty()) return end_run(host, lmp, first_rank, missing);

  const std::string path = styles_path();
  void *styles = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (!styles)
    return complain(first_rank,
                    "cannot open the second file of the plugin (" + std::string(dlerror()) +
                        "); keep talusplugin.so and talusstyles.so of one build in one folder");

  void (*register_styles)(void *, void *, void *);
  look_up(styles, TALUS_TEXT(TALUS_REGISTER), register_styles);
  if (!register_styles)
    return complain(first_rank,
                    path + " is from another build than talusplugin.so; copy both files again");
  register_styles(lmp, handle, registerfunc);
}

// ---- calls of the coupling interface: the styles have them ----------------------------------------

namespace {

const Talus::CallTable *calls = nullptr;
std::string misuse;    // of the last call, if it did not get further than here
constexpr const char *not_loaded =
    "no instance of LAMMPS in this program has loaded the plugin that belongs to this library: set "
    "LAMMPS_PLUGIN_PATH, call talus_load(), or use 'plugin load'";

/// The object that a call is about is its first argument.
template <class First, class... Others> bool is_about_null(First first, Others...)
{
  return !first;
}

int refuse_null(const char *name)
{
  misuse = std::string(name) +
           ": the first argument is NULL: what the call is about was not made, see "
           "the code of the call that should have made it";
  return TALUS_REFUSED;
}

}    // namespace

extern "C" {

/// By the styles, when they register.
__attribute__((visibility("default"))) void talus_take_calls(const Talus::CallTable *table)
{
  calls = table;
}

#define TALUS_FORWARD(name, parameters, arguments)                                                 \
  __attribute__((visibility("default"))) int talus_##name parameters                               \
  {                                                                                                \
    misuse.clear();                                                                                \
    if (!calls) return TALUS_NOT_LOADED;                                                           \
    return is_about_null arguments ? refuse_null("talus_" #name) : calls->name arguments;          \
  }
TALUS_CALLS(TALUS_FORWARD)
#undef TALUS_FORWARD

__attribute__((visibility("default"))) int talus_interface_version()
{
  return calls ? calls->version : 0;
}

__attribute__((visibility("default"))) const char *talus_error(const talus_partner *partner)
{
  if (!calls) return not_loaded;
  return misuse.empty() ? calls->error(partner) : misuse.c_str();
}

__attribute__((visibility("default"))) int64_t talus_snapshot_size(const talus_snapshot *snapshot)
{
  return calls ? calls->snapshot_size(snapshot) : 0;
}

__attribute__((visibility("default"))) int talus_load(void *lmp)
{
  char *(*command)(void *, const char *);
  look_up(RTLD_DEFAULT, "lammps_command", command);
  if (!command || !lmp) return TALUS_NOT_LOADED;
  command(lmp, ("plugin load " + own_path()).c_str());
  return calls ? TALUS_OK : TALUS_NOT_LOADED;
}

}    // extern "C"
