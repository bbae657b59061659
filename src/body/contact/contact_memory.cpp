// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "body/contact/contact_memory.h"

#include <algorithm>

namespace Talus {

int ContactMemory::find(int particle, const Vector3<double> &normal, unsigned &taken) const
{
  constexpr double least_cosine = 0.8;    // 37 degrees; more than facets of a smooth patch differ
  const RememberedContact *known = begin(particle);
  int best = -1;
  double largest = least_cosine;
  for (int k = 0; k < count(particle); k++) {
    const double cosine = dot(known[k].normal, normal);
    if ((taken >> k & 1U) || cosine <= largest) continue;
    largest = cosine;
    best = k;
  }
  if (best >= 0) taken |= 1U << best;
  return best;
}

void ContactMemory::start_step()
{
  next.clear();
}

int ContactMemory::append(AlignedVector<RememberedContact> &piece)
{
  const int first = static_cast<int>(next.size());
  if (first == 0) {
    next.swap(piece);
    return 0;
  }
  next.insert(next.end(), piece.begin(), piece.end());
  return first;
}

void ContactMemory::end_step()
{
  contacts.swap(next);
}

int ContactMemory::pack(int particle, double *buf) const
{
  int m = 0;
  buf[m++] = count(particle);
  for (int k = 0; k < count(particle); k++) {
    const RememberedContact &c = begin(particle)[k];
    buf[m++] = c.normal.x;
    buf[m++] = c.normal.y;
    buf[m++] = c.normal.z;
    for (int d = 0; d < 4; d++) buf[m++] = c.history.c[d];
    for (int d = 0; d < 3; d++) buf[m++] = c.impact.c[d];
  }
  return m;
}

int ContactMemory::unpack(int particle, const double *buf)
{
  int m = 0;
  const int number = std::min(static_cast<int>(buf[m++]), LargeBodyShape::max_contacts);
  lists[particle] = {static_cast<int>(contacts.size()), number};
  for (int k = 0; k < number; k++) {
    RememberedContact c{};
    c.normal = {buf[m], buf[m + 1], buf[m + 2]};
    m += 3;
    for (int d = 0; d < 4; d++) c.history.c[d] = buf[m++];
    for (int d = 0; d < 3; d++) c.impact.c[d] = buf[m++];
    contacts.push_back(c);
  }
  return m;
}

double ContactMemory::memory_usage() const
{
  return static_cast<double>(lists.capacity() * sizeof(List) +
                             (contacts.capacity() + next.capacity()) * sizeof(RememberedContact));
}

}    // namespace Talus
