// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Read access to private members of classes of the host that nothing else tells: names in an
// explicit instantiation are not subject to access control (C++17, [temp.spec] 6), so a pointer to
// the member can be taken there.
//
//   struct Count { using Type = int Host::*; friend Type pointer_to(Count); };
//   template struct Talus::PrivateMember<Count, &Host::count>;
//   ... host.*pointer_to(Count{}) ...
//
// in namespace Talus, with a tag for each member.

#ifndef TALUS_SYSTEM_PRIVATE_MEMBER_H
#define TALUS_SYSTEM_PRIVATE_MEMBER_H

namespace Talus {

template <class Tag, typename Tag::Type member> struct PrivateMember {
  friend typename Tag::Type pointer_to(Tag) { return member; }
};

}    // namespace Talus

#endif
