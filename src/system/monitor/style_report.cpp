// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "system/monitor/style_report.h"

#include "base/talus_version.h"
#include "system/host/fix_list.h"
#include "system/host/system_fix.h"
#include "system/host/system_style.h"
#include "system/step/granular_system.h"

#include "comm.h"
#include "fix.h"
#include "force.h"
#include "integrate.h"
#include "modify.h"
#include "pair.h"
#include "update.h"

#include <algorithm>
#include <cctype>

using namespace LAMMPS_NS;

namespace Talus {

namespace {

std::string line(const std::string &style, const std::string &state)
{
  return fmt::format("  {:<32}  {}\n", style, state);
}

std::string how(const std::string &reason_for_stock)
{
  return reason_for_stock.empty() ? "accelerated" : "stock: " + reason_for_stock;
}

/* Of a style of LAMMPS, from its table of styles of that kind. */

template <typename Styles> std::string why_stock(const Styles &styles, const std::string &name)
{
  if (name == "granular/superellipsoid")
    return "its overlaps and normals are defined in another way than those of fix shape/gran, "
           "which has such shapes";
  if (styles.find(name + "/talus") == styles.end()) return "no accelerated variant";
  return "start with -sf talus, or write " + name + "/talus";
}

/* None without bonds. */

std::string line_of_bonds(const Force &force)
{
  if (!force.bond) return "";
  const auto *talus_bond = SystemStyle::of(force.bond);
  const std::string name = talus_bond ? talus_bond->plain_style() : force.bond_style;
  return line("bond " + name,
              how(talus_bond ? talus_bond->reason_for_stock() : why_stock(*force.bond_map, name)));
}

/* Fixes that styles of LAMMPS make for themselves. */

bool is_internal(const Fix *fix)
{
  const std::string name = fix->style;
  return std::none_of(name.begin(), name.end(), [](unsigned char c) { return std::islower(c); });
}

}    // namespace

void StyleReport::print(const GranularSystem &system, const std::string &reason_for_arrays)
{
  if (!concerns(system)) return;
  const std::string now = text(system, reason_for_arrays);
  if (comm->me == 0 && now != last) utils::logmesg(lmp, now);
  last = now;
}

bool StyleReport::concerns(const GranularSystem &system) const
{
  if (system.pair_style().is_there()) return true;
  if (force->pair && utils::strmatch(force->pair_style, "^gran")) return true;
  if (force->pair && force->pair_match("^gran", 0)) return true;    // in hybrid
  const std::vector<Fix *> fixes = fix_list(*modify);
  return std::any_of(fixes.begin(), fixes.end(),
                     [](Fix *fix) { return SystemFix::of(fix) != nullptr; });
}

std::string StyleReport::text(const GranularSystem &system,
                              const std::string &reason_for_arrays) const
{
  const auto *talus_pair = SystemStyle::of(force->pair);
  const std::string pair = talus_pair    ? talus_pair->plain_style()
                           : force->pair ? force->pair_style
                                         : "none";
  return "Talus " TALUS_VERSION "\nTalus: styles of this run\n" +
         line("pair " + pair, pair_is(system)) + line_of_bonds(*force) + lines_of_fixes() +
         line(std::string("run ") + update->integrate_style, run_style_is()) +
         line("steps without output", reason_for_arrays.empty()
                                          ? "in the records"
                                          : "through the arrays of LAMMPS: " + reason_for_arrays);
}

std::string StyleReport::pair_is(const GranularSystem &system) const
{
  if (!force->pair) return how("there is no pair style");
  if (const auto *talus_pair = SystemStyle::of(force->pair))
    return how(talus_pair->reason_for_stock());
  if (system.pair_style().is_alone()) return how("");    // the only part of hybrid
  if (system.pair_style().is_there())
    return system.pair_style().is_alone() ? "accelerated"
                                          : "sub-styles of Talus accelerated; others stock";
  if (utils::strmatch(force->pair_style, "^hybrid")) return how("no sub-style is accelerated");
  return how(why_stock(*force->pair_map, force->pair_style));
}

/* A fix of LAMMPS that does not act on particles within a step, such as fix pour or fix print,
   keeps none from being in the records: it needs no line. */

std::string StyleReport::lines_of_fixes() const
{
  std::string lines;
  for (Fix *fix : fix_list(*modify)) {
    const auto *talus_fix = SystemFix::of(fix);
    const bool acts = talus_fix || acts_within_steps(fix, modify->get_fix_mask(fix));
    if (is_internal(fix) || !acts) continue;
    lines += line(
        std::string("fix ") + fix->id + " " + fix->style,
        how(talus_fix ? talus_fix->reason_for_stock() : why_stock(*modify->fix_map, fix->style)));
  }
  return lines;
}

std::string StyleReport::run_style_is() const
{
  const auto *talus_run_style = SystemStyle::of(update->integrate);
  return how(talus_run_style ? talus_run_style->reason_for_stock() : "use run_style verlet");
}

}    // namespace Talus
