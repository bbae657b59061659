// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "exchange/record_packer.h"

#include "particles/particle_records.h"

#include <algorithm>
#include <cassert>

using namespace Talus;

namespace {

// Slots whose records are prefetched: they stand far from each other, and so many loads from memory
// can be under way at the same time.
constexpr int ahead = 24;

/// Four numbers at any address of a message.
inline Vec4 load_anywhere(const double *address)
{
  return Memory<Vec4>::load_anywhere(address);
}
inline void store_anywhere(double *address, Vec4 value)
{
  Memory<Vec4>::store_anywhere(address, value);
}

/// The first three numbers of one vector, the fourth of another.
inline Vec4 with_fourth_of(Vec4 row, Vec4 other)
{
  return shuffle<0, 1, 2, 7>(row, other);
}
/// The last three numbers of one vector, then the fourth of another.
inline Vec4 last_three_with_fourth_of(Vec4 row, Vec4 other)
{
  return shuffle<1, 2, 3, 7>(row, other);
}

}    // namespace

/* ---------------------------------------------------------------------- */

void RecordPacker::set_plan(const ExchangePlan &plan, const int *slot_of_atom)
{
  slots.clear();
  for (const ExchangeNeighbor &neighbor : plan.neighbors())
    slots.push_back(slots_of(neighbor, slot_of_atom));
  slots.push_back(slots_of(plan.self(), slot_of_atom));
}

RecordPacker::Slots RecordPacker::slots_of(const ExchangeNeighbor &neighbor,
                                           const int *slot_of_atom)
{
  Slots result{neighbor.rank, neighbor.send_index, {}};
  for (int &sent : result.sent) sent = slot_of_atom[sent];
  neighbor.for_each_proxy([&](int proxy, int place, const PeriodicShift &shift) {
    if (result.received.empty() || result.received.back().shift != shift)
      result.received.push_back({shift, {}});
    result.received.back().targets.push_back({slot_of_atom[proxy], place});
  });
  return result;
}

const RecordPacker::Slots &RecordPacker::slots_with(int rank) const
{
  const auto found = std::find_if(slots.begin(), slots.end(),
                                  [rank](const Slots &one) { return one.rank == rank; });
  assert(found != slots.end());
  return *found;
}

void RecordPacker::set_state(ParticleRecords &where, const PeriodicBox &present)
{
  records = &where;
  box = present;
}

int RecordPacker::stride() const
{
  return records->stride == 2 ? 9 : 6;
}

/* ---------------------------------------------------------------------- */

void RecordPacker::pack(const ExchangeNeighbor &to, double *out)
{
  const std::vector<int> &sent = slots_with(to.rank).sent;
  records->stride == 2 ? pack_all<true>(sent, out) : pack_all<false>(sent, out);
}

/* Each record is stored whole. Its fourth number lands on the first one of the next record, which
   is stored later: only the last particle of a message must not write behind it. */

template <bool rotation>
void RecordPacker::pack_all(const std::vector<int> &sent, double *out) const
{
  const ParticleRecords &from = *records;
  constexpr int width = rotation ? 9 : 6;
  const int count = static_cast<int>(sent.size());
  for (int k = 0; k < count; k++, out += width) {
    from.prefetch(sent[std::min(k + ahead, count - 1)]);
    const Record *moves = &from.motion[(rotation ? 2L : 1L) * sent[k]];
    store_anywhere(out, load4(from.position[sent[k]]));
    if (rotation) store_anywhere(out + 3, load4(moves[0]));
    const Record &last = rotation ? moves[1] : moves[0];
    if (k + 1 < count)
      store_anywhere(out + width - 3, load4(last));
    else
      std::copy_n(last.c, 3, out + width - 3);
  }
}

/* The fourth numbers, radius and inverses of mass and radius, do not change between rebuilds. */

void RecordPacker::unpack(const ExchangeNeighbor &from, const double *message)
{
  for (const Run &run : slots_with(from.rank).received)
    records->stride == 2 ? unpack_run<true>(run, message) : unpack_run<false>(run, message);
}

template <bool rotation> void RecordPacker::unpack_run(const Run &run, const double *message)
{
  constexpr std::ptrdiff_t width = rotation ? 9 : 6;
  steps.clear();
  velocity_steps.clear();
  box.for_each_step(run.shift, [this](const std::array<double, 3> &step) {
    steps.push_back({{step[0], step[1], step[2], 0.0}});
  });
  box.for_each_velocity_step(run.shift, [this](const std::array<double, 3> &step) {
    velocity_steps.push_back({{step[0], step[1], step[2], 0.0}});
  });
  const int count = static_cast<int>(run.targets.size());
  for (int k = 0; k < count; k++) {
    records->prefetch(run.targets[std::min(k + ahead, count - 1)].slot);
    const std::size_t s = run.targets[k].slot;
    const double *in = message + width * run.targets[k].place;
    Record &position = records->position[s];
    Record *moves = &records->motion[(rotation ? 2 : 1) * s];
    Vec4 x = with_fourth_of(load_anywhere(in), load4(position));
    for (const Record &step : steps) x = x + load4(step);
    store(position, x);
    const Vec4 before[2] = {load4(moves[0]), load4(moves[rotation])};
    if (rotation) store(moves[0], with_fourth_of(load_anywhere(in + 3), before[0]));
    Record &last =
        rotation ? moves[1] : moves[0];    // one number earlier: it ends with the message
    store(last, last_three_with_fourth_of(load_anywhere(in + width - 4), load4(last)));
    for (const Record &step : velocity_steps) store(moves[0], load4(moves[0]) + load4(step));
    if (!records->keeps_changes()) continue;
    if (rotation)
      records->keep_change(s, before[0], load4(moves[0]), before[1], load4(moves[1]));
    else
      records->keep_change(s, before[0], load4(moves[0]), Vec4{}, Vec4{});
  }
}
