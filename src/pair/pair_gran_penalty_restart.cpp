// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Pair style gran/penalty: its laws in restart files, see material/law_file.h.

#include "base/talus_version.h"
#include "pair/pair_gran_penalty.h"

#include "material/law_file.h"
#include "system/host/restart_data.h"

#include "atom.h"
#include "comm.h"
#include "error.h"

#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>

using namespace LAMMPS_NS;
using namespace Talus;

namespace {

constexpr int restart_format = 4;

/* Numbers of 4 bytes, and strings behind their size. */

void put(std::string &to, std::int32_t number)
{
  char raw[sizeof number];
  std::memcpy(raw, &number, sizeof number);
  to.append(raw, sizeof raw);
}

std::int32_t take_number(const char *&from)
{
  std::int32_t number;
  std::memcpy(&number, from, sizeof number);
  from += sizeof number;
  return number;
}

std::string take_string(const char *&from)
{
  const std::int32_t size = take_number(from);
  from += size;
  return {from - size, from};
}

}    // namespace

/* The version of Talus, the rule of mixing, the number of types; and of each pair of types its law, an empty string if it is mixed. */

void PairGranPenalty::write_restart(FILE *fp)
{
  std::string data;
  put(data, talus_version);
  put(data, static_cast<std::int32_t>(system->laws().mix));
  put(data, atom->ntypes);
  for (int i = 1; i <= atom->ntypes; i++)
    for (int j = i; j <= atom->ntypes; j++) {
      const PairCoeffs &pair_coeffs = system->laws();
      const std::string bytes = pair_coeffs.is_set(i, j) ? to_bytes(pair_coeffs.spec(i, j)) : "";
      put(data, static_cast<std::int32_t>(bytes.size()));
      data += bytes;
    }
  write_restart_data(fp, restart_format, data.data(), data.size());
}

void PairGranPenalty::read_restart(FILE *fp)
{
  const std::string data = read_restart_data(lmp, "Pair style gran/penalty", restart_format, fp);
  const char *from = data.data();
  if (take_number(from) > talus_version && comm->me == 0)
    error->warning(FLERR, "Pair style gran/penalty: the restart file was written by a newer Talus");
  system->laws().mix = static_cast<FrictionMix>(take_number(from));
  if (const std::int32_t types = take_number(from); types != atom->ntypes)
    error->all(FLERR,
               "Pair style gran/penalty: the restart file is damaged: it has laws of {} types, and "
               "{} types: use "
               "another copy or an earlier file",
               types, atom->ntypes);
  if (!allocated) allocate();
  for (int i = 1; i <= atom->ntypes; i++)
    for (int j = i; j <= atom->ntypes; j++) {
      const std::string bytes = take_string(from);
      if (bytes.empty()) continue;
      try {
        system->laws().set(i, j, from_bytes(bytes));
      } catch (const std::runtime_error &problem) {
        error->all(FLERR, "Pair style gran/penalty: types {} and {}: {}", i, j, problem.what());
      }
      setflag[i][j] = 1;
    }
}
