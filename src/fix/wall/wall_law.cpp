// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "fix/wall/wall_law.h"

#include "material/contact_spec.h"

#include "gran_sub_mod.h"
#include "granular_model.h"

#include <algorithm>

namespace Talus {

void WallLaw::take(const Model &model, int num_types)
{
  const ContactSpec spec = spec_of_model(model);
  const ContactCoefficients row = contact_coefficients(spec, spec, FrictionMix::MINIMUM);
  table.reset(num_types);
  for (int i = 1; i <= num_types; i++)
    for (int j = i; j <= num_types; j++) table.set(i, j, spec.law, row);
  table.finish();
  places = stock_history_of({&model}).value();
  marks_touch = model.beyond_contact;
  if (marks_touch && places != std::vector<int>{-1}) places.insert(places.begin(), -1);
}

bool WallLaw::touches(const double *row) const
{
  if (marks_touch) return row[0] != 0.0;
  return std::any_of(row, row + places.size(), [](double value) { return value != 0.0; });
}

void WallLaw::read(const double *row, HistoryValues &values) const
{
  for (std::size_t n = 0; n < places.size(); n++)
    if (places[n] >= 0) values[places[n]] = row[n];
}

void WallLaw::write(const HistoryValues &values, double *row) const
{
  for (std::size_t n = 0; n < places.size(); n++) row[n] = places[n] >= 0 ? values[places[n]] : 0.0;
  if (marks_touch) row[0] = 1.0;
}

}    // namespace Talus
