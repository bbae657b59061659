// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// What an exchange carries: the transfer asks it for numbers and hands numbers back.

#ifndef TALUS_EXCHANGE_PROXY_PACKER_H
#define TALUS_EXCHANGE_PROXY_PACKER_H

#include "exchange/exchange_plan.h"

namespace Talus {

class ProxyPacker {
 public:
  /// Numbers per particle in a message. The same on all ranks, and constant from begin() to
  /// finish() of an exchange.
  virtual int stride() const = 0;

  /// Writes the states of `count` owned particles.
  virtual void pack(const int *particles, int count, double *out) = 0;

  /// Sets the state of the proxies of a run: proxy run.first + k is the particle whose state is the
  /// places[k]-th one of `message`, shifted by whole periods.
  virtual void unpack(const ProxyRun &run, const int *places, const double *message) = 0;

 protected:
  ~ProxyPacker() = default;    // never deleted through this interface
};

}    // namespace Talus

#endif
