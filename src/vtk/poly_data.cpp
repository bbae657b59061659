// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "vtk/poly_data.h"

#include "base/talus_version.h"
#include "vtk/text_file.h"

#include <cassert>
#include <cstdint>
#include <cstring>
#include <numeric>

namespace Talus {

namespace {

static_assert(sizeof(double) == 8);

/// Blocks of numbers behind the text, each with its size in bytes before it.
class Appended {
 public:
  template <class Number> std::string place_of(const std::vector<Number> &values)
  {
    const std::string offset = std::to_string(bytes.size());
    const std::uint64_t size = values.size() * sizeof(Number);
    add(&size, sizeof size);
    add(values.data(), size);
    return " format=\"appended\" offset=\"" + offset + "\"/>\n";
  }
  const std::vector<char> &all() const { return bytes; }

 private:
  void add(const void *from, std::size_t size)
  {
    const std::size_t at = bytes.size();
    bytes.resize(at + size);
    if (size) std::memcpy(&bytes[at], from, size);
  }
  std::vector<char> bytes;
};

std::string begin_file(const std::string &type)
{
  const std::uint16_t one = 1;
  char first;
  std::memcpy(&first, &one, 1);
  return "<?xml version=\"1.0\"?>\n<!-- written by Talus " TALUS_VERSION " -->\n<VTKFile type=\"" +
         type + "\" version=\"1.0\" byte_order=\"" + (first ? "LittleEndian" : "BigEndian") +
         "\" header_type=\"UInt64\">\n";
}

std::string describe(const char *tag, const char *type, const VtkPolyData::Array &array)
{
  return std::string("<") + tag + " type=\"" + type + "\" Name=\"" + xml_text(array.name) +
         "\" NumberOfComponents=\"" + std::to_string(array.components) + "\"";
}

/// `tag` with what is in it, one data array in a line; `end(array)` closes the line.
template <class Arrays, class End>
std::string list_arrays(const std::string &tag, const char *each, const Arrays &arrays, End end)
{
  std::string text = "<" + tag + ">\n";
  for (const VtkPolyData::Array &array : arrays)
    text += describe(each, "Float64", array) + end(array);
  return text + "</" + tag + ">\n";
}

std::string name_of(VtkCells kind)
{
  return kind == VtkCells::VERTICES ? "Verts" : kind == VtkCells::LINES ? "Lines" : "Polys";
}

}    // namespace

VtkPolyData::Array &VtkPolyData::add_point_data(const std::string &name, int components)
{
  return point_data.emplace_back(Array{name, components, {}});
}

VtkPolyData::Array &VtkPolyData::add_cell_data(const std::string &name, int components)
{
  return cell_data.emplace_back(Array{name, components, {}});
}

std::vector<const VtkPolyData::Array *> VtkPolyData::arrays() const
{
  std::vector<const Array *> all{&points};
  for (const Array &array : point_data) all.push_back(&array);
  for (const Array &array : cell_data) all.push_back(&array);
  return all;
}

std::vector<double> VtkPolyData::pack() const
{
  std::vector<double> packed{static_cast<double>(num_points())};
  for (const Array *array : arrays())
    packed.insert(packed.end(), array->values.begin(), array->values.end());
  return packed;
}

void VtkPolyData::append(const std::vector<double> &packed)
{
  const auto count = static_cast<std::int64_t>(packed[0]);
  auto next = packed.begin() + 1;
  const auto take = [&next](Array &array, std::int64_t tuples) {
    const auto end = next + tuples * array.components;
    array.values.insert(array.values.end(), next, end);
    next = end;
  };
  take(points, count);
  for (Array &array : point_data) take(array, count);
  for (Array &array : cell_data) take(array, count / static_cast<std::int64_t>(kind));
  assert(next == packed.end());
}

std::string VtkPolyData::write(const std::string &path, double time) const
{
  Appended appended;
  const auto place = [&appended](const Array &array) { return appended.place_of(array.values); };
  const std::size_t corners = static_cast<std::size_t>(kind);
  std::vector<std::int64_t> connectivity(num_points()), offsets(num_cells());
  std::iota(connectivity.begin(), connectivity.end(), 0);
  for (std::size_t k = 0; k < offsets.size(); k++)
    offsets[k] = static_cast<std::int64_t>(corners * (k + 1));

  std::string text = begin_file("PolyData") + "<PolyData>\n<FieldData>\n" +
                     "<DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\"" +
                     appended.place_of(std::vector<double>{time}) + "</FieldData>\n";
  text += "<Piece NumberOfPoints=\"" + std::to_string(num_points()) + "\"";
  for (VtkCells some : {VtkCells::VERTICES, VtkCells::LINES, VtkCells::TRIANGLES})
    text +=
        " NumberOf" + name_of(some) + "=\"" + std::to_string(some == kind ? num_cells() : 0) + "\"";
  text += " NumberOfStrips=\"0\">\n";
  text += list_arrays("PointData", "DataArray", point_data, place);
  text += list_arrays("CellData", "DataArray", cell_data, place);
  text += list_arrays("Points", "DataArray", std::deque<Array>(1, points), place);
  text += "<" + name_of(kind) + ">\n<DataArray type=\"Int64\" Name=\"connectivity\"" +
          appended.place_of(connectivity) + "<DataArray type=\"Int64\" Name=\"offsets\"" +
          appended.place_of(offsets) + "</" + name_of(kind) + ">\n";
  text += "</Piece>\n</PolyData>\n<AppendedData encoding=\"raw\">\n_";
  return write_file(path, {text.data(), text.size()},
                    {appended.all().data(), appended.all().size()},
                    "\n</AppendedData>\n</VTKFile>\n");
}

std::string VtkPolyData::write_list(const std::string &path,
                                    const std::vector<std::string> &pieces) const
{
  const auto end = [](const Array &) { return "/>\n"; };
  std::string text = begin_file("PPolyData") + "<PPolyData GhostLevel=\"0\">\n";
  text += list_arrays("PPointData", "PDataArray", point_data, end);
  text += list_arrays("PCellData", "PDataArray", cell_data, end);
  text += list_arrays("PPoints", "PDataArray", std::deque<Array>(1, Array{"Points", 3, {}}), end);
  for (const std::string &piece : pieces) text += "<Piece Source=\"" + xml_text(piece) + "\"/>\n";
  return write_file(path, text, "", "</PPolyData>\n</VTKFile>\n");
}

}    // namespace Talus
