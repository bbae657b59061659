// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Points, lines or triangles with data, as files of ParaView: VTK's XML format for PolyData, with
// the numbers raw behind the text (https://docs.vtk.org, "VTKXMLFileFormats"). The only writer of
// such files that Talus has. No MPI: ranks that write one file together hand over pack().
//
// Cells share no points: the corners of cell k are the points n k ... n k + n-1, n of its kind. So
// pieces are put together by appending them.

#ifndef TALUS_VTK_POLY_DATA_H
#define TALUS_VTK_POLY_DATA_H

#include "base/vector3.h"

#include <cstddef>
#include <deque>
#include <string>
#include <vector>

namespace Talus {

/// The number is that of the points of a cell.
enum class VtkCells { VERTICES = 1, LINES = 2, TRIANGLES = 3 };

class VtkPolyData {
 public:
  struct Array {
    std::string name;
    int components;
    std::vector<double> values;

    void add(double value) { values.push_back(value); }
    void add(const Vector3<double> &v) { values.insert(values.end(), {v.x, v.y, v.z}); }
  };

  explicit VtkPolyData(VtkCells kind) : kind(kind) {}

  /// Corners of cells, one after another.
  void add_point(const Vector3<double> &x) { points.add(x); }
  /// A new array, to be filled with one tuple for each point or cell. The reference stays valid.
  Array &add_point_data(const std::string &name, int components);
  Array &add_cell_data(const std::string &name, int components);

  std::size_t num_points() const { return points.values.size() / 3; }
  std::size_t num_cells() const { return num_points() / static_cast<std::size_t>(kind); }

  /// All numbers, for another rank, which appends them to an object with the same arrays.
  std::vector<double> pack() const;
  void append(const std::vector<double> &packed);

  /// A file *.vtp, and a file *.pvtp that tells of pieces (paths as seen from there) with the
  /// arrays of this object. Return "" or what went wrong.
  std::string write(const std::string &path, double time) const;
  std::string write_list(const std::string &path, const std::vector<std::string> &pieces) const;

 private:
  std::vector<const Array *> arrays() const;

  VtkCells kind;
  Array points{"Points", 3, {}};
  std::deque<Array> point_data, cell_data;
};

}    // namespace Talus

#endif
