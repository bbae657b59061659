// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// What the exchange wants to know of the pair style that reads the proxies. A pair style that
// implements it promises to look for a PendingExchange in compute() and to finish it before it
// reads a proxy.

#ifndef TALUS_COMM_PROXY_READER_H
#define TALUS_COMM_PROXY_READER_H

namespace Talus {

class ProxyReader {
 public:
  /// Share of the owned particles of this rank whose forces are computed before a pending exchange
  /// is finished; 0 if it computes nothing before.
  virtual double share_without_proxies() const = 0;

 protected:
  ~ProxyReader() = default;    // never deleted through this interface
};

}    // namespace Talus

#endif
