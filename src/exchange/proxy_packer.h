// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// What an exchange carries: the transfer asks it for numbers and hands numbers back.

#ifndef TALUS_EXCHANGE_PROXY_PACKER_H
#define TALUS_EXCHANGE_PROXY_PACKER_H

#include "exchange/exchange_plan.h"

namespace Talus {

class ProxyPacker {
 public:
  /// Numbers per particle in a message. The same on all ranks, constant from begin() to finish() of
  /// an exchange, and at most the `largest_stride` of ProxyExchange::make_plan().
  virtual int stride() const = 0;

  /// Writes the states of the particles to.send_index, one after the other. `to` is a neighbor of
  /// the plan, or the plan's self().
  virtual void pack(const ExchangeNeighbor &to, double *out) = 0;

  /// Sets the states of all proxies that `from` owns, see ExchangeNeighbor::for_each_proxy().
  virtual void unpack(const ExchangeNeighbor &from, const double *message) = 0;

 protected:
  ~ProxyPacker() = default;    // never deleted through this interface
};

}    // namespace Talus

#endif
