// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Private members of LAMMPS classes without public access: read here, and nowhere else in Talus. A
// newer LAMMPS that renames one, or gives access to it, changes one source file. What is needed, and
// why; of all hosts since 4 Feb 2025 unless a line says more:
//
//   class               members                          why
//   Comm                bordergroup, multi_reduce        settings of comm_modify that leave out ghosts
//   CommBrick           localsendlist                    not set by `comm_style brick` after others, and freed
//   Compute, Fix, Pair  instance_me                      a command that was given anew under its name
//   Modify              (id, used)_restart_peratom       data of a restart file that no command has taken
//   Neighbor            neigh_bin                        bins that no list is made from are left out
//   PairHybrid          nstyles, styles, nmap            hybrid with one part that computes all pairs
//   Variable            style, data, varstyles           formulas; before get_style() and get_info() came in
//                                                        summer 2025 (TALUS_HOST_TELLS_FORMULAS)
//   GranSubModNormal*   k, Emix                          stiffness of pair granular after mixing
//   FixAve*             nvalid, nvalid_last              the next step that is read; a run that goes back
//   FixPour             nfirst, ninserted, random        not in restart files
//   FixGravity          disable, names of variables      the field alone
//   FixAddForce ...     names of variables, idregion     what depends on time alone can be called in the records
//   FixWall, FixWallReflect, FixLangevin, FixDeform      flags: the same
//   Region              point, runit, names of variables where it rotates, and what moves it
//   RegBlock ...        parameters of the six styles     which particles may touch it (of RegPlane public
//                                                        since 2026)
//
// private_members.cpp     communication, neighbors, pairs, variables
// private_fixes.cpp       fixes
// private_regions.cpp     regions

#ifndef TALUS_SYSTEM_HOST_PRIVATE_MEMBERS_H
#define TALUS_SYSTEM_HOST_PRIVATE_MEMBERS_H

#include "lmptype.h"

#include <array>
#include <string>
#include <vector>

namespace LAMMPS_NS {
class Comm;
class CommBrick;
class Compute;
class Fix;
class FixGravity;
class Force;
class Modify;
class NBin;
class Neighbor;
class Pair;
class RegBlock;
class RegCone;
class RegCylinder;
class RegPlane;
class RegPrism;
class RegSphere;
class Region;
class Variable;
namespace Granular_NS {
class GranSubModNormalDMT;
class GranSubModNormalHertz;
class GranSubModNormalHooke;
class GranSubModNormalJKR;
}    // namespace Granular_NS
}    // namespace LAMMPS_NS

namespace Talus {

/// Whether `comm_modify group` is set, which leaves out proxies of other particles.
bool sends_one_group(const LAMMPS_NS::Comm &comm);

/// Whether `comm_modify reduce/multi` is set, which leaves out proxies of smaller particles.
bool leaves_out_small(const LAMMPS_NS::Comm &comm);

/// A brick that was made from another object (comm_style brick) does not set this pointer, and frees it
/// in the end: to be called before it is deleted, unless fix bond/react has asked for the list.
void forget_local_send_list(LAMMPS_NS::CommBrick &comm);

/// The how manyth of all that have been made in this process.
int number_of_instance(const LAMMPS_NS::Fix &fix);
int number_of_instance(const LAMMPS_NS::Compute &compute);
int number_of_instance(const LAMMPS_NS::Pair &pair);

/// The ID that data of particles have in the restart file which was read, of those that begin with
/// `prefix` and that no fix has taken yet: the first; "" if there are none.
std::string untaken_restart_data(const LAMMPS_NS::Modify &modify, const std::string &prefix);

/// Of a fix that averages: the next step in which it reads something; -1 of other fixes.
LAMMPS_NS::bigint next_reading_of(const LAMMPS_NS::Fix &fix);

/// The step has been set back to this one: a fix that averages goes on when the step in which it reads next
/// is reached again, and has read those before already.
void let_average_again(LAMMPS_NS::Fix &fix, LAMMPS_NS::bigint step);

/// What fix pour knows of the past and does not write into restart files; zero of other fixes.
struct PouringState {
  LAMMPS_NS::bigint first = 0;
  int inserted = 0, random = 0;
};
PouringState pouring_of(LAMMPS_NS::Fix &fix);
void set_pouring(LAMMPS_NS::Fix &fix, const PouringState &state);

/// The bins by request; at least one if a list is made from bins.
LAMMPS_NS::NBin **bins_of(LAMMPS_NS::Neighbor &neighbor);

/// The pair style is hybrid or hybrid/overlay with only this part, which computes the pairs of all
/// types; from init_style() on.
bool computes_all_of_hybrid(const LAMMPS_NS::Pair &style, const LAMMPS_NS::Force &force, int types);

/// `disable` of fix gravity: it computes the field and applies nothing.
bool is_disabled(const LAMMPS_NS::FixGravity &gravity);

/// A region that rotates: a point of the axis, and its unit vector.
const double *point_of_rotation(const LAMMPS_NS::Region &region);
const double *axis_of_rotation(const LAMMPS_NS::Region &region);

/// What a fix of LAMMPS that can be called in a step in the records (see FixCalls) evaluates in every
/// step: names of variables, nullptr where there is none; `more`: something else, such as a compute.
struct FixVariables {
  std::vector<const char *> names;
  const char *region = nullptr;    ///< ID of the region that it acts in
  bool more = false;
};
FixVariables variables_of(const LAMMPS_NS::Fix &fix);

/// Names of the variables that move and rotate a region; nullptr where there is none.
std::array<const char *, 4> variables_of(const LAMMPS_NS::Region &region);

/// A block or prism at rest: two opposite corners, and unit normals that point inwards, of which
/// those with an even index belong to faces with the first corner.
struct CornersOfRegion {
  double corner[2][3], normal[6][3];
};
CornersOfRegion corners_of(const LAMMPS_NS::RegBlock &region);
CornersOfRegion corners_of(const LAMMPS_NS::RegPrism &region);

/// A cylinder or cone at rest: index of its axis, where this goes through the plane of the next two
/// axes in ascending order, and radii and places of its ends.
struct RoundRegion {
  int axis;
  double center[2], radius[2], end[2];
};
RoundRegion shape_of(const LAMMPS_NS::RegCylinder &region);
RoundRegion shape_of(const LAMMPS_NS::RegCone &region);

/// A sphere at rest: center and radius. A plane at rest: a point and the unit normal, which points
/// inwards.
std::array<double, 4> shape_of(const LAMMPS_NS::RegSphere &region);
std::array<std::array<double, 3>, 2> shape_of(const LAMMPS_NS::RegPlane &region);

/// Of a variable by its index: "equal", "index" and so on; the formula of one of style equal.
std::string style_of(LAMMPS_NS::Variable &all, int n);
std::string formula_of(LAMMPS_NS::Variable &all, int n);

/// Hosts with package GRANULAR. After mixing, which no public member tells: stiffness of hooke
/// (force/length) and of hertz (force/area), 4/3 of the effective modulus for hertz/material and
/// dmt, the effective modulus of jkr.
double stiffness_of(const LAMMPS_NS::Granular_NS::GranSubModNormalHooke &law);
double stiffness_of(const LAMMPS_NS::Granular_NS::GranSubModNormalHertz &law);
double stiffness_of(const LAMMPS_NS::Granular_NS::GranSubModNormalDMT &law);
double modulus_of(const LAMMPS_NS::Granular_NS::GranSubModNormalJKR &law);

}    // namespace Talus

#endif
