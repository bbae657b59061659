// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Tags of all messages on the private communicator of the exchange, one per kind of message.

#ifndef TALUS_EXCHANGE_EXCHANGE_TAGS_H
#define TALUS_EXCHANGE_EXCHANGE_TAGS_H

namespace Talus {

enum ExchangeTag {
  TAG_REQUEST = 1,    ///< ProxyExchange: which particles a rank wants as proxies
  TAG_STATE,          ///< ProxyExchange: their state
  TAG_ORIGIN,         ///< CommProxy: where proxies come from
  TAG_BORDER          ///< CommReach, on the communicator of LAMMPS: particles that become proxies
};

}    // namespace Talus

#endif
