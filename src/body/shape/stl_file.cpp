// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "body/shape/stl_file.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <sstream>
#include <stdexcept>

namespace Talus {
namespace {

constexpr std::size_t header = 84, record = 50;    // bytes of a binary file and of its triangles

std::uint32_t little_endian(const char *bytes)
{
  std::uint32_t value = 0;
  for (int k = 3; k >= 0; k--) value = (value << 8) | static_cast<unsigned char>(bytes[k]);
  return value;
}

double real(const char *bytes)
{
  const std::uint32_t bits = little_endian(bytes);
  float value;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

[[noreturn]] void fail(const std::string &what)
{
  throw std::runtime_error(what);
}

std::vector<Triangle> parse_binary(const std::string &content, std::size_t count)
{
  std::vector<Triangle> triangles(count);
  for (std::size_t t = 0; t < count; t++) {
    const char *corner = content.data() + header + record * t + 12;    // behind the normal
    for (Vector3<double> &p : triangles[t].corner) {
      p = {real(corner), real(corner + 4), real(corner + 8)};
      corner += 12;
      if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
        fail("triangle " + std::to_string(t + 1) + " has a coordinate that is not finite");
    }
  }
  return triangles;
}

/// Words of an ASCII file, with the line they stand in.
class Words {
 public:
  explicit Words(const std::string &content) : lines(content) {}

  bool next(std::string &word)
  {
    while (!(current >> word)) {
      std::string line;
      if (!std::getline(lines, line)) return false;
      number++;
      current.clear();
      current.str(line);
    }
    return true;
  }
  void skip_line() { current.str(""); }
  std::string place() const { return "line " + std::to_string(number); }

  void expect(const char *wanted)
  {
    std::string word;
    if (!next(word)) fail("the file ends where '" + std::string(wanted) + "' is expected");
    if (word != wanted) fail(place() + ": expected '" + wanted + "' instead of '" + word + "'");
  }

  double coordinate()
  {
    std::string word;
    if (!next(word)) fail("the file ends within a triangle");
    char *end = nullptr;
    const double value = std::strtod(word.c_str(), &end);
    if (*end || !std::isfinite(value))
      fail(place() + ": expected a finite number instead of '" + word + "'");
    return value;
  }

 private:
  std::istringstream lines, current;
  int number = 0;
};

Triangle parse_facet(Words &words)
{
  // the normal is not used, and may be "nan" in files of broken programs
  std::string unused;
  words.expect("normal");
  for (int k = 0; k < 3; k++)
    if (!words.next(unused)) fail("the file ends within a triangle");
  words.expect("outer");
  words.expect("loop");
  Triangle triangle;
  for (Vector3<double> &p : triangle.corner) {
    words.expect("vertex");
    const double x = words.coordinate(), y = words.coordinate();
    p = {x, y, words.coordinate()};
  }
  words.expect("endloop");
  words.expect("endfacet");
  return triangle;
}

std::vector<Triangle> parse_ascii(const std::string &content)
{
  std::vector<Triangle> triangles;
  Words words(content);
  std::string word;
  words.expect("solid");
  words.skip_line();    // its name may have any words
  bool ended = false;
  while (words.next(word)) {
    if (word == "facet") {
      triangles.push_back(parse_facet(words));
      ended = false;
    } else if (word == "endsolid" || word == "solid") {
      ended = word == "endsolid";
      words.skip_line();
    } else {
      fail(words.place() + ": expected 'facet' or 'endsolid' instead of '" + word + "'");
    }
  }
  if (!ended) fail("the file ends without 'endsolid'");
  return triangles;
}

}    // namespace

std::vector<Triangle> parse_stl(const std::string &content)
{
  if (content.empty()) fail("the file is empty");
  std::vector<Triangle> triangles;
  const bool has_header = content.size() >= header;
  const std::size_t count = has_header ? little_endian(content.data() + 80) : 0;
  const std::size_t size = header + record * count;
  const bool ascii = content.compare(0, 5, "solid") == 0;
  if (has_header && size == content.size()) {
    triangles = parse_binary(content, count);
  } else if (ascii) {
    triangles = parse_ascii(content);
  } else if (has_header) {
    fail("it announces " + std::to_string(count) + " triangles, which are " + std::to_string(size) +
         " bytes, but has " + std::to_string(content.size()) + " bytes");
  } else {
    fail("it is no STL file: it neither begins with 'solid' nor has a binary header");
  }
  if (triangles.empty()) fail("it has no triangles");
  return triangles;
}

}    // namespace Talus
