// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "system/host/private_members.h"

#include "system/host/lammps_compat.h"
#include "system/host/private_member.h"

#include "comm.h"
#include "comm_brick.h"
#include "compute.h"
#include "fix.h"
#include "force.h"
#include "modify.h"
#include "neighbor.h"
#include "pair_hybrid.h"
#include "variable.h"

#include <cstring>
#if TALUS_HOST_HAS_GRANULAR
#include "gran_sub_mod_normal.h"
#endif

using namespace LAMMPS_NS;
#if TALUS_HOST_HAS_GRANULAR
using namespace LAMMPS_NS::Granular_NS;
#endif

namespace Talus {

TALUS_PRIVATE_MEMBER(BorderGroup, int Comm::*, &Comm::bordergroup)
TALUS_PRIVATE_MEMBER(ReducesMulti, int Comm::*, &Comm::multi_reduce)
TALUS_PRIVATE_MEMBER(LocalSendList, int *CommBrick::*, &CommBrick::localsendlist)
TALUS_PRIVATE_MEMBER(InstanceOfFix, int Fix::*, &Fix::instance_me)
TALUS_PRIVATE_MEMBER(InstanceOfCompute, int Compute::*, &Compute::instance_me)
TALUS_PRIVATE_MEMBER(InstanceOfPair, int Pair::*, &Pair::instance_me)
TALUS_PRIVATE_MEMBER(DataInFile, char **Modify::*, &Modify::id_restart_peratom)
TALUS_PRIVATE_MEMBER(DataTaken, int *Modify::*, &Modify::used_restart_peratom)
TALUS_PRIVATE_MEMBER(Bins, NBin **Neighbor::*, &Neighbor::neigh_bin)
TALUS_PRIVATE_MEMBER(HybridCount, int PairHybrid::*, &PairHybrid::nstyles)
TALUS_PRIVATE_MEMBER(HybridStyles, Pair **PairHybrid::*, &PairHybrid::styles)
TALUS_PRIVATE_MEMBER(HybridCountOfTypes, int **PairHybrid::*, &PairHybrid::nmap)

bool sends_one_group(const Comm &comm)
{
  return comm.*pointer_to(BorderGroup{}) != 0;
}

bool leaves_out_small(const Comm &comm)
{
  return comm.mode == Comm::MULTI && comm.*pointer_to(ReducesMulti{}) != 0;
}

void forget_local_send_list(CommBrick &comm)
{
  comm.*pointer_to(LocalSendList{}) = nullptr;
}

NBin **bins_of(Neighbor &neighbor)
{
  return neighbor.*pointer_to(Bins{});
}

/* A pair of types that is not set will be mixed from pairs of this style. */

bool computes_all_of_hybrid(const Pair &style, const Force &force, int types)
{
  if (std::strcmp(force.pair_style, "hybrid") != 0 &&
      std::strcmp(force.pair_style, "hybrid/overlay") != 0)
    return false;
  auto *hybrid = dynamic_cast<PairHybrid *>(force.pair);
  if (!hybrid || hybrid->*pointer_to(HybridCount{}) != 1 ||
      (hybrid->*pointer_to(HybridStyles{}))[0] != &style || !style.compute_flag)
    return false;
  int **styles_of = hybrid->*pointer_to(HybridCountOfTypes{});
  for (int i = 1; hybrid->allocated && i <= types; i++)
    for (int j = i; j <= types; j++)
      if (hybrid->setflag[i][j] && styles_of[i][j] != 1) return false;    // `none`
  return true;
}

std::string untaken_restart_data(const Modify &modify, const std::string &prefix)
{
  char *const *const ids = modify.*pointer_to(DataInFile{});
  const int *const taken = modify.*pointer_to(DataTaken{});
  for (int n = 0; n < modify.nfix_restart_peratom; n++)
    if (!taken[n] && std::strncmp(ids[n], prefix.c_str(), prefix.size()) == 0) return ids[n];
  return "";
}

int number_of_instance(const Fix &fix)
{
  return fix.*pointer_to(InstanceOfFix{});
}

int number_of_instance(const Compute &compute)
{
  return compute.*pointer_to(InstanceOfCompute{});
}

int number_of_instance(const Pair &pair)
{
  return pair.*pointer_to(InstanceOfPair{});
}

#if TALUS_HOST_TELLS_FORMULAS
std::string style_of(Variable &all, int n)
{
  return all.get_style(n);
}

/* Behind the formula comes the last value, which is a number once there is one. */

std::string formula_of(Variable &all, int n)
{
  std::string info = all.get_info(n);
  if (const std::size_t none = info.find("(undefined)"); none != std::string::npos)
    info.resize(none);
  const std::size_t begin = info.find("def =");
  return begin == std::string::npos ? "?" : info.substr(begin + 5);
}
#else
TALUS_PRIVATE_MEMBER(Styles, int *Variable::*, &Variable::style)
TALUS_PRIVATE_MEMBER(Texts, char ***Variable::*, &Variable::data)

using StyleNames = const std::vector<std::string> *;
struct NamesOfStyles {
  friend StyleNames pointer_to(NamesOfStyles);
};
template <StyleNames names> struct PrivateNames {
  friend StyleNames pointer_to(NamesOfStyles) { return names; }
};
template struct PrivateNames<&Variable::varstyles>;

std::string style_of(Variable &all, int n)
{
  return (*pointer_to(NamesOfStyles{}))[(all.*pointer_to(Styles{}))[n]];
}

std::string formula_of(Variable &all, int n)
{
  return (all.*pointer_to(Texts{}))[n][0];
}
#endif

#if TALUS_HOST_HAS_GRANULAR
TALUS_PRIVATE_MEMBER(HookeStiffness, double GranSubModNormalHooke::*, &GranSubModNormalHooke::k)
TALUS_PRIVATE_MEMBER(HertzStiffness, double GranSubModNormalHertz::*, &GranSubModNormalHertz::k)
TALUS_PRIVATE_MEMBER(DmtStiffness, double GranSubModNormalDMT::*, &GranSubModNormalDMT::k)
TALUS_PRIVATE_MEMBER(JkrModulus, double GranSubModNormalJKR::*, &GranSubModNormalJKR::Emix)

double stiffness_of(const GranSubModNormalHooke &law)
{
  return law.*pointer_to(HookeStiffness{});
}
double stiffness_of(const GranSubModNormalHertz &law)
{
  return law.*pointer_to(HertzStiffness{});
}
double stiffness_of(const GranSubModNormalDMT &law)
{
  return law.*pointer_to(DmtStiffness{});
}
double modulus_of(const GranSubModNormalJKR &law)
{
  return law.*pointer_to(JkrModulus{});
}
#endif

}    // namespace Talus
