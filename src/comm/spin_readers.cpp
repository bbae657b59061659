// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "comm/spin_readers.h"

#include "compute.h"
#include "fix.h"
#include "force.h"
#include "lammps.h"
#include "modify.h"
#include "pair.h"
#include "system/granular_system.h"
#include "utils.h"

using namespace LAMMPS_NS;

namespace {

// Known, from their sources, to read the spins of owned particles at most. Everything else, such
// as a style of another plugin, might read those of proxies.
const char *const harmless_fixes[] = {
    "^ave/",       "^balance",   "^CONTACT_STORE",  "^deform",    "^dt/reset",     "^enforce2d",
    "^evaporate",  "^freeze",    "^gravity",        "^GROUP",     "^halt",         "^indent",
    "^large/body", "^lineforce", "^momentum",       "^move",      "^nve/sphere",   "^planeforce",
    "^pour",       "^print",     "^addforce",       "^setforce",  "^store/state",  "^STORE",
    "^vector",     "^viscous",   "^viscous/sphere", "^wall/gran", "^wall/reflect", "^DUMMY"};

const char *const harmless_computes[] = {
    "^angmom$",        "^chunk/atom$",    "^com$",    "^contact/atom$",  "^coord/atom$",
    "^displace/atom$", "^erotate/sphere", "^fabric$", "^group/group$",   "^ke",
    "^msd$",           "^pair$",          "^pe",      "^penalty/stats$", "^pressure$",
    "^property/",      "^reduce",         "^rdf$",    "^stress/atom$",   "^temp$",
    "^temp/sphere$",   "^timestep/gran$", "^vcm$",    "^global/atom$",   "^slice$"};

template <typename List> bool listed(const char *style, const List &list)
{
  for (const char *pattern : list)
    if (utils::strmatch(style, pattern)) return true;
  return false;
}

}    // namespace

std::string Talus::reader_of_proxy_spins(LAMMPS *lmp)
{
  const Pair *pair = lmp->force->pair;
  if (pair && !GranularSystem::of(lmp)->pair_style_is_alone())
    return std::string("pair style ") + lmp->force->pair_style;
  if (lmp->force->bond || lmp->force->kspace) return "a style of bonds or long-range forces";
  for (const auto &fix : lmp->modify->get_fix_list())
    if (!listed(fix->style, harmless_fixes))
      return std::string("fix ") + fix->id + " (" + fix->style + ")";
  for (const auto &compute : lmp->modify->get_compute_list())
    if (!listed(compute->style, harmless_computes))
      return std::string("compute ") + compute->id + " (" + compute->style + ")";
  return "";
}
