// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "contact/narrow_phase.h"

#include <type_traits>

namespace Talus {
namespace {

/// One bit for each of eight pairs, set if the pair touches; `wide`: if radii that are `factor` times as large do.
template <bool wide>
inline unsigned touching8(const Record *position, const int *first, const int *second,
                          [[maybe_unused]] double factor)
{
  const Vec4 one = four(-1.0, -1.0, -1.0, 1.0);
  const Vec8 difference_and_sum = join(one, one);
  const auto two = [position](const int *slots, int k) {
    return join(load4(position[slots[k]]), load4(position[slots[k + 4]]));
  };
  Vec8 s[4];
  for (int k = 0; k < 4; k++) s[k] = two(first, k) + difference_and_sum * two(second, k);
  transpose(s[0], s[1], s[2], s[3]);
  if constexpr (wide) s[3] = factor * s[3];
  return less_bits(s[0] * s[0] + s[1] * s[1] + s[2] * s[2], s[3] * s[3]);
}

template <bool wide>
unsigned touching_tail(const Record *position, const int *first, const int *second, int count,
                       double factor)
{
  int i[8], j[8];
  for (int k = 0; k < 8; k++) {
    i[k] = first[k < count ? k : 0];
    j[k] = second[k < count ? k : 0];
  }
  return touching8<wide>(position, i, j, factor) & ((1U << count) - 1U);
}

/// Of the pairs first ... first + 7 those `asked` that touch without overlap; `touched`: those that did before.
unsigned lasting(std::int64_t first, unsigned asked, unsigned touched,
                 const LastsBeyondContact &lasts)
{
  unsigned all = 0;
  for (; asked; asked &= asked - 1) {
    const int k = __builtin_ctz(asked);
    if (lasts(first + k, touched >> k & 1U)) all |= 1U << k;
  }
  return all;
}

}    // namespace

std::int64_t find_contacts(const PairList &pairs, std::int64_t begin, std::int64_t end,
                           const Record *position, ContactHistory *history, std::uint32_t *contacts,
                           const LastsBeyondContact *lasts, double reach)
{
  const int *first = pairs.state_of_first(), *second = pairs.second.data();
  std::uint32_t *out = contacts;

  const auto find = [&](auto wide, std::int64_t c, double factor) {
    return c + 8 <= end ? touching8<decltype(wide)::value>(position, first + c, second + c, factor)
                        : touching_tail<decltype(wide)::value>(position, first + c, second + c,
                                                               static_cast<int>(end - c), factor);
  };
  for (std::int64_t c = begin; c < end; c += 8) {
    unsigned bits = find(std::false_type{}, c, 1.0);
    if (lasts) {
      const unsigned touched = history->touching_bits(c / 8),
                     near = reach > 0.0 ? find(std::true_type{}, c, 1.0 + reach) : 0;
      bits |= lasting(c, (touched | near) & ~bits, touched, *lasts);
    }
    out += store_places(out, static_cast<std::uint32_t>(c), bits);
    if (history) history->set_touching(c / 8, bits);
  }
  return out - contacts;
}

}    // namespace Talus
