// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "system/host/restart_data.h"

#include "base/state_digest.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "lammps.h"
#include "utils.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <map>
#include <tuple>

using namespace LAMMPS_NS;

namespace Talus {
namespace {

/* Words of 8 bytes: a mark, without which it is not known whether there are others; the size, and its complement in the
   upper half; the digest. */

enum HeadWord { MARK, SIZE, DIGEST, HEAD_WORDS };
using Head = std::array<std::uint64_t, HEAD_WORDS>;
constexpr std::uint64_t mark = 0x44'7473'6572'6c54;    // "TlrestD"

const char *const problem = "the restart file is damaged, or was written by another version of "
                            "Talus: use another copy or an earlier file, or "
                            "go on with that version";

std::uint64_t word_of(double number)
{
  std::uint64_t word;
  std::memcpy(&word, &number, sizeof word);
  return word;
}

std::uint64_t digest_of(int format, const char *data, std::size_t bytes)
{
  StateDigest digest;
  digest.add(static_cast<std::uint64_t>(format));
  for (std::size_t n = 0; n < bytes; n += sizeof(std::uint64_t)) {
    std::uint64_t word = 0;
    std::memcpy(&word, data + n, std::min(sizeof word, bytes - n));
    digest.add(word);
  }
  return digest.value();
}

std::uint64_t size_word(std::size_t bytes)
{
  const auto size = static_cast<std::uint32_t>(bytes);
  return size | static_cast<std::uint64_t>(~size) << 32U;
}

/// Of what has a mark. The size is the low half.
bool tells_a_size(const Head &head)
{
  return head[SIZE] == size_word(head[SIZE] & 0x7fffffffU);
}

std::size_t size_of(const Head &head)
{
  return head[SIZE] & 0xffffffffU;
}

Head head_of(int format, const void *data, std::size_t bytes)
{
  return {mark, size_word(bytes), digest_of(format, static_cast<const char *>(data), bytes)};
}

}    // namespace

void write_restart_data(FILE *file, int format, const void *data, std::size_t bytes)
{
  const Head head = head_of(format, data, bytes);
  fwrite(head.data(), sizeof(Head), 1, file);
  fwrite(data, 1, bytes, file);
}

void write_restart_data_of_fix(FILE *file, int format, const void *data, std::size_t bytes)
{
  const int all = static_cast<int>(sizeof(Head) + bytes);
  fwrite(&all, sizeof all, 1, file);
  write_restart_data(file, format, data, bytes);
}

/* In the order in which it is known how much may be read. */

std::string read_restart_data(LAMMPS *lmp, const std::string &command, int format, FILE *file)
{
  Head head{};
  const auto take = [&](void *to, std::size_t bytes) {
    if (lmp->comm->me == 0) utils::sfread(FLERR, to, 1, bytes, file, nullptr, lmp->error);
    MPI_Bcast(to, static_cast<int>(bytes), MPI_BYTE, 0, lmp->world);
  };
  take(head.data(), sizeof head[MARK]);
  if (head[MARK] == mark) take(&head[SIZE], sizeof(Head) - sizeof head[MARK]);
  if (head[MARK] != mark || !tells_a_size(head)) lmp->error->all(FLERR, "{}: {}", command, problem);
  std::string data(size_of(head), '\0');
  take(data.data(), data.size());
  if (digest_of(format, data.data(), data.size()) != head[DIGEST])
    lmp->error->all(FLERR, "{}: {}", command, problem);
  return data;
}

std::vector<double> restart_data_of_fix(LAMMPS *lmp, const std::string &command, int format,
                                        const char *buf)
{
  Head head{};
  std::memcpy(head.data(), buf, sizeof head[MARK]);
  if (head[MARK] == mark) std::memcpy(head.data(), buf, sizeof head);
  const char *const data = buf + sizeof head;
  if (head[MARK] != mark || !tells_a_size(head) ||
      digest_of(format, data, size_of(head)) != head[DIGEST])
    lmp->error->all(FLERR, "{}: {}", command, problem);
  std::vector<double> numbers(size_of(head) / sizeof(double));
  std::memcpy(numbers.data(), data, numbers.size() * sizeof(double));
  return numbers;
}

/* ---- of particles --------------------------------------------------------------------------- */

/* The first double is the number of all of them, with which LAMMPS and fixes find the next ones; the second the digest of
   the others, unless it is the last. */

namespace {

double digest_of(double count, const double *data, int size)
{
  StateDigest digest;
  digest.add(count);
  digest.add(data, size);
  const std::uint64_t word = digest.value();
  double bits;
  std::memcpy(&bits, &word, sizeof bits);
  return bits;
}

bool is_same(double a, double b)
{
  return word_of(a) == word_of(b);
}

/// Where the data of the nth fix begin; nullptr if what is before them, or they, cannot be.
const double *find_particle_data(const Atom &atom, int i, int nth)
{
  int begin = 0;
  for (int n = 0; begin < atom.nextra_store; n++) {
    const double count = atom.extra[i][begin];
    if (!(count >= 1.0 && count <= atom.nextra_store - begin) || count != static_cast<int>(count))
      return nullptr;
    if (n == nth) return &atom.extra[i][begin];
    begin += static_cast<int>(count);
  }
  return nullptr;
}

/// An instance, which may have ended, and another one may be where it was.
struct Instance {
  const LAMMPS *address;
  double begin;

  explicit Instance(const LAMMPS *lmp) : address(lmp), begin(lmp->initclock) {}
  bool operator<(const Instance &o) const
  {
    return std::tie(address, begin) < std::tie(o.address, o.begin);
  }
};

/// Commands, by instance, with data that are damaged, until it is told.
std::map<Instance, std::string> &damaged()
{
  static std::map<Instance, std::string> commands;
  return commands;
}

}    // namespace

int complete_particle_data(double *buf, int size)
{
  buf[0] = size;
  buf[1] = digest_of(buf[0], buf + size_particle_head, size - size_particle_head);
  return size;
}

const double *particle_data(LAMMPS *lmp, const std::string &command, int i, int nth)
{
  const double *const found = find_particle_data(*lmp->atom, i, nth);
  const int size = found ? static_cast<int>(found[0]) - size_particle_head : -1;
  if (size >= 0 && is_same(found[1], digest_of(found[0], found + size_particle_head, size)))
    return found + size_particle_head;
  damaged()[Instance(lmp)] = command;
  return nullptr;
}

int append_digest(double *buf)
{
  const int size = static_cast<int>(buf[0]);
  buf[0] = size + size_of_digest;
  buf[size] = digest_of(buf[0], buf + 1, size - 1);
  return size + size_of_digest;
}

const double *stock_particle_data(LAMMPS *lmp, const std::string &command, int i, int nth,
                                  const StockSize &stock_size)
{
  const double *const found = find_particle_data(*lmp->atom, i, nth);
  bool intact = found != nullptr;
  if (intact) {
    const int size = static_cast<int>(found[0]);
    const bigint of_stock = size > 1 ? stock_size(found) : 1;
    intact =
        of_stock == size || (of_stock + size_of_digest == size &&
                             is_same(found[size - 1], digest_of(found[0], found + 1, size - 2)));
  }
  if (intact) return found;
  damaged()[Instance(lmp)] = command;
  return nullptr;
}

void require_intact_particles(LAMMPS *lmp)
{
  const auto mine = damaged().find(Instance(lmp));
  int from = mine == damaged().end() ? lmp->comm->nprocs : lmp->comm->me;
  MPI_Allreduce(MPI_IN_PLACE, &from, 1, MPI_INT, MPI_MIN, lmp->world);
  if (from == lmp->comm->nprocs) return;
  std::string command = mine == damaged().end() ? "" : mine->second;
  damaged().erase(Instance(lmp));
  int size = static_cast<int>(command.size());
  MPI_Bcast(&size, 1, MPI_INT, from, lmp->world);
  command.resize(size);
  MPI_Bcast(command.data(), size, MPI_CHAR, from, lmp->world);
  lmp->error->all(FLERR, "{}: {}", command, problem);
}

}    // namespace Talus
