// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#ifndef TALUS_SYSTEM_REGIONS_REGION_HANDLE_H
#define TALUS_SYSTEM_REGIONS_REGION_HANDLE_H

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace LAMMPS_NS {
class Domain;
class Region;
}    // namespace LAMMPS_NS

namespace Talus {

/// A region of a script that lasts as long as the script wants: it may be deleted, and defined again, between two
/// runs. To be made in init() of who uses it. In a run it is there (see Definitions); who is asked between
/// two runs asks whether it is.
class RegionHandle {
 public:
  RegionHandle() = default;
  RegionHandle(const LAMMPS_NS::Domain &domain, LAMMPS_NS::Region &region);

  /// It is still that of then, and so are the regions of which it is made.
  bool is_there() const;
  LAMMPS_NS::Region *operator->() const { return region; }
  LAMMPS_NS::Region &operator*() const { return *region; }

 private:
  void add(LAMMPS_NS::Region &one);

  const LAMMPS_NS::Domain *domain = nullptr;
  LAMMPS_NS::Region *region = nullptr;
  std::vector<std::pair<std::string, const LAMMPS_NS::Region *>> parts;    // and itself, by ID
};

/// What a region looks like: the same on all ranks, another one if it has been defined anew in other words.
std::uint64_t digest_of(const LAMMPS_NS::Region &region);

}    // namespace Talus

#endif
