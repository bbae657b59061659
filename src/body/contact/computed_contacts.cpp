// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "body/contact/computed_contacts.h"

#include <utility>

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

void ComputedContacts::begin(bool are_listed)
{
  listed = are_listed;
  rows.clear();
  stored = 0.0;
}

/* Rows are large, and go from hand to hand. */

void ComputedContacts::add(std::vector<ContactReport> &&more, double energy)
{
  stored += energy;
  if (!more.empty()) rows.push_back(std::move(more));
}

void ComputedContacts::add(const ContactReport &one)
{
  stored += kept_energy(one);
  if (!listed) return;
  if (rows.empty()) rows.emplace_back();
  rows.back().push_back(one);
}

void ComputedContacts::for_each(const VisitContact &visit) const
{
  for (const auto &some : rows)
    for (const ContactReport &one : some) visit(one);
}

double ComputedContacts::memory_usage() const
{
  double sum = 0.0;
  for (const auto &some : rows) sum += static_cast<double>(some.capacity() * sizeof(ContactReport));
  return sum;
}

}    // namespace Talus
