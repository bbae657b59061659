// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Names in an explicit instantiation are not subject to access control (C++17, [temp.spec] 6), so a
// pointer to a private member can be taken there. Each has a tag, which finds it again.

#include "system/private_members.h"

#include "system/lammps_compat.h"

#include "comm.h"
#include "comm_brick.h"
#include "fix_gravity.h"
#include "neighbor.h"
#include "region.h"
#include "variable.h"

#include <vector>
#if TALUS_HOST_HAS_GRANULAR
#include "gran_sub_mod_normal.h"
#endif

using namespace LAMMPS_NS;
#if TALUS_HOST_HAS_GRANULAR
using namespace LAMMPS_NS::Granular_NS;
#endif

namespace Talus {
template <class Tag, typename Tag::Type member> struct PrivateMember {
  friend typename Tag::Type pointer_to(Tag) { return member; }
};

// `kind`: the type of the pointer to the member
#define TALUS_PRIVATE_MEMBER(tag, kind, member)                                                    \
  struct tag {                                                                                     \
    using Type = kind;                                                                             \
    friend Type pointer_to(tag);                                                                   \
  };                                                                                               \
  template struct PrivateMember<tag, member>;

using TransformOfRegion = void (Region::*)(double &, double &, double &);
using VectorOfRegion = double (Region::*)[3];

TALUS_PRIVATE_MEMBER(BorderGroup, int Comm::*, &Comm::bordergroup)
TALUS_PRIVATE_MEMBER(ReducesMulti, int Comm::*, &Comm::multi_reduce)
TALUS_PRIVATE_MEMBER(LocalSendList, int *CommBrick::*, &CommBrick::localsendlist)
TALUS_PRIVATE_MEMBER(Bins, NBin **Neighbor::*, &Neighbor::neigh_bin)
TALUS_PRIVATE_MEMBER(Disable, int FixGravity::*, &FixGravity::disable)
TALUS_PRIVATE_MEMBER(Transform, TransformOfRegion, &Region::forward_transform)
TALUS_PRIVATE_MEMBER(Point, VectorOfRegion, &Region::point)
TALUS_PRIVATE_MEMBER(Axis, VectorOfRegion, &Region::runit)
TALUS_PRIVATE_MEMBER(MoveX, char *Region::*, &Region::xstr)
TALUS_PRIVATE_MEMBER(MoveY, char *Region::*, &Region::ystr)
TALUS_PRIVATE_MEMBER(MoveZ, char *Region::*, &Region::zstr)
TALUS_PRIVATE_MEMBER(Angle, char *Region::*, &Region::tstr)

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

bool is_disabled(const FixGravity &gravity)
{
  return gravity.*pointer_to(Disable{}) != 0;
}

void move_with_region(Region &region, double (&x)[3])
{
  (region.*pointer_to(Transform{}))(x[0], x[1], x[2]);
}

const double *point_of_rotation(const Region &region)
{
  return region.*pointer_to(Point{});
}

const double *axis_of_rotation(const Region &region)
{
  return region.*pointer_to(Axis{});
}

std::array<const char *, 4> variables_of(const Region &region)
{
  return {region.*pointer_to(MoveX{}), region.*pointer_to(MoveY{}), region.*pointer_to(MoveZ{}),
          region.*pointer_to(Angle{})};
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
