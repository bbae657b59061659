// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "system/host/shared_file.h"

#include "comm.h"
#include "lammps.h"
#include "lmptype.h"

#include <cstdio>

using namespace LAMMPS_NS;

namespace Talus {

std::string read_everywhere(LAMMPS *lmp, const Words &words, const std::string &file)
{
  std::string content;
  long long size = -1;
  if (lmp->comm->me == 0) {
    if (FILE *fp = std::fopen(file.c_str(), "rb")) {
      char block[1 << 16];
      std::size_t got;
      while ((got = std::fread(block, 1, sizeof block, fp)) > 0) content.append(block, got);
      size = std::ferror(fp) ? -1 : static_cast<long long>(content.size());
      std::fclose(fp);
    }
  }
  MPI_Bcast(&size, 1, MPI_LONG_LONG, 0, lmp->world);
  if (size < 0) words.fail(1, "cannot read the file '" + file + "'");
  if (size > MAXSMALLINT) words.fail(1, "the file '" + file + "' is larger than 2 GB");
  content.resize(size);
  MPI_Bcast(&content[0], static_cast<int>(size), MPI_CHAR, 0, lmp->world);
  return content;
}

}    // namespace Talus
