// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The state of particles as the exchange carries it: through the host's packing for every atom
// style, or our own for atom style sphere, which can leave out the angular velocity.
//
// A proxy across periodic boundaries is shifted by one period after the other, x first, in the
// order of the host's staged exchange: the same additions, so the same bits.

#ifndef TALUS_COMM_ATOM_PACKERS_H
#define TALUS_COMM_ATOM_PACKERS_H

#include "exchange/proxy_packer.h"

#include "pointers.h"

#include <array>
#include <vector>

namespace Talus {

/// The single steps of a shift, as vectors in the present box.
class ShiftSteps : protected LAMMPS_NS::Pointers {
 public:
  explicit ShiftSteps(LAMMPS_NS::LAMMPS *lmp) : Pointers(lmp) {}
  const std::vector<std::array<double, 3>> &of(const PeriodicShift &shift);

 private:
  std::vector<std::array<double, 3>> steps;
};

/// AtomVec::pack_comm() or pack_comm_vel(): whatever the atom style sends in every step.
class HostPacker : public ProxyPacker, protected LAMMPS_NS::Pointers {
 public:
  explicit HostPacker(LAMMPS_NS::LAMMPS *lmp) : Pointers(lmp), shifts(lmp) {}

  /// size: numbers per proxy as the host counts them; velocity: the host's ghost_velocity.
  void set(int size, bool velocity);

  int stride() const override { return size; }
  void pack(const int *particles, int count, double *out) override;
  void unpack(const ProxyRun &run, const int *places, const double *message) override;

 private:
  int size = 0;
  bool velocity = false;
  std::vector<double> state;    ///< scratch of unpack()
  ShiftSteps shifts;
};

/// x, v and, if asked for, omega of atom style sphere with constant radii: 72 or 48 bytes.
class SpherePacker : public ProxyPacker, protected LAMMPS_NS::Pointers {
 public:
  explicit SpherePacker(LAMMPS_NS::LAMMPS *lmp) : Pointers(lmp), shifts(lmp) {}

  /// Whether the atoms of this simulation can be packed so. Call after the host's init.
  bool applies(bool ghost_velocity) const;
  void send_spins(bool yes) { spins = yes; }

  int stride() const override { return spins ? 9 : 6; }
  void pack(const int *particles, int count, double *out) override;
  void unpack(const ProxyRun &run, const int *places, const double *message) override;

 private:
  bool spins = true;
  ShiftSteps shifts;
};

}    // namespace Talus

#endif
