// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Pair style gran/penalty: its laws in restart files, see material/law_file.h.

#include "base/talus_version.h"
#include "pair/pair_gran_penalty.h"

#include "material/law_file.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "utils.h"

#include <cstdint>
#include <stdexcept>
#include <string>

using namespace LAMMPS_NS;
using namespace Talus;

namespace {

void write_number(std::int32_t number, FILE *fp)
{
  fwrite(&number, sizeof number, 1, fp);
}

}    // namespace

/* Read by the first rank, known to all. */

std::int32_t PairGranPenalty::read_number(FILE *fp)
{
  std::int32_t number = 0;
  if (comm->me == 0) utils::sfread(FLERR, &number, sizeof number, 1, fp, nullptr, error);
  MPI_Bcast(&number, 1, MPI_INT32_T, 0, world);
  return number;
}

void PairGranPenalty::write_restart(FILE *fp)
{
  write_restart_settings(fp);
  for (int i = 1; i <= atom->ntypes; i++)
    for (int j = i; j <= atom->ntypes; j++) {
      const PairCoeffs &pair_coeffs = system->laws();
      const std::string bytes = pair_coeffs.is_set(i, j) ? to_bytes(pair_coeffs.spec(i, j)) : "";
      write_number(static_cast<std::int32_t>(bytes.size()), fp);    // 0: mixed
      fwrite(bytes.data(), 1, bytes.size(), fp);
    }
}

void PairGranPenalty::read_restart(FILE *fp)
{
  read_restart_settings(fp);
  if (!allocated) allocate();
  for (int i = 1; i <= atom->ntypes; i++)
    for (int j = i; j <= atom->ntypes; j++) {
      const std::int32_t size = read_number(fp);
      if (size == 0) continue;
      std::string bytes(size, '\0');
      if (comm->me == 0) utils::sfread(FLERR, bytes.data(), 1, size, fp, nullptr, error);
      MPI_Bcast(bytes.data(), size, MPI_BYTE, 0, world);
      try {
        system->laws().set(i, j, from_bytes(bytes));
      } catch (const std::runtime_error &problem) {
        error->all(FLERR, "Pair style gran/penalty: types {} and {}: {}", i, j, problem.what());
      }
      setflag[i][j] = 1;
    }
}

void PairGranPenalty::write_restart_settings(FILE *fp)
{
  write_number(law_file_mark, fp);
  write_number(law_file_version, fp);
  write_number(talus_version, fp);
  write_number(static_cast<std::int32_t>(system->laws().mix), fp);
}

void PairGranPenalty::read_restart_settings(FILE *fp)
{
  const std::int32_t mark = read_number(fp);
  const std::string unmarked = problem_of_law_file(mark, law_file_version);
  if (!unmarked.empty()) error->all(FLERR, "Pair style gran/penalty: {}", unmarked);
  const std::int32_t version = read_number(fp);
  const std::string complaint = problem_of_law_file(mark, version);
  if (!complaint.empty()) error->all(FLERR, "Pair style gran/penalty: {}", complaint);
  if (version > oldest_law_file && read_number(fp) > talus_version && comm->me == 0)
    error->warning(FLERR, "Pair style gran/penalty: the restart file was written by a newer Talus");
  system->laws().mix = static_cast<FrictionMix>(read_number(fp));
}
