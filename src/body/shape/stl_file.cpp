// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "body/shape/stl_file.h"

#include "base/words.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
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

/// Words of an ASCII file in lower case, with the line they stand in. What follows a # is a comment.
class StlWords {
 public:
  explicit StlWords(const std::string &content) : text(content) {}

  bool next(std::string &word)
  {
    for (; at < text.size() && (is_space(text[at]) || text[at] == '#'); at++) {
      if (text[at] == '#') skip_line();
      if (at < text.size() && text[at] == '\n') line++;
    }
    word.clear();
    for (; at < text.size() && !is_space(text[at]); at++) word.push_back(lower(text[at]));
    return !word.empty();
  }
  void skip_line() { at = std::min(text.find('\n', at), text.size()); }
  std::string place() const { return "line " + std::to_string(line); }

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
    const double value = parse_number(word);
    if (!std::isfinite(value))
      fail(place() + ": expected a finite number instead of '" + word + "'");
    return value;
  }

 private:
  static bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }
  static char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

  const std::string &text;
  std::size_t at = 0;
  int line = 1;
};

Triangle parse_facet(StlWords &words)
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
  StlWords words(content);
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

/// Begins with the word that ASCII files begin with, and has no byte that no text has.
bool is_ascii(const std::string &content)
{
  std::string word;
  return StlWords(content).next(word) && word.compare(0, 5, "solid") == 0 &&
         content.find('\0') == std::string::npos;
}

/// A number as coordinates are: other files have all kinds.
bool is_usual(double value)
{
  return value == 0.0 || (std::fabs(value) > 1.0e-20 && std::fabs(value) < 1.0e20);
}

/// Behind the header stands something like a triangle, or nothing; and it is no text.
bool looks_binary(const std::string &content)
{
  if (content.size() < header || content.find('\0') == std::string::npos) return false;
  if (content.size() < header + record) return content.size() == header;
  for (int k = 3; k < 12; k++)
    if (!is_usual(real(content.data() + header + 4 * k))) return false;
  return true;
}

/// How a file begins that is no STL file, as far as it can be printed.
std::string beginning_of(const std::string &content)
{
  std::string text;
  for (const char c : content) {
    if (c < ' ' || c > '~' || text.size() == 30) break;
    text.push_back(c);
  }
  return text.empty() ? "no text" : "'" + text + "'";
}

}    // namespace

StlContent parse_stl(const std::string &content)
{
  if (content.empty()) fail("the file is empty");
  StlContent found;
  const bool has_header = content.size() >= header;
  const std::size_t count = has_header ? little_endian(content.data() + 80) : 0;
  const std::size_t size = header + record * count;
  const bool is_exact = has_header && size == content.size();
  if (!is_exact && is_ascii(content)) {
    found.triangles = parse_ascii(content);
  } else if (is_exact || (size < content.size() && looks_binary(content))) {
    found.triangles = parse_binary(content, count);
    found.trailing_bytes = content.size() - size;
  } else if (looks_binary(content)) {
    fail("it announces " + std::to_string(count) + " triangles, which are " + std::to_string(size) +
         " bytes, but has " + std::to_string(content.size()) + " bytes");
  } else {
    fail("it is no STL file: it begins with " + beginning_of(content) +
         ", where an ASCII file has 'solid' and a binary one a header and triangles");
  }
  if (found.triangles.empty()) fail("it has no triangles");
  return found;
}

}    // namespace Talus
