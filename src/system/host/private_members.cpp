// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Names in an explicit instantiation are not subject to access control (C++17, [temp.spec] 6), so a
// pointer to a private member can be taken there. Each has a tag, which finds it again.

#include "system/host/private_members.h"

#include "system/host/lammps_compat.h"

#include "comm.h"
#include "comm_brick.h"
#include "compute.h"
#include "fix_addforce.h"
#include "fix_ave_atom.h"
#include "fix_ave_chunk.h"
#include "fix_ave_correlate.h"
#include "fix_ave_grid.h"
#include "fix_ave_histo.h"
#include "fix_ave_time.h"
#include "fix_aveforce.h"
#include "fix_efield.h"
#include "fix_gravity.h"
#include "fix_indent.h"
#include "fix_langevin.h"
#include "fix_move.h"
#include "fix_setforce.h"
#include "fix_spring_self.h"
#include "fix_wall.h"
#include "fix_wall_reflect.h"
#include "force.h"
#include "modify.h"
#include "neighbor.h"
#include "pair_hybrid.h"
#include "region.h"
#include "region_block.h"
#include "region_cone.h"
#include "region_cylinder.h"
#include "region_plane.h"
#include "region_prism.h"
#include "region_sphere.h"
#include "variable.h"

#include <algorithm>
#include <cstring>
#include <vector>
#if TALUS_HOST_HAS_GRANULAR
#include "fix_pour.h"
#include "gran_sub_mod_normal.h"
#include "random_park.h"
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

template <class Style> using VectorOf = double (Style::*)[3];
template <class Style> using NumberOf = double Style::*;

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
TALUS_PRIVATE_MEMBER(Disable, int FixGravity::*, &FixGravity::disable)
TALUS_PRIVATE_MEMBER(Point, VectorOf<Region>, &Region::point)
TALUS_PRIVATE_MEMBER(Axis, VectorOf<Region>, &Region::runit)
TALUS_PRIVATE_MEMBER(MoveX, char *Region::*, &Region::xstr)
TALUS_PRIVATE_MEMBER(MoveY, char *Region::*, &Region::ystr)
TALUS_PRIVATE_MEMBER(MoveZ, char *Region::*, &Region::zstr)
TALUS_PRIVATE_MEMBER(Angle, char *Region::*, &Region::tstr)

#define TALUS_PRIVATE_NAME(tag, style, member)                                                     \
  TALUS_PRIVATE_MEMBER(tag, char *style::*, &style::member)

TALUS_PRIVATE_NAME(AddedX, FixAddForce, xstr)
TALUS_PRIVATE_NAME(AddedY, FixAddForce, ystr)
TALUS_PRIVATE_NAME(AddedZ, FixAddForce, zstr)
TALUS_PRIVATE_NAME(AddedEnergy, FixAddForce, estr)
TALUS_PRIVATE_NAME(AddedRegion, FixAddForce, idregion)
TALUS_PRIVATE_NAME(SetRegion, FixSetForce, idregion)
TALUS_PRIVATE_NAME(MeanRegion, FixAveForce, idregion)
TALUS_PRIVATE_NAME(FieldRegion, FixEfield, idregion)
TALUS_PRIVATE_NAME(SetX, FixSetForce, xstr)
TALUS_PRIVATE_NAME(SetY, FixSetForce, ystr)
TALUS_PRIVATE_NAME(SetZ, FixSetForce, zstr)
TALUS_PRIVATE_NAME(MeanX, FixAveForce, xstr)
TALUS_PRIVATE_NAME(MeanY, FixAveForce, ystr)
TALUS_PRIVATE_NAME(MeanZ, FixAveForce, zstr)
TALUS_PRIVATE_NAME(MovedX, FixMove, xvarstr)
TALUS_PRIVATE_NAME(MovedY, FixMove, yvarstr)
TALUS_PRIVATE_NAME(MovedZ, FixMove, zvarstr)
TALUS_PRIVATE_NAME(MovedVx, FixMove, vxvarstr)
TALUS_PRIVATE_NAME(MovedVy, FixMove, vyvarstr)
TALUS_PRIVATE_NAME(MovedVz, FixMove, vzvarstr)
TALUS_PRIVATE_NAME(SpringConstant, FixSpringSelf, kstr)
TALUS_PRIVATE_NAME(LangevinTarget, FixLangevin, tstr)
TALUS_PRIVATE_NAME(FieldX, FixEfield, xstr)
TALUS_PRIVATE_NAME(FieldY, FixEfield, ystr)
TALUS_PRIVATE_NAME(FieldZ, FixEfield, zstr)
TALUS_PRIVATE_NAME(FieldEnergy, FixEfield, estr)
TALUS_PRIVATE_NAME(FieldPotential, FixEfield, pstr)
TALUS_PRIVATE_NAME(IndenterX, FixIndent, xstr)
TALUS_PRIVATE_NAME(IndenterY, FixIndent, ystr)
TALUS_PRIVATE_NAME(IndenterZ, FixIndent, zstr)
TALUS_PRIVATE_NAME(IndenterRadius, FixIndent, rstr)
TALUS_PRIVATE_NAME(IndenterPlane, FixIndent, pstr)
TALUS_PRIVATE_NAME(IndenterRadiusLo, FixIndent, rlostr)
TALUS_PRIVATE_NAME(IndenterRadiusHi, FixIndent, rhistr)
TALUS_PRIVATE_NAME(IndenterLo, FixIndent, lostr)
TALUS_PRIVATE_NAME(IndenterHi, FixIndent, histr)
TALUS_PRIVATE_NAME(GravityM, FixGravity, mstr)
TALUS_PRIVATE_NAME(GravityV, FixGravity, vstr)
TALUS_PRIVATE_NAME(GravityP, FixGravity, pstr)
TALUS_PRIVATE_NAME(GravityT, FixGravity, tstr)
TALUS_PRIVATE_NAME(GravityX, FixGravity, xstr)
TALUS_PRIVATE_NAME(GravityY, FixGravity, ystr)
TALUS_PRIVATE_NAME(GravityZ, FixGravity, zstr)
TALUS_PRIVATE_MEMBER(WallVariables, int FixWall::*, &FixWall::varflag)
TALUS_PRIVATE_MEMBER(NextTime, bigint FixAveTime::*, &FixAveTime::nvalid)
TALUS_PRIVATE_MEMBER(NextAtom, bigint FixAveAtom::*, &FixAveAtom::nvalid)
TALUS_PRIVATE_MEMBER(NextChunk, bigint FixAveChunk::*, &FixAveChunk::nvalid)
TALUS_PRIVATE_MEMBER(NextHisto, bigint FixAveHisto::*, &FixAveHisto::nvalid)
TALUS_PRIVATE_MEMBER(NextCorrelate, bigint FixAveCorrelate::*, &FixAveCorrelate::nvalid)
TALUS_PRIVATE_MEMBER(LastTime, bigint FixAveTime::*, &FixAveTime::nvalid_last)
TALUS_PRIVATE_MEMBER(LastAtom, bigint FixAveAtom::*, &FixAveAtom::nvalid_last)
TALUS_PRIVATE_MEMBER(LastChunk, bigint FixAveChunk::*, &FixAveChunk::nvalid_last)
TALUS_PRIVATE_MEMBER(LastGrid, bigint FixAveGrid::*, &FixAveGrid::nvalid_last)
TALUS_PRIVATE_MEMBER(LastHisto, bigint FixAveHisto::*, &FixAveHisto::nvalid_last)
TALUS_PRIVATE_MEMBER(LastCorrelate, bigint FixAveCorrelate::*, &FixAveCorrelate::nvalid_last)
TALUS_PRIVATE_MEMBER(LangevinBias, int FixLangevin::*, &FixLangevin::tbiasflag)
TALUS_PRIVATE_MEMBER(ReflectingVariables, int FixWallReflect::*, &FixWallReflect::varflag)

#define TALUS_PRIVATE_NUMBER(tag, style, member)                                                   \
  TALUS_PRIVATE_MEMBER(tag, NumberOf<style>, &style::member)

TALUS_PRIVATE_NUMBER(BlockXlo, RegBlock, xlo)
TALUS_PRIVATE_NUMBER(BlockXhi, RegBlock, xhi)
TALUS_PRIVATE_NUMBER(BlockYlo, RegBlock, ylo)
TALUS_PRIVATE_NUMBER(BlockYhi, RegBlock, yhi)
TALUS_PRIVATE_NUMBER(BlockZlo, RegBlock, zlo)
TALUS_PRIVATE_NUMBER(BlockZhi, RegBlock, zhi)
TALUS_PRIVATE_MEMBER(PrismLo, VectorOf<RegPrism>, &RegPrism::clo)
TALUS_PRIVATE_MEMBER(PrismHi, VectorOf<RegPrism>, &RegPrism::chi)
TALUS_PRIVATE_MEMBER(PrismFaces, double (RegPrism::*)[6][3], &RegPrism::face)
TALUS_PRIVATE_MEMBER(CylinderAxis, char RegCylinder::*, &RegCylinder::axis)
TALUS_PRIVATE_NUMBER(CylinderFirst, RegCylinder, c1)
TALUS_PRIVATE_NUMBER(CylinderSecond, RegCylinder, c2)
TALUS_PRIVATE_NUMBER(CylinderRadius, RegCylinder, radius)
TALUS_PRIVATE_NUMBER(CylinderLo, RegCylinder, lo)
TALUS_PRIVATE_NUMBER(CylinderHi, RegCylinder, hi)
TALUS_PRIVATE_MEMBER(ConeAxis, char RegCone::*, &RegCone::axis)
TALUS_PRIVATE_NUMBER(ConeFirst, RegCone, c1)
TALUS_PRIVATE_NUMBER(ConeSecond, RegCone, c2)
TALUS_PRIVATE_NUMBER(ConeRadiusLo, RegCone, radiuslo)
TALUS_PRIVATE_NUMBER(ConeRadiusHi, RegCone, radiushi)
TALUS_PRIVATE_NUMBER(ConeLo, RegCone, lo)
TALUS_PRIVATE_NUMBER(ConeHi, RegCone, hi)
TALUS_PRIVATE_NUMBER(SphereX, RegSphere, xc)
TALUS_PRIVATE_NUMBER(SphereY, RegSphere, yc)
TALUS_PRIVATE_NUMBER(SphereZ, RegSphere, zc)
TALUS_PRIVATE_NUMBER(SphereRadius, RegSphere, radius)
TALUS_PRIVATE_NUMBER(PlaneX, RegPlane, xp)
TALUS_PRIVATE_NUMBER(PlaneY, RegPlane, yp)
TALUS_PRIVATE_NUMBER(PlaneZ, RegPlane, zp)
TALUS_PRIVATE_MEMBER(PlaneNormal, VectorOf<RegPlane>, &RegPlane::normal)

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

bool is_disabled(const FixGravity &gravity)
{
  return gravity.*pointer_to(Disable{}) != 0;
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

/* The fix as the class of its style, or nullptr. */

template <class Style> static const Style *as(const Fix &fix)
{
  return dynamic_cast<const Style *>(&fix);
}

bigint next_reading_of(const Fix &fix)
{
  if (const auto *time = as<FixAveTime>(fix)) return time->*pointer_to(NextTime{});
  if (const auto *atom = as<FixAveAtom>(fix)) return atom->*pointer_to(NextAtom{});
  if (const auto *chunk = as<FixAveChunk>(fix)) return chunk->*pointer_to(NextChunk{});
  if (const auto *histo = as<FixAveHisto>(fix)) return histo->*pointer_to(NextHisto{});
  if (const auto *lags = as<FixAveCorrelate>(fix)) return lags->*pointer_to(NextCorrelate{});
  return -1;
}

namespace {

template <class Style, class Tag> void set_back(Fix &fix, Tag tag, bigint step)
{
  if (!as<Style>(fix)) return;
  bigint &last = dynamic_cast<Style &>(fix).*pointer_to(tag);
  last = std::min(last, step);
}

}    // namespace

void let_average_again(Fix &fix, bigint step)
{
  set_back<FixAveTime>(fix, LastTime{}, step);
  set_back<FixAveAtom>(fix, LastAtom{}, step);
  set_back<FixAveChunk>(fix, LastChunk{}, step);
  set_back<FixAveGrid>(fix, LastGrid{}, step);
  set_back<FixAveHisto>(fix, LastHisto{}, step);
  set_back<FixAveCorrelate>(fix, LastCorrelate{}, step);
}

FixVariables variables_of(const Fix &fix)
{
  FixVariables found;
  if (const auto *added = as<FixAddForce>(fix)) {
    found.names = {added->*pointer_to(AddedX{}), added->*pointer_to(AddedY{}),
                   added->*pointer_to(AddedZ{}), added->*pointer_to(AddedEnergy{})};
    found.region = added->*pointer_to(AddedRegion{});
  } else if (const auto *set = as<FixSetForce>(fix)) {
    found.names = {set->*pointer_to(SetX{}), set->*pointer_to(SetY{}), set->*pointer_to(SetZ{})};
    found.region = set->*pointer_to(SetRegion{});
  } else if (const auto *mean = as<FixAveForce>(fix)) {
    found.names = {mean->*pointer_to(MeanX{}), mean->*pointer_to(MeanY{}),
                   mean->*pointer_to(MeanZ{})};
    found.region = mean->*pointer_to(MeanRegion{});
  } else if (const auto *move = as<FixMove>(fix)) {
    found.names = {move->*pointer_to(MovedX{}),  move->*pointer_to(MovedY{}),
                   move->*pointer_to(MovedZ{}),  move->*pointer_to(MovedVx{}),
                   move->*pointer_to(MovedVy{}), move->*pointer_to(MovedVz{})};
  } else if (const auto *spring = as<FixSpringSelf>(fix)) {
    found.names = {spring->*pointer_to(SpringConstant{})};
  } else if (const auto *langevin = as<FixLangevin>(fix)) {
    found.names = {langevin->*pointer_to(LangevinTarget{})};
    found.more = langevin->*pointer_to(LangevinBias{}) != 0;
  } else if (const auto *field = as<FixEfield>(fix)) {
    found.names = {field->*pointer_to(FieldX{}), field->*pointer_to(FieldY{}),
                   field->*pointer_to(FieldZ{}), field->*pointer_to(FieldEnergy{}),
                   field->*pointer_to(FieldPotential{})};
    found.region = field->*pointer_to(FieldRegion{});
  } else if (const auto *indenter = as<FixIndent>(fix)) {
    found.names = {
        indenter->*pointer_to(IndenterX{}),        indenter->*pointer_to(IndenterY{}),
        indenter->*pointer_to(IndenterZ{}),        indenter->*pointer_to(IndenterRadius{}),
        indenter->*pointer_to(IndenterPlane{}),    indenter->*pointer_to(IndenterRadiusLo{}),
        indenter->*pointer_to(IndenterRadiusHi{}), indenter->*pointer_to(IndenterLo{}),
        indenter->*pointer_to(IndenterHi{})};
  } else if (const auto *gravity = as<FixGravity>(fix)) {
    found.names = {gravity->*pointer_to(GravityM{}), gravity->*pointer_to(GravityV{}),
                   gravity->*pointer_to(GravityP{}), gravity->*pointer_to(GravityT{}),
                   gravity->*pointer_to(GravityX{}), gravity->*pointer_to(GravityY{}),
                   gravity->*pointer_to(GravityZ{})};
  } else if (const auto *reflect = as<FixWallReflect>(fix)) {
    found.more = reflect->*pointer_to(ReflectingVariables{}) != 0;
  } else if (const auto *wall = as<FixWall>(fix)) {
    found.more = wall->*pointer_to(WallVariables{}) != 0;
  }
  return found;
}

CornersOfRegion corners_of(const RegBlock &r)
{
  return {{{r.*pointer_to(BlockXlo{}), r.*pointer_to(BlockYlo{}), r.*pointer_to(BlockZlo{})},
           {r.*pointer_to(BlockXhi{}), r.*pointer_to(BlockYhi{}), r.*pointer_to(BlockZhi{})}},
          {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}};
}

CornersOfRegion corners_of(const RegPrism &r)
{
  CornersOfRegion corners;
  std::copy_n(r.*pointer_to(PrismLo{}), 3, corners.corner[0]);
  std::copy_n(r.*pointer_to(PrismHi{}), 3, corners.corner[1]);
  for (int face = 0; face < 6; face++)
    std::copy_n((r.*pointer_to(PrismFaces{}))[face], 3, corners.normal[face]);
  return corners;
}

RoundRegion shape_of(const RegCylinder &r)
{
  const double radius = r.*pointer_to(CylinderRadius{});
  return {r.*pointer_to(CylinderAxis{}) - 'x',
          {r.*pointer_to(CylinderFirst{}), r.*pointer_to(CylinderSecond{})},
          {radius, radius},
          {r.*pointer_to(CylinderLo{}), r.*pointer_to(CylinderHi{})}};
}

RoundRegion shape_of(const RegCone &r)
{
  return {r.*pointer_to(ConeAxis{}) - 'x',
          {r.*pointer_to(ConeFirst{}), r.*pointer_to(ConeSecond{})},
          {r.*pointer_to(ConeRadiusLo{}), r.*pointer_to(ConeRadiusHi{})},
          {r.*pointer_to(ConeLo{}), r.*pointer_to(ConeHi{})}};
}

std::array<double, 4> shape_of(const RegSphere &r)
{
  return {r.*pointer_to(SphereX{}), r.*pointer_to(SphereY{}), r.*pointer_to(SphereZ{}),
          r.*pointer_to(SphereRadius{})};
}

std::array<std::array<double, 3>, 2> shape_of(const RegPlane &r)
{
  const double *n = r.*pointer_to(PlaneNormal{});
  return {{{r.*pointer_to(PlaneX{}), r.*pointer_to(PlaneY{}), r.*pointer_to(PlaneZ{})},
           {n[0], n[1], n[2]}}};
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
TALUS_PRIVATE_MEMBER(FirstPouring, bigint FixPour::*, &FixPour::nfirst)
TALUS_PRIVATE_MEMBER(NumPoured, int FixPour::*, &FixPour::ninserted)
TALUS_PRIVATE_MEMBER(RandomOfPouring, RanPark *FixPour::*, &FixPour::random)

PouringState pouring_of(Fix &fix)
{
  PouringState state;
  if (!as<FixPour>(fix)) return state;
  auto &pour = dynamic_cast<FixPour &>(fix);
  state.first = pour.*pointer_to(FirstPouring{});
  state.inserted = pour.*pointer_to(NumPoured{});
  state.random = (pour.*pointer_to(RandomOfPouring{}))->state();
  return state;
}

void set_pouring(Fix &fix, const PouringState &state)
{
  if (!as<FixPour>(fix)) return;
  auto &pour = dynamic_cast<FixPour &>(fix);
  pour.*pointer_to(FirstPouring{}) = state.first;
  pour.*pointer_to(NumPoured{}) = state.inserted;
  (pour.*pointer_to(RandomOfPouring{}))->reset(state.random);
}

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
#else
PouringState pouring_of(Fix & /*fix*/)
{
  return {};
}

void set_pouring(Fix & /*fix*/, const PouringState & /*state*/) {}
#endif

}    // namespace Talus
