// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Carries a few more numbers of each particle in the messages of another packer: those of all
// particles of a message stand behind what that one has written. So orientations of particles with
// a shape travel with position and velocity, whether these are in the arrays of LAMMPS or in the
// records.

#ifndef TALUS_EXCHANGE_PACKER_WITH_ROWS_H
#define TALUS_EXCHANGE_PACKER_WITH_ROWS_H

#include "exchange/proxy_packer.h"

namespace Talus {

class PackerWithRows : public ProxyPacker {
 public:
  static constexpr int columns = 4;

  /// Until finish() of the exchange. `rows`: `columns` numbers of each owned particle and proxy;
  /// those of a periodic image are the same as those of its particle.
  void set(ProxyPacker &packer, double *const *rows)
  {
    first = &packer;
    row = rows;
  }

  int stride() const override { return first->stride() + columns; }
  void pack(const ExchangeNeighbor &to, double *out) override;
  void unpack(const ExchangeNeighbor &from, const double *message) override;

 private:
  ProxyPacker *first = nullptr;
  double *const *row = nullptr;
};

}    // namespace Talus

#endif
