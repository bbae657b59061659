// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The state of particles in the arrays of LAMMPS as the exchange carries it: through LAMMPS'
// packing for every atom style, or, faster, our own for atom style sphere.

#ifndef TALUS_SYSTEM_EXCHANGE_ATOM_PACKERS_H
#define TALUS_SYSTEM_EXCHANGE_ATOM_PACKERS_H

#include "exchange/proxy_packer.h"

#include "pointers.h"

#include <vector>

namespace Talus {

/// AtomVec::pack_comm() or pack_comm_vel(): whatever the atom style sends in every step.
class AtomVecPacker : public ProxyPacker, protected LAMMPS_NS::Pointers {
 public:
  explicit AtomVecPacker(LAMMPS_NS::LAMMPS *lmp) : Pointers(lmp) {}

  /// size: numbers per proxy as LAMMPS counts them; velocity: LAMMPS' ghost_velocity.
  void set(int size, bool velocity);

  int stride() const override { return size; }
  void pack(const ExchangeNeighbor &to, double *out) override;
  void unpack(const ExchangeNeighbor &from, const double *message) override;

 private:
  int size = 0;
  bool velocity = false;
  std::vector<double> state;    ///< scratch of unpack()
};

/// x, v and omega of atom style sphere with constant radii: 72 bytes.
class SpherePacker : public ProxyPacker, protected LAMMPS_NS::Pointers {
 public:
  explicit SpherePacker(LAMMPS_NS::LAMMPS *lmp) : Pointers(lmp) {}

  /// Whether the atoms of this simulation can be packed so. Call after LAMMPS' init.
  bool applies(bool ghost_velocity) const;

  int stride() const override { return 9; }
  void pack(const ExchangeNeighbor &to, double *out) override;
  void unpack(const ExchangeNeighbor &from, const double *message) override;
};

}    // namespace Talus

#endif
