// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// dump vtk/gran: grains, the forces of their contacts and the large bodies as one time series for
// ParaView. What is asked of the grains, and of which grains, is a matter of LAMMPS' dump
// custom; each part is a VtkPolyData. doc/dump_vtk_gran.md is the user's page.

#ifndef LMP_DUMP_VTK_GRAN_H
#define LMP_DUMP_VTK_GRAN_H

#include "system/step/granular_system.h"
#include "vtk/poly_data.h"
#include "vtk/time_series.h"

#include "dump_custom.h"

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace LAMMPS_NS {

class DumpVtkGran : public DumpCustom {
 public:
  DumpVtkGran(LAMMPS *lmp, int narg, char **arg);
  ~DumpVtkGran() override;

  void write() override;

 protected:
  void init_style() override;
  void openfile() override {}    // write() opens those of a step
  int modify_param(int, char **) override;

 private:
  /// An array of the grains: columns first ... first + components - 1 of dump custom.
  struct Column {
    std::string name;
    int first, components;
  };
  void find_columns();
  bool is_skipped();
  void fill_buffer();
  Talus::VtkPolyData grains();
  Talus::VtkPolyData contacts();
  Talus::VtkPolyData shapes() const;
  void write_part(const std::string &name, Talus::VtkPolyData &part, bool in_pieces);
  void collect(Talus::VtkPolyData &part) const;
  std::string file_name(const std::string &part, const std::string &end) const;
  void check(const std::string &problem) const;

  std::shared_ptr<Talus::GranularSystem> system;
  class ComputeContactList *contact_list;
  std::vector<Column> array_columns;
  bool with_contacts = true, with_bodies = true;
  std::string stem;    // of file names, with the folder
  std::unique_ptr<Talus::VtkTimeSeries> series;
  std::vector<std::pair<std::string, std::string>> parts;    // of this step: name, file
};

}    // namespace LAMMPS_NS

#endif
