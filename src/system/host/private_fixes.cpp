// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// See private_members.h: of fixes.

#include "system/host/lammps_compat.h"
#include "system/host/private_member.h"
#include "system/host/private_members.h"

#include "fix_addforce.h"
#include "fix_ave_atom.h"
#include "fix_ave_chunk.h"
#include "fix_ave_correlate.h"
#include "fix_ave_grid.h"
#include "fix_ave_histo.h"
#include "fix_ave_time.h"
#include "fix_aveforce.h"
#include "fix_deform.h"
#include "fix_efield.h"
#include "fix_gravity.h"
#include "fix_indent.h"
#include "fix_langevin.h"
#include "fix_move.h"
#include "fix_setforce.h"
#include "fix_spring_self.h"
#include "fix_wall.h"
#include "fix_wall_reflect.h"

#include <algorithm>
#if TALUS_HOST_HAS_GRANULAR
#include "fix_add_heat.h"
#include "fix_pour.h"
#include "random_park.h"
#endif

using namespace LAMMPS_NS;

namespace Talus {

#define TALUS_PRIVATE_NAME(tag, style, member)                                                     \
  TALUS_PRIVATE_MEMBER(tag, char *style::*, &style::member)

TALUS_PRIVATE_MEMBER(Disable, int FixGravity::*, &FixGravity::disable)
#if TALUS_HOST_HAS_GRANULAR
TALUS_PRIVATE_NAME(AddedHeat, FixAddHeat, varstr)
#endif
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
TALUS_PRIVATE_MEMBER(DeformingVariables, int FixDeform::*, &FixDeform::varflag)
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

bool is_disabled(const FixGravity &gravity)
{
  return gravity.*pointer_to(Disable{}) != 0;
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
#if TALUS_HOST_HAS_GRANULAR
  if (const auto *heat = as<FixAddHeat>(fix)) found.names = {heat->*pointer_to(AddedHeat{})};
#endif
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
  } else if (const auto *deforming = as<FixDeform>(fix)) {
    found.more = deforming->*pointer_to(DeformingVariables{}) != 0;
  } else if (const auto *wall = as<FixWall>(fix)) {
    found.more = wall->*pointer_to(WallVariables{}) != 0;
  }
  return found;
}

#if TALUS_HOST_HAS_GRANULAR
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
#else
PouringState pouring_of(Fix & /*fix*/)
{
  return {};
}

void set_pouring(Fix & /*fix*/, const PouringState & /*state*/) {}
#endif

}    // namespace Talus
