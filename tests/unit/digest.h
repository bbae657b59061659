// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// A digest of numbers: all their bits go into 64 (FNV-1a).

#ifndef TALUS_TESTS_DIGEST_H
#define TALUS_TESTS_DIGEST_H

#include "base/vector3.h"

#include <array>
#include <cstdint>
#include <cstring>
#include <vector>

class Digest {
 public:
  std::uint64_t value = 0xcbf29ce484222325U;

  void add(double number)
  {
    if (number == 0.0) number = 0.0;    // the sign of a zero is not asked for
    unsigned char bytes[sizeof number];
    std::memcpy(bytes, &number, sizeof number);
    std::uint64_t bits = 0;
    for (int k = 0; k < 8; k++) bits |= static_cast<std::uint64_t>(bytes[k]) << 8 * k;
    for (int k = 0; k < 8; k++) value = (value ^ (bits >> 8 * k & 0xffU)) * 0x100000001b3U;
  }
  void add(const Talus::Vector3<double> &v)
  {
    add(v.x);
    add(v.y);
    add(v.z);
  }
  void add(const std::array<double, 3> &v)
  {
    for (const double one : v) add(one);
  }
  template <class T> void add(const std::vector<T> &all)
  {
    for (const T &one : all) add(one);
  }
};

#endif
