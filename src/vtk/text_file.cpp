// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "vtk/text_file.h"

#include <cerrno>
#include <cstdio>
#include <cstring>

namespace Talus {

std::string xml_text(std::string_view text)
{
  std::string safe;
  for (const char c : text) {
    if (c == '&')
      safe += "&amp;";
    else if (c == '<')
      safe += "&lt;";
    else if (c == '>')
      safe += "&gt;";
    else if (c == '"')
      safe += "&quot;";
    else
      safe += c;
  }
  return safe;
}

std::string write_file(const std::string &path, std::string_view head, std::string_view data,
                       std::string_view tail)
{
  std::FILE *file = std::fopen(path.c_str(), "wb");
  bool good = file != nullptr;
  for (const std::string_view part : {head, data, tail})
    good = good && std::fwrite(part.data(), 1, part.size(), file) == part.size();
  const int reason = errno;
  const bool closed = !file || std::fclose(file) == 0;
  if (good && closed) return "";
  return "cannot write '" + path + "': " + std::strerror(good ? errno : reason);
}

}    // namespace Talus
