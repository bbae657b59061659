// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// History values of contacts: a row for each contact, of as many records of four values as its laws
// need (see HistoryLayout). The first records of all rows are contiguous, then the second ones:
// laws with few values read and write only these.

#ifndef TALUS_HISTORY_HISTORY_ROWS_H
#define TALUS_HISTORY_HISTORY_ROWS_H

#include "base/aligned_vector.h"
#include "base/history_values.h"
#include "particles/record.h"

#include <array>
#include <cstddef>
#include <cstring>

namespace Talus {

class HistoryRows {
 public:
  static constexpr int most_records = most_history_values / 4;

  /// `width` records of each row, 1 to most_records (HistoryLayout has no more); numbers of rows that
  /// exist stay, further ones are zero.
  void keep(int width)
  {
    for (int k = records(); k < width; k++) planes[k].assign(size(), Record{});
    for (int k = width; k < records(); k++) Talus::release(planes[k]);
    num_records = width;
  }
  int records() const { return num_records; }
  std::size_t size() const { return planes[0].size(); }
  bool empty() const { return planes[0].empty(); }

  Record &record(std::size_t row, int k = 0) { return planes[k][row]; }
  const Record &record(std::size_t row, int k = 0) const { return planes[k][row]; }
  /// Record k of all rows.
  Record *all(int k) { return planes[k].data(); }

  /// What is new is not set.
  void resize(std::size_t rows)
  {
    for (int k = 0; k < num_records; k++) planes[k].resize(rows);
  }
  /// See renew(): nothing is kept.
  void renew(std::size_t rows)
  {
    for (int k = 0; k < num_records; k++) Talus::renew(planes[k], rows);
  }
  void reserve(std::size_t rows)
  {
    for (int k = 0; k < num_records; k++) planes[k].reserve(rows);
  }
  /// Appends a row of zeros.
  void add()
  {
    for (int k = 0; k < num_records; k++) planes[k].push_back(Record{});
  }
  void set_zero(std::size_t row)
  {
    for (int k = 0; k < num_records; k++) planes[k][row] = Record{};
  }
  /// Removes all rows; keeps the memory.
  void clear()
  {
    for (auto &plane : planes) plane.clear();
  }
  void swap(HistoryRows &other)
  {
    planes.swap(other.planes);
    std::swap(num_records, other.num_records);
  }

  /// All records of a row to an array of them, and back.
  void get(std::size_t row, Record *to) const
  {
    for (int k = 0; k < num_records; k++) to[k] = planes[k][row];
  }
  void set(std::size_t row, const Record *from)
  {
    for (int k = 0; k < num_records; k++) planes[k][row] = from[k];
  }

  /// As values of which those beyond records() are zero, and back. Compilers see that these do not go
  /// beyond the end.
  HistoryValues values(std::size_t row) const
  {
    HistoryValues all{};
    for (int k = 0; k < most_records; k++)
      if (k < num_records) std::memcpy(&all[4L * k], &planes[k][row], sizeof(Record));
    return all;
  }
  void set_values(std::size_t row, const HistoryValues &all)
  {
    for (int k = 0; k < most_records; k++)
      if (k < num_records) std::memcpy(&planes[k][row], &all[4L * k], sizeof(Record));
  }

  double memory_usage() const
  {
    std::size_t records_in_memory = 0;
    for (const auto &plane : planes) records_in_memory += plane.capacity();
    return static_cast<double>(sizeof(Record) * records_in_memory);
  }

 private:
  int num_records = 1;
  std::array<AlignedVector<Record>, most_records> planes;
};

}    // namespace Talus

#endif
