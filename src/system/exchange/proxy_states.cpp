// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "system/exchange/proxy_states.h"

#include "system/exchange/direct_exchange.h"
#include "system/exchange/exchange_switch.h"
#include "system/host/present_box.h"

#include "base/nearly_sorted.h"

#include "comm.h"
#include "domain.h"
#include "timer.h"

#include <vector>

using namespace LAMMPS_NS;

namespace Talus {

const std::vector<int> &ProxyStates::sent()
{
  if (sent_is_known) return sent_particles;
  sent_particles.clear();
  if (const DirectExchange *proxies = exchange.direct()) {
    sent_particles = proxies->plan().self().send_index;
    for (const ExchangeNeighbor &n : proxies->plan().neighbors())
      sent_particles.insert(sent_particles.end(), n.send_index.begin(), n.send_index.end());
  }
  sort_and_unite(sent_particles);
  sent_is_known = true;
  return sent_particles;
}

/* Where states go through the arrays of LAMMPS, these have to show the particles that are sent: a
   step that is looked at may show its ghosts. */

void ProxyStates::update(bool overlap, ContactPipeline &particles, const ParticleView &arrays,
                         bool stay)
{
  DirectExchange *proxies = exchange.direct();
  const bool from_records = particles.motion().holds_state();
  in_records = from_records && stay && proxies && !proxies->is_checking();
  if (from_records && !in_records) particles.motion().copy_states(sent(), arrays);
  if (!proxies || !proxies->has_plan() || !(overlap || in_records)) {
    comm->forward_comm();    // complete at its end
    return;
  }
  proxies->begin(in_records ? packer_of_records(particles) : nullptr);
  if (overlap)
    proxies->counters().overlapped++;
  else
    proxies->finish();
}

ProxyPacker *ProxyStates::packer_of_records(ContactPipeline &particles)
{
  if (!packer_knows_plan)
    packer.set_plan(exchange.direct()->plan(), particles.particle_order().slot_of_atom.data());
  packer_knows_plan = true;
  packer.set_state(particles.records(), present_box(*domain));
  return &packer;
}

/* What was done before counts as pair time, the rest as communication. */

void ProxyStates::finish()
{
  DirectExchange *proxies = exchange.direct();
  if (!proxies || !proxies->pending()) return;
  timer->stamp(Timer::PAIR);
  proxies->finish();
  timer->stamp(Timer::COMM);
}

}    // namespace Talus
