// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "body/contact/computed_contacts.h"

namespace Talus {

/* Forces are those that the computation has found, energies those of the springs that it has left. */

ContactReport ComputedContact::with_energy(const LawTable &laws, double dt) const
{
  ContactReport found = report;
  found.stored = stored_energy(laws.law(row), laws.coefficients(row), state, dt, report.history);
  found.stored.normal *= energy;
  found.stored.tangential *= weight;
  return found;
}

void ComputedContacts::begin(const std::shared_ptr<const LawTable> &of, double time_step)
{
  contacts.clear();
  laws = of;
  dt = time_step;
}

void ComputedContacts::add(const std::vector<ComputedContact> &more)
{
  contacts.insert(contacts.end(), more.begin(), more.end());
}

void ComputedContacts::for_each(const VisitContact &visit) const
{
  for (const ComputedContact &one : contacts) visit(one.with_energy(*laws, dt));
}

}    // namespace Talus
