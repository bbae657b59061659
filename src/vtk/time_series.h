// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// A file *.pvd: which files belong to which time, in one or several named parts.

#ifndef TALUS_VTK_TIME_SERIES_H
#define TALUS_VTK_TIME_SERIES_H

#include <string>
#include <utility>
#include <vector>

namespace Talus {

class VtkTimeSeries {
 public:
  explicit VtkTimeSeries(std::string path) : path(std::move(path)) {}

  /// Takes over what such a file tells of times before `time`, if there is one.
  void go_on(double time);

  /// Name and file (as seen from this one) of each part. The list on disk is then complete up to
  /// this time. "" or what went wrong.
  std::string add(double time, const std::vector<std::pair<std::string, std::string>> &parts);

 private:
  std::string path;
  std::string lines;
};

}    // namespace Talus

#endif
