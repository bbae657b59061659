// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "system/exchange/direct_exchange.h"

#include "exchange/exchange_tags.h"
#include "system/shapes/shaped_particles.h"
#include "system/step/granular_system.h"

#include "atom.h"
#include "atom_vec.h"
#include "comm.h"
#include "error.h"
#include "force.h"
#include "pair.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

using namespace LAMMPS_NS;

namespace Talus {

DirectExchange::DirectExchange(LAMMPS *lmp, const Comm *of, StagedExchange stages) :
    Pointers(lmp), system(GranularSystem::of(lmp)), staged(std::move(stages)), owner(of),
    transfer(world), atom_vec_packer(lmp), sphere_packer(lmp)
{
  system->exchange().is_made(owner, this);
}

DirectExchange::~DirectExchange()
{
  system->exchange().is_deleted(owner);
}

/* ---------------------------------------------------------------------- */

void DirectExchange::init(int size_forward)
{
  look_for_unsupported();
  own_packing = sphere_packer.applies(comm->ghost_velocity);
  atom_vec_packer.set(size_forward, comm->ghost_velocity);
}

void DirectExchange::forget_plan()
{
  transfer.abandon();
  have_plan = false;
}

/* Not in the command alone: comm_modify and fix deform may come later. */

void DirectExchange::look_for_unsupported()
{
  const std::string problem = system->exchange().unsupported(true);
  fell_back = !problem.empty();
  if (fell_back && system->exchange().choice() == ExchangeSwitch::Choice::YES)
    error->all(FLERR, "comm_proxy: {} or 'comm_proxy no'", problem);
}

/* ---------------------------------------------------------------------- */

void DirectExchange::begin(ProxyPacker *packer)
{
  if (!have_plan) error->all(FLERR, "comm_proxy: no plan yet for an exchange (internal error)");
  finish();
  transfer.begin(choose_packer(packer));
  if (checks) poison_proxies();
}

void DirectExchange::finish()
{
  if (!transfer.pending()) return;
  transfer.finish();
  if (checks) check_states();
}

ProxyPacker &DirectExchange::choose_packer(ProxyPacker *given)
{
  ProxyPacker *packer = given;
  if (!packer && own_packing) packer = &sphere_packer;
  if (!packer) packer = &atom_vec_packer;
  double *const *const turned = orientations(given != nullptr);
  if (!turned) return *packer;
  with_orientations.set(*packer, turned);
  return with_orientations;
}

/* Of atom style bpm/sphere LAMMPS packs them itself, where it does: shapes are in no step in the records with these. */

double *const *DirectExchange::orientations(bool in_records) const
{
  if (plan_has_orientations && system->shapes()) return system->shapes()->orientations();
  return in_records && atom->quat_flag ? atom->quat : nullptr;
}

/* Of the states in the arrays of LAMMPS. */

int DirectExchange::stride() const
{
  const int of_state = own_packing ? sphere_packer.stride() : atom_vec_packer.stride();
  return of_state + (plan_has_orientations ? PackerWithRows::columns : 0);
}

/* ---------------------------------------------------------------------- */

/* A fix shape/gran that comes later ends the run with an error; the messages before must fit. */

void DirectExchange::derive_plan()
{
  if (fell_back) return;
  plan_has_orientations = system->shapes() != nullptr;
  try {
    transfer.make_plan(atom->nlocal, staged.trace_origins(transfer.communicator()),
                       staged.possible_neighbors(), largest_stride());
  } catch (const std::length_error &problem) {
    error->one(FLERR, "comm_proxy: {}", problem.what());
  } catch (const std::invalid_argument &problem) {
    error->one(FLERR, "comm_proxy: {} (internal error)", problem.what());
  }
  have_plan = true;
  if (checks) check_owners();
}

/* Of what this object and the run style send with one plan: the states of particles, and their
   identity in a check. */

int DirectExchange::largest_stride() const
{
  constexpr int identity = 2;
  const int largest = std::max({sphere_packer.stride(), atom_vec_packer.stride(), identity});
  return largest + (plan_has_orientations || atom->quat_flag ? PackerWithRows::columns : 0);
}

/* ---------------------------------------------------------------------- */

double DirectExchange::messages_per_exchange() const
{
  double count = 0.0;
  for (const ExchangeNeighbor &n : plan().neighbors()) count += n.send_count() > 0;
  return count;
}

double DirectExchange::bytes_per_exchange() const
{
  return transfer.bytes_per_exchange(stride());
}

std::string DirectExchange::describe_message() const
{
  const auto bytes = sizeof(double) * stride();
  const char *more = plan_has_orientations ? ", orientation" : "";
  if (own_packing) return fmt::format("{} bytes per particle: x, v, omega{}", bytes, more);
  return fmt::format("{} bytes per particle, packed by LAMMPS (atom style {}){}", bytes,
                     atom->atom_style, more);
}

}    // namespace Talus
