// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// What the writers of XML files share.

#ifndef TALUS_VTK_TEXT_FILE_H
#define TALUS_VTK_TEXT_FILE_H

#include <string>
#include <string_view>

namespace Talus {

/// With the characters that XML keeps for itself written as it wants them.
std::string xml_text(std::string_view text);

/// A file of three parts, the second of any bytes. "" or what went wrong.
std::string write_file(const std::string &path, std::string_view head, std::string_view data,
                       std::string_view tail);

}    // namespace Talus

#endif
