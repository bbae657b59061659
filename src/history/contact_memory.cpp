// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "history/contact_memory.h"

#include <algorithm>

namespace Talus {

std::int64_t ContactMemory::name_of(const std::string &id)
{
  std::uint64_t hash = 14695981039346656037U;    // FNV-1a
  for (const char c : id) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211U;
  return -static_cast<std::int64_t>(hash >> 1) - 1;
}

void ContactMemory::add(Holder &holder)
{
  if (std::find(holders.begin(), holders.end(), &holder) != holders.end()) return;
  holder.at_rest = true;
  holders.push_back(&holder);
}

void ContactMemory::remove(const Holder &holder)
{
  const auto known = std::find(holders.begin(), holders.end(), &holder);
  if (known == holders.end()) return;
  holders.erase(known);
  awake -= !holder.at_rest;
  if (holder.was_awake)
    store.lists.remove_if([&](const ContactLists::Contact &one) { return holder.owns(one); });
}

/* What those who are not at rest had put aside before is still there, if others have not taken theirs since. */

void ContactMemory::put_all_aside()
{
  std::vector<Holder *> those;
  for (Holder *one : holders)
    if (!one->at_rest) those.push_back(one);
  awake = 0;
  if (!store.lists.empty())
    store.lists.remove_if([&those](const ContactLists::Contact &contact) {
      return std::any_of(those.begin(), those.end(),
                         [&contact](const Holder *one) { return one->owns(contact); });
    });
  for (Holder *one : those) {
    one->at_rest = true;
    one->put_aside(store.lists);
  }
}

void ContactMemory::are_taken(Holder &holder)
{
  awake += holder.at_rest;
  holder.at_rest = false;
  holder.was_awake = true;
  if (awake == holders.size()) store.lists.clear();
}

void ContactMemory::are_numbered(const ParticleOrder &present)
{
  store.number(present);
  are_taken(spheres);
}

void ContactMemory::drop_spheres()
{
  store.clear();
  are_taken(spheres);
}

void ContactMemory::exchange_state(StateExchange &x)
{
  if (!x.restores()) put_aside();
  x(store);
  if (!x.restores()) return;
  for (Holder *one : holders) one->at_rest = true;
  awake = 0;
}

}    // namespace Talus
