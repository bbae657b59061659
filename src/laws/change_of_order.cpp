// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "laws/change_of_order.h"

#include "laws/rounding.h"
#include "laws/second_order_laws.h"
#include "laws/tangential/end_of_contact.h"

#include <algorithm>

namespace Talus {

void change_order(const ContactLaw &law, int order, HistoryValues &values)
{
  const ContactLaw second = second_order_law(law);
  const ContactLaw &from = order == 2 ? law : second, &to = order == 2 ? second : law;
  const HistoryLayout was = from.history(), is = to.history();
  const HistoryValues old = values;
  values = {};

  const auto take = [&](const HistoryIndices &there, const HistoryIndices &here, int count) {
    for (int n = 0; n < count; n++) values[here[n]] = old[there[n]];
  };
  const auto indices_of = [](const HistoryLayout &of, Stage stage) {
    return of.of_stage[static_cast<int>(stage)];
  };
  const HistoryIndices spring = indices_of(is, Stage::TANGENTIAL),
                       rolls = indices_of(is, Stage::ROLLING);
  take(indices_of(was, Stage::TANGENTIAL), spring,
       std::min(from.tangential().odd_history, to.tangential().odd_history));
  if (from.rolling().even_history > 0 && to.rolling().even_history > 0) {
    take(indices_of(was, Stage::ROLLING), rolls,
         std::min(from.rolling().even_history, to.rolling().even_history));
    values[rolls[0]] = rounded<47>(values[rolls[0]]);
  }
  if (was.keeps_impact && is.keeps_impact) take(was.impact, is.impact, 3);
  if (order == 2) values[spring[to.tangential().odd_history]] = Past::of_order_1;
}

}    // namespace Talus
