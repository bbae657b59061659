// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The list of styles that the plugin adds. Called by the gate in talusplugin.cpp, once the host is
// known to be the one this file was compiled for; may be called again after `clear`.

#include "base/talus_version.h"
#include "base/vectors.h"
#if TALUS_HOST_HAS_BPM
#include "bond/bond_bpm_rotational_talus.h"
#include "bond/bond_bpm_spring_talus.h"
#endif
#include "comm/comm_proxy.h"
#include "comm/proxy_command.h"
#include "compute/compute_coarse_grid.h"
#include "compute/compute_contact_gran_atom.h"
#include "compute/compute_contact_gran_local.h"
#include "compute/compute_dissipation_gran_atom.h"
#include "compute/compute_penalty_stats.h"
#include "compute/compute_timestep_gran.h"
#include "coupling/calls.h"
#include "dump/dump_vtk_gran.h"
#include "fill/fill_region.h"
#include "fill/fix_pour_rate.h"
#include "fix/body/fix_large_body.h"
#include "fix/motion/fix_gravity_talus.h"
#include "fix/motion/fix_nve_sphere_symplectic.h"
#include "fix/motion/fix_nve_sphere_talus.h"
#include "fix/shape/fix_shape_gran.h"
#include "pair/pair_gran_penalty.h"
#if TALUS_HOST_HAS_GRANULAR
#include "pair/pair_gran_talus.h"
#include "pair/pair_granular_talus.h"
#endif
#include "run/verlet_proxy.h"
#include "system/contacts/compute_contact_list.h"
#include "system/contacts/fix_contact_store.h"
#include "system/contacts/fix_pair_history.h"
#include "system/exchange/exchange_switch.h"
#include "system/host/lammps_compat.h"
#include "system/host/system_style.h"
#include "system/loads/fix_external_loads.h"
#include "talus_abi.h"

#if TALUS_HOST_HAS_RIGID
#include "fix/clump/fix_rigid_small_symplectic.h"
#include "fix/clump/fix_rigid_small_talus.h"
#endif
#if TALUS_HOST_HAS_BPM
#include "fix/motion/fix_nve_bpm_sphere_talus.h"
#endif
#if TALUS_HOST_HAS_GRANULAR
#include "fix/wall/fix_wall_gran_region_talus.h"
#include "fix/wall/fix_wall_gran_talus.h"
#endif

#include "bond.h"
#include "comm.h"
#include "command.h"
#include "compute.h"
#include "fix.h"
#include "force.h"
#include "input.h"
#include "integrate.h"
#include "lammps.h"
#include "lammpsplugin.h"
#include "modify.h"
#include "output.h"
#include "pair.h"
#include "update.h"
#include "verlet.h"
#include "version.h"

#include <dlfcn.h>

#include <cstring>

#if TALUS_HOST_HAS_GRANULAR
#include "fix/motion/fix_freeze_talus.h"
#endif

#define TALUS_INFO "Talus " TALUS_VERSION " "

using namespace LAMMPS_NS;

namespace {

// `plugin list` shows names of styles alone: the version is one.
class Version : public Command {
 public:
  using Command::Command;
  void command(int, char **) override
  {
    if (comm->me == 0)
      utils::logmesg(lmp, "Talus {} for LAMMPS {}, {}\n", TALUS_VERSION, LAMMPS_VERSION,
                     Talus::instruction_set());
  }
};

// LAMMPS takes what a creator returns for a pointer to the base class: it has to be exactly that.
template <typename Base, typename Style> Base *create(LAMMPS *lmp)
{
  return new Style(lmp);
}

template <typename Base, typename Style> Base *create(LAMMPS *lmp, int narg, char **arg)
{
  return new Style(lmp, narg, arg);
}

// Every style is put down twice: in LAMMPS' list of plugins, which belongs to the process, and in
// the tables of this LAMMPS object. LAMMPS leaves out the second where a style is on the list
// already, and then a second object in one process would have no styles of ours.
class Registry {
 public:
  Registry(void *lmp, void *handle, void *registerfunc) :
      lmp(static_cast<LAMMPS *>(lmp)),
      register_plugin(reinterpret_cast<lammpsplugin_regfunc>(registerfunc))
  {
    entry.version = LAMMPS_VERSION;
    entry.author = "the Talus developers";
    entry.handle = handle;
  }

  template <typename Style> void pair(const char *name, const char *info)
  {
    add("pair", name, info, *lmp->force->pair_map, &create<Pair, Style>);
  }

  template <typename Style> void bond(const char *name, const char *info)
  {
    add("bond", name, info, *lmp->force->bond_map, &create<Bond, Style>);
  }

  template <typename Style> void compute(const char *name, const char *info)
  {
    add("compute", name, info, *lmp->modify->compute_map, &create<Compute, Style>);
  }

  template <typename Style> void command(const char *name, const char *info)
  {
    add("command", name, info, *lmp->input->command_map, &create<Command, Style>);
  }

  template <typename Style> void run_style(const char *name, const char *info)
  {
    add("run", name, info, *lmp->update->integrate_map, &create<Integrate, Style>);
  }

  // The host has no plugins that are dumps: its table of them is a public member.
  template <typename Style> void dump(const char *name)
  {
    (*lmp->output->dump_map)[name] = &create<Dump, Style>;
  }

  template <typename Style> void fix(const char *name, const char *info)
  {
    add("fix", name, info, *lmp->modify->fix_map, &create<Fix, Style>);
  }

 private:
  template <typename Table>
  void add(const char *style, const char *name, const char *info, Table &table,
           typename Table::mapped_type creator)
  {
    if (TALUS_HOST_HAS_RUN_PLUGINS || std::strcmp(style, "run") != 0) {
      entry.style = style;
      entry.name = name;
      entry.info = info;
      set(creator);
      register_plugin(&entry, lmp);    // copies the entry
    }
    table[name] = creator;
  }

  // the plain interface of plugins: LAMMPS casts back to these very types
  template <typename Base> void set(Base *(*creator)(LAMMPS *) )
  {
    entry.creator.v1 = reinterpret_cast<lammpsplugin_factory1 *>(creator);
  }

  template <typename Base> void set(Base *(*creator)(LAMMPS *, int, char **) )
  {
    entry.creator.v2 = reinterpret_cast<lammpsplugin_factory2 *>(creator);
  }

  LAMMPS *lmp;
  lammpsplugin_regfunc register_plugin;
  lammpsplugin_t entry{};
};

}    // namespace

extern "C" __attribute__((visibility("default"))) void
TALUS_REGISTER_STYLES(void *lmp, void *handle, void *registerfunc)
{
  // programs that share the simulation come by the file that LAMMPS has opened
  using TakeCalls = void (*)(const Talus::CallTable *);
  if (auto take = reinterpret_cast<TakeCalls>(dlsym(handle, "talus_take_calls")))
    take(&Talus::call_table());
  Registry registry(lmp, handle, registerfunc);
  registry.pair<PairGranPenalty>("gran/penalty", TALUS_INFO "pair style gran/penalty");
#if TALUS_HOST_HAS_GRANULAR
  registry.pair<PairGranHookeTalus>("gran/hooke/talus", TALUS_INFO "pair style gran/hooke/talus");
  registry.pair<PairGranHookeHistoryTalus>("gran/hooke/history/talus",
                                           TALUS_INFO "pair style gran/hooke/history/talus");
  registry.pair<PairGranHertzHistoryTalus>("gran/hertz/history/talus",
                                           TALUS_INFO "pair style gran/hertz/history/talus");
  registry.pair<PairGranularTalus>("granular/talus", TALUS_INFO "pair style granular/talus");
#endif
#if TALUS_HOST_HAS_BPM
  registry.bond<BondBPMRotationalTalus>("bpm/rotational/talus",
                                        TALUS_INFO "bond style bpm/rotational/talus");
  registry.bond<BondBPMSpringTalus>("bpm/spring/talus", TALUS_INFO "bond style bpm/spring/talus");
  registry.fix<FixNVEBPMSphereTalus>("nve/bpm/sphere/talus",
                                     TALUS_INFO "fix style nve/bpm/sphere/talus");
#endif
  registry.command<Version>("talus/" TALUS_VERSION, TALUS_INFO "says its version");
  registry.command<ProxyCommand>("comm_proxy", TALUS_INFO "command comm_proxy");
  registry.command<FillRegion>("fill_region", TALUS_INFO "command fill_region");
  registry.run_style<VerletProxy>("verlet/proxy", TALUS_INFO "run style verlet/proxy");
  registry.run_style<Verlet>("verlet/stock", "run style verlet of LAMMPS, under a name of Talus");
  registry.fix<FixNVESphereSymplectic>("nve/sphere/symplectic",
                                       TALUS_INFO "fix style nve/sphere/symplectic");
  registry.fix<FixNVESphereTalus>("nve/sphere/talus", TALUS_INFO "fix style nve/sphere/talus");
  registry.fix<FixGravityTalus>("gravity/talus", TALUS_INFO "fix style gravity/talus");
#if TALUS_HOST_HAS_GRANULAR
  registry.fix<FixFreezeTalus>("freeze/talus", TALUS_INFO "fix style freeze/talus");
#endif
  registry.fix<FixShapeGran>("shape/gran", TALUS_INFO "fix style shape/gran");
  registry.fix<FixPourRate>("pour/rate", TALUS_INFO "fix style pour/rate");
  registry.fix<FixLargeBody>("large/body", TALUS_INFO "fix style large/body");
#if TALUS_HOST_HAS_GRANULAR
  registry.fix<FixWallGranTalus>("wall/gran/talus", TALUS_INFO "fix style wall/gran/talus");
  registry.fix<FixWallGranRegionTalus>("wall/gran/region/talus",
                                       TALUS_INFO "fix style wall/gran/region/talus");
#endif
#if TALUS_HOST_HAS_RIGID
  registry.fix<FixRigidSmallSymplectic>("rigid/small/symplectic",
                                        TALUS_INFO "fix style rigid/small/symplectic");
  registry.fix<FixRigidSmallTalus>("rigid/small/talus", TALUS_INFO "fix style rigid/small/talus");
#endif
  registry.compute<ComputePenaltyStats>("penalty/stats", TALUS_INFO "compute style penalty/stats");
  registry.compute<ComputeContactGranAtom>("contact/gran/atom",
                                           TALUS_INFO "compute style contact/gran/atom");
  registry.compute<ComputeContactGranLocal>("contact/gran/local",
                                            TALUS_INFO "compute style contact/gran/local");
  registry.compute<ComputeDissipationGranAtom>("dissipation/gran/atom",
                                               TALUS_INFO "compute style dissipation/gran/atom");
  registry.compute<ComputeCoarseGrid>("coarse/grid", TALUS_INFO "compute style coarse/grid");
  registry.compute<ComputeTimestepGran>("timestep/gran", TALUS_INFO "compute style timestep/gran");
  registry.compute<ComputeContactList>("TALUS_CONTACT_LIST", TALUS_INFO "contacts (internal)");
  registry.dump<DumpVtkGran>("vtk/gran");
  registry.fix<FixContactStore>("CONTACT_STORE", TALUS_INFO "contact history (internal)");
  registry.fix<FixExternalLoads>("EXTERNAL_LOADS", TALUS_INFO "loads of other programs (internal)");
  registry.fix<FixPairHistory>("TALUS_PAIR_HISTORY", TALUS_INFO "contact history (internal)");

  Talus::ExchangeSwitch::set_maker(make_comm_proxy);
  Talus::make_run_style_the_default(static_cast<LAMMPS *>(lmp));
}
