// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// A locale that writes 0,5 for 0.5, as many do: a program that LAMMPS is a library of may have set one,
// and must not change the meaning of numbers in scripts and files by that. Machines that run tests
// have no such locale installed; this one is written to a file in the format that glibc reads.

#ifndef TALUS_TESTS_COMMA_LOCALE_H
#define TALUS_TESTS_COMMA_LOCALE_H

#include <clocale>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include <unistd.h>

/// In force while it lives; `works` says whether the C library has taken it.
class CommaLocale {
 public:
  CommaLocale() :
      folder(std::filesystem::temp_directory_path() / ("comma-" + std::to_string(getpid())))
  {
    std::filesystem::create_directories(folder / "comma");
    write((folder / "comma" / "LC_NUMERIC").string());
    setenv("LOCPATH", folder.c_str(), 1);
    works = std::setlocale(LC_NUMERIC, "comma") != nullptr &&
            std::string(std::localeconv()->decimal_point) == ",";
  }
  ~CommaLocale()
  {
    std::setlocale(LC_NUMERIC, "C");
    unsetenv("LOCPATH");
    std::error_code ignored;
    std::filesystem::remove_all(folder, ignored);
  }
  CommaLocale(const CommaLocale &) = delete;
  CommaLocale &operator=(const CommaLocale &) = delete;

  bool works = false;

 private:
  /* Magic number of the category, number of fields, where each begins; then the fields: decimal
     point, thousands separator, grouping, the first two as wide characters, codeset. */
  static void write(const std::string &path)
  {
    const std::uint32_t fields = 6, start = 4 * (2 + fields);
    const std::uint32_t header[] = {0x20031115U ^ LC_NUMERIC,
                                    fields,
                                    start,
                                    start + 2,
                                    start + 3,
                                    start + 4,
                                    start + 8,
                                    start + 12};
    const std::uint32_t wide[] = {',', 0};
    std::ofstream file(path, std::ios::binary);
    file.write(reinterpret_cast<const char *>(header), sizeof header);
    file.write(",\0\0\0", 4);
    file.write(reinterpret_cast<const char *>(wide), sizeof wide);
    file.write("UTF-8", 6);
  }

  std::filesystem::path folder;
};

#endif
