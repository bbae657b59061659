// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "vtk/time_series.h"

#include "base/words.h"
#include "vtk/text_file.h"

#include <fstream>
#include <iomanip>
#include <locale>
#include <sstream>

namespace Talus {

namespace {

const std::string begin_line = "<DataSet timestep=\"";

std::string as_text(double value)
{
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text << std::setprecision(17) << value;
  return text.str();
}

}    // namespace

void VtkTimeSeries::go_on(double time)
{
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    if (line.compare(0, begin_line.size(), begin_line) != 0) continue;
    const std::size_t first = begin_line.size(), end = line.find('"', first);
    if (end == std::string::npos) continue;
    if (parse_number(line.substr(first, end - first)) < time) lines += line + "\n";
  }
}

std::string VtkTimeSeries::add(double time,
                               const std::vector<std::pair<std::string, std::string>> &parts)
{
  int number = 0;
  for (const auto &[name, file] : parts)
    lines += begin_line + as_text(time) + "\" part=\"" + std::to_string(number++) + "\" name=\"" +
             xml_text(name) + "\" file=\"" + xml_text(file) + "\"/>\n";
  return write_file(path,
                    "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\">\n"
                    "<Collection>\n",
                    lines, "</Collection>\n</VTKFile>\n");
}

}    // namespace Talus
