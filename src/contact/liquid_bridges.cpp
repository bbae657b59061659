// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "contact/liquid_bridges.h"

#include "contact/contact_pipeline.h"
#include "laws/cohesion/liquid_of_particles.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace Talus {

double BridgeTerms::largest(double radius_1, double radius_2) const
{
  return fraction > 0.0 ? volume + fraction * size_of_pair(radius_1, radius_2).volume : volume;
}

/* Rows are those of all pairs of types. */

void LiquidBridges::set(const LawTable &table)
{
  of_row.clear();
  const int types = table.row(2, 1) - table.row(1, 1);
  bool some = false;
  std::vector<BridgeTerms> found(static_cast<std::size_t>(types) * types);
  for (int row = 0; row < types * types; row++) {
    const ContactLaw &law = table.law(row);
    if (!law.cohesion().shares_liquid) continue;
    const auto number = [&](const char *name) {
      return law.coefficient(Stage::COHESION, name, table.coefficients(row));
    };
    found[row] = {number("share"), number("volume"), number("fraction"), number("reach"),
                  law.history().of_stage[static_cast<int>(Stage::COHESION)][0]};
    some = some || found[row].share > 0.0;
  }
  if (some) of_row = std::move(found);
}

/* Of a pair, with radii from the records of its particles, or of copies of them. */

static FacingLiquid facing_liquid_of(const PairList &pairs, std::int64_t pair,
                                     const Record *position, const double *liquid)
{
  const std::vector<int> &atom = pairs.order().atom_of_slot;
  const int i = pairs.first[pair], j = pairs.second[pair];
  return facing_liquid(position[pairs.state_of_first()[pair]].c[3], liquid[atom[i]],
                       position[j].c[3], liquid[atom[j]]);
}

/* A set-up only reads histories: a bridge has the liquid of the step before, but that of a new contact. */

void ContactChunk::find_bridge_volumes(const Step &step, int end)
{
  const LiquidBridges &bridges = step.scene.liquid;
  const Record *position = step.particles.position.data();
  for (int k = 0; k < end; k++) {
    const std::uint32_t pair = pair_of_lane[k];
    const BridgeTerms &terms = bridges.terms(row_of_pair(step.scene, pair));
    if (!(terms.share > 0.0)) continue;
    double &volume = batch.history[terms.history][k];
    if (volume != 0.0 && (!step.advance || batch.overlap[k] < 0.0)) continue;
    const double ri = position[pairs.state_of_first()[pair]].c[3],
                 rj = position[pairs.second[pair]].c[3];
    const FacingLiquid facing = facing_liquid_of(pairs, pair, position, step.liquid);
    volume = bridge_volume(facing, terms.share, terms.largest(ri, rj));
    if (!(volume > 0.0)) volume = LiquidBridges::dry;
  }
}

/* Of a pair that is apart and has touched. */

bool ContactChunk::bridge_holds(const Step &step, std::int64_t pair)
{
  const BridgeTerms &terms = step.scene.liquid.terms(row_of_pair(step.scene, pair));
  const Record *position = step.particles.position.data();
  const double volume = history.record(pair, terms.history / 4).c[terms.history % 4];
  if (!(volume > 0.0)) return false;
  const Record &i = position[pairs.state_of_first()[pair]], &j = position[pairs.second[pair]];
  double squared = 0.0;
  for (int d = 0; d < 3; d++) squared += (i.c[d] - j.c[d]) * (i.c[d] - j.c[d]);
  if (terms.holds(volume, std::sqrt(squared) - (i.c[3] + j.c[3]))) return true;
  const FacingLiquid facing = facing_liquid_of(pairs, pair, position, step.liquid);
  flows.push_back(
      {pairs.first[pair], pairs.second[pair], flow_at_rupture(facing, terms.share, volume)});
  return false;
}

/* Both ends of each, the first one is that which receives. */

void ContactPipeline::add_liquid_flows(double *liquid) const
{
  std::vector<LiquidFlow> ends;
  for (const ContactChunk &chunk : chunks)
    for (const LiquidFlow &one : chunk.liquid_flows())
      for (const LiquidFlow &end : {one, LiquidFlow{one.second, one.first, -one.volume}})
        if (order.owns_slot(end.first)) ends.push_back(end);
  std::sort(ends.begin(), ends.end(), [](const LiquidFlow &a, const LiquidFlow &b) {
    return std::tie(a.first, a.second) < std::tie(b.first, b.second);
  });
  for (const LiquidFlow &end : ends) liquid[order.atom_of_slot[end.first]] += end.volume;
}

}    // namespace Talus
