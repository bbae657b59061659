// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#ifndef TALUS_BASE_NUMBER_TEXT_H
#define TALUS_BASE_NUMBER_TEXT_H

#include <locale>
#include <sstream>
#include <string>

namespace Talus {

/// As %.6g, or with other significant digits, in the C locale: programs that LAMMPS is a library of may write 0,5.
inline std::string number_text(double number, int digits = 6)
{
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text.precision(digits);
  text << number;
  return text.str();
}

}    // namespace Talus

#endif
