// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "contact/narrow_phase.h"

namespace Talus {
namespace {

/// Squared distances and sums of radii of eight pairs.
struct Eight {
  Vec8 square, sum;
};

inline Eight look_at_eight(const Record *position, const int *first, const int *second)
{
  const Vec4 one = four(-1.0, -1.0, -1.0, 1.0);
  const Vec8 difference_and_sum = join(one, one);
  const auto two = [position](const int *slots, int k) {
    return join(load4(position[slots[k]]), load4(position[slots[k + 4]]));
  };
  Vec8 s[4];
  for (int k = 0; k < 4; k++) s[k] = two(first, k) + difference_and_sum * two(second, k);
  transpose(s[0], s[1], s[2], s[3]);
  return {s[0] * s[0] + s[1] * s[1] + s[2] * s[2], s[3]};
}

Eight look_at_last(const Record *position, const int *first, const int *second, int count)
{
  int i[8], j[8];
  for (int k = 0; k < 8; k++) {
    i[k] = first[k < count ? k : 0];
    j[k] = second[k < count ? k : 0];
  }
  return look_at_eight(position, i, j);
}

/// Of eight pairs those within their limits.
inline unsigned within_limits(Vec8 square, const double *limits, unsigned touched)
{
  const Vec8 limit = load8(limits);
  return less_bits(square, limit) | (touched & less_bits(square, Vec8{} - limit));
}

}    // namespace

std::int64_t find_contacts(const PairList &pairs, std::int64_t begin, std::int64_t end,
                           const Record *position, ContactHistory *history, std::uint32_t *contacts,
                           const BeyondTouch &beyond)
{
  const int *first = pairs.state_of_first(), *second = pairs.second.data();
  std::uint32_t *out = contacts;
  for (std::int64_t c = begin; c < end; c += 8) {
    const bool whole = c + 8 <= end;
    const int count = whole ? 8 : static_cast<int>(end - c);
    const Eight found = whole ? look_at_eight(position, first + c, second + c)
                              : look_at_last(position, first + c, second + c, count);
    const unsigned are_there = (1U << count) - 1U;
    unsigned bits = less_bits(found.square, found.sum * found.sum) & are_there;
    if (beyond.limits)
      bits |=
          within_limits(found.square, beyond.limits + c, history->touching_bits(c / 8)) & are_there;
    if (beyond.lasts)
      if (const unsigned ended = history->touching_bits(c / 8) & ~bits)
        bits |= (*beyond.lasts)(c, ended);
    out += store_places(out, static_cast<std::uint32_t>(c), bits);
    if (history) history->set_touching(c / 8, bits);
  }
  return out - contacts;
}

}    // namespace Talus
