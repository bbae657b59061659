// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "contact/narrow_phase.h"

namespace Talus {
namespace {

/// One bit for each of eight pairs, set if the pair touches.
inline unsigned touching8(const Record *position, const int *first, const int *second)
{
  const Vec4 one = four(-1.0, -1.0, -1.0, 1.0);
  const Vec8 difference_and_sum = join(one, one);
  const auto two = [position](const int *slots, int k) {
    return join(load4(position[slots[k]]), load4(position[slots[k + 4]]));
  };
  Vec8 s[4];
  for (int k = 0; k < 4; k++) s[k] = two(first, k) + difference_and_sum * two(second, k);
  transpose(s[0], s[1], s[2], s[3]);
  return less_bits(s[0] * s[0] + s[1] * s[1] + s[2] * s[2], s[3] * s[3]);
}

unsigned touching_tail(const Record *position, const int *first, const int *second, int count)
{
  int i[8], j[8];
  for (int k = 0; k < 8; k++) {
    i[k] = first[k < count ? k : 0];
    j[k] = second[k < count ? k : 0];
  }
  return touching8(position, i, j) & ((1U << count) - 1U);
}

/// Of the pairs first ... first + 7 that touched and are not in `bits`, those that still do.
unsigned lasting(const ContactHistory &history, std::int64_t first, unsigned bits,
                 const LastsBeyondContact &lasts)
{
  unsigned still = 0;
  for (unsigned rest = history.touching_bits(first / 8) & ~bits; rest; rest &= rest - 1) {
    const int k = __builtin_ctz(rest);
    if (lasts(first + k)) still |= 1U << k;
  }
  return still;
}

}    // namespace

std::int64_t find_contacts(const PairList &pairs, std::int64_t begin, std::int64_t end,
                           const Record *position, ContactHistory *history, std::uint32_t *contacts,
                           const LastsBeyondContact *lasts)
{
  const int *first = pairs.state_of_first(), *second = pairs.second.data();
  std::uint32_t *out = contacts;

  for (std::int64_t c = begin; c < end; c += 8) {
    unsigned bits = c + 8 <= end
                        ? touching8(position, first + c, second + c)
                        : touching_tail(position, first + c, second + c, static_cast<int>(end - c));
    if (lasts) bits |= lasting(*history, c, bits, *lasts);
    out += store_places(out, static_cast<std::uint32_t>(c), bits);
    if (history) history->set_touching(c / 8, bits);
  }
  return out - contacts;
}

}    // namespace Talus
