// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// What an exchange carries: the transfer asks it for numbers and hands numbers back.

#ifndef TALUS_COMM_PROXY_PACKER_H
#define TALUS_COMM_PROXY_PACKER_H

#include "comm/exchange_plan.h"

namespace Talus {

class ProxyPacker {
 public:
  /// Numbers per proxy, at most; a run occupies count * stride() of them in a message. The same
  /// on all ranks, and constant from begin() to finish() of an exchange.
  virtual int stride() const = 0;

  /// Writes the state of `count` owned particles, as seen shifted by whole periods.
  virtual void pack(const int *particles, int count, const PeriodicShift &shift, double *out) = 0;

  /// Reads the state of the proxies first, first + 1, ..., first + count - 1.
  virtual void unpack(int first, int count, const double *in) = 0;

 protected:
  ~ProxyPacker() = default;    // never deleted through this interface
};

}    // namespace Talus

#endif
