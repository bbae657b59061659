// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// How a private member of a LAMMPS class is reached: names in an explicit instantiation are not subject to access
// control (C++17, [temp.spec] 6), so a pointer to it can be taken there. Each has a tag, which finds it again. Only
// for the sources of private_members.h.

#ifndef TALUS_SYSTEM_HOST_PRIVATE_MEMBER_H
#define TALUS_SYSTEM_HOST_PRIVATE_MEMBER_H

namespace Talus {

template <class Tag, typename Tag::Type member> struct PrivateMember {
  friend typename Tag::Type pointer_to(Tag) { return member; }
};

// `kind`: the type of the pointer to the member
#define TALUS_PRIVATE_MEMBER(tag, kind, member)                                                    \
  struct tag {                                                                                     \
    using Type = kind;                                                                             \
    friend Type pointer_to(tag);                                                                   \
  };                                                                                               \
  template struct PrivateMember<tag, member>;

}    // namespace Talus

#endif
