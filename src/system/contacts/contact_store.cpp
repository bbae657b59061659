// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "system/contacts/contact_store.h"

#include "error.h"
#include "modify.h"

using namespace LAMMPS_NS;

namespace Talus {
namespace {

// The same in every process: restart files find fixes by ID.
constexpr const char *store_id = "TALUS_CONTACTS";
// Until the first run: only then read_restart has brought what the store is to continue with.
constexpr const char *placeholder_id = "TALUS_CONTACTS_LATER";

}    // namespace

void ContactStore::keep_place()
{
  if (!fix) modify->add_fix(std::string(placeholder_id) + " all DUMMY");
  was_there = fix != nullptr;
}

void ContactStore::create()
{
  if (fix) return;
  const std::string command = std::string(store_id) + " all CONTACT_STORE";
  if (modify->get_fix_by_id(placeholder_id))
    modify->replace_fix(placeholder_id, command, 1);
  else
    modify->add_fix(command);
}

void ContactStore::require(const std::string &command) const
{
  if (!fix && !modify->get_fix_by_id(placeholder_id))
    error->all(FLERR, "{}: its internal fix {} has been deleted: remove the unfix command", command,
               was_there ? store_id : placeholder_id);
}

void ContactStore::remove()
{
  for (const auto *internal : {store_id, placeholder_id})
    if (modify->get_fix_by_id(internal)) modify->delete_fix(internal);
}

}    // namespace Talus
