// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// STL files: what is read, and the reason given for what is not.

#include "body/shape/stl_file.h"

#include <gtest/gtest.h>

#include <cctype>
#include <clocale>
#include <cstring>
#include <limits>
#include <locale>
#include <stdexcept>

using namespace Talus;

namespace {

const std::string facet = "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n"
                          "vertex 0 2.5e-1 0\nendloop\nendfacet\n";

std::string reason(const std::string &content)
{
  try {
    parse_stl(content);
  } catch (const std::runtime_error &problem) {
    return problem.what();
  }
  return "none";
}

void append(std::string &content, float value)
{
  char bytes[4];
  std::memcpy(bytes, &value, 4);
  content.append(bytes, 4);
}

/// n copies of one triangle; the header begins with any text.
std::string binary(std::uint32_t announced, int n, const std::string &text, float odd = 0.5F)
{
  std::string content = text;
  content.resize(80, ' ');
  for (int k = 0; k < 4; k++) content.push_back(static_cast<char>(announced >> 8 * k & 255));
  for (int t = 0; t < n; t++) {
    for (const float v : {0.0F, 0.0F, 1.0F, 0.0F, 0.0F, 0.0F, 1.0F, 0.0F, 0.0F, 0.0F, odd, 0.0F})
      append(content, v);
    content.append(2, '\0');
  }
  return content;
}

TEST(Stl, Ascii)
{
  const auto triangles = parse_stl("solid a name with facet in it\n" + facet + facet +
                                   "endsolid\nsolid b\n" + facet + "endsolid b\n")
                             .triangles;
  ASSERT_EQ(triangles.size(), 3U);
  EXPECT_EQ(triangles[1].corner[1].x, 1.0);
  EXPECT_EQ(triangles[2].corner[2].y, 0.25);
}

TEST(Stl, CommentsInText)
{
  const std::string text = "# exported by a program\n#\n\n  # of mine\nsolid #1\n" + facet +
                           "# the last one\nfacet normal 0 0 1 # up\nouter loop\nvertex 0 0 1\n"
                           "vertex 1 0 1\nvertex 0 1 1\nendloop\nendfacet\nendsolid\n# end";
  const auto triangles = parse_stl(text).triangles;
  ASSERT_EQ(triangles.size(), 2U);
  EXPECT_EQ(triangles[1].corner[2].y, 1.0);
  EXPECT_EQ(reason("# a\n# b\nsolid\nfacet normal 0 0 1\nvertex"),
            "line 5: expected 'outer' instead of 'vertex'");
}

TEST(Stl, BinaryEvenIfItBeginsWithSolid)
{
  for (const char *text : {"", "solid of a program that does not care"}) {
    const auto triangles = parse_stl(binary(2, 2, text)).triangles;
    ASSERT_EQ(triangles.size(), 2U);
    EXPECT_EQ(triangles[1].corner[2].y, 0.5);
    EXPECT_EQ(triangles[1].corner[1].x, 1.0);
  }
}

TEST(Stl, KeywordsInUpperCase)
{
  std::string shouted = "\n  SOLID a Name\n" + facet + "ENDSOLID a Name\n";
  for (char &c : shouted) c = static_cast<char>(std::toupper(c));
  const auto triangles = parse_stl(shouted).triangles;
  ASSERT_EQ(triangles.size(), 1U);
  EXPECT_EQ(triangles[0].corner[2].y, 0.25);
  EXPECT_EQ(reason("Solid x\nFacet Normal 0 0 1\nOuter Loop\nVertex +1.0 .5 O\n"),
            "line 4: expected a finite number instead of 'o'");
}

/// Numbers with a comma, as many countries write them.
class CommaLocale : public std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
};

TEST(Stl, NumbersDoNotDependOnTheLocale)
{
  const std::locale before = std::locale::global(std::locale(std::locale(), new CommaLocale));
  const char *const known = std::setlocale(LC_NUMERIC, nullptr);
  const std::string c_before = known ? known : "C";
  for (const char *name : {"de_DE.UTF-8", "fr_FR.UTF-8", "de_DE"})
    if (std::setlocale(LC_NUMERIC, name)) break;
  const auto triangles = parse_stl("solid\n" + facet + "endsolid\n").triangles;
  std::setlocale(LC_NUMERIC, c_before.c_str());
  std::locale::global(before);
  ASSERT_EQ(triangles.size(), 1U);
  EXPECT_EQ(triangles[0].corner[2].y, 0.25);
}

TEST(Stl, BytesBehindABinaryFileAreCounted)
{
  for (const char *text : {"", "solid of a program that does not care"}) {
    const StlContent content = parse_stl(binary(2, 2, text) + "\nmade by a program");
    EXPECT_EQ(content.triangles.size(), 2U);
    EXPECT_EQ(content.trailing_bytes, 18U);
  }
  EXPECT_EQ(parse_stl(binary(2, 2, "")).trailing_bytes, 0U);
}

TEST(Stl, WhatIsNoStlFileIsSaidToBeNone)
{
  const std::string rest =
      ", where an ASCII file has 'solid' and a binary one a header and triangles";
  const std::string start = "it is no STL file: it begins with ";
  EXPECT_EQ(reason("PK"), start + "'PK'" + rest);
  std::string letter = "Dear all,\n";
  for (int n = 0; n < 40; n++) letter += "this is no surface at all\n";
  EXPECT_EQ(reason(letter), start + "'Dear all,'" + rest);
  std::string png = "\x89PNG\r\n\x1a\n";
  png.append("\0\0\0\rIHDR\0\0\2\200", 12);
  for (unsigned n = 0; n < 2000; n++)    // compressed: any bytes
    png.push_back(static_cast<char>((n * 2654435761U) >> 21));
  EXPECT_EQ(reason(png), start + "no text" + rest);
}

TEST(Stl, ReasonsOfRefusal)
{
  EXPECT_EQ(reason(""), "the file is empty");
  EXPECT_EQ(reason("solid nothing\nendsolid\n"), "it has no triangles");
  EXPECT_EQ(reason(binary(0, 0, "")), "it has no triangles");
  EXPECT_EQ(reason(binary(3, 2, "")),
            "it announces 3 triangles, which are 234 bytes, but has 184 bytes");
  EXPECT_EQ(reason(binary(2, 2, "", std::numeric_limits<float>::infinity())),
            "triangle 1 has a coordinate that is not finite");
  EXPECT_EQ(reason("solid x\n" + facet), "the file ends without 'endsolid'");
  EXPECT_EQ(reason("solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0"),
            "the file ends within a triangle");
  EXPECT_EQ(reason("solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 zero 0\n"),
            "line 4: expected a finite number instead of 'zero'");
  EXPECT_EQ(reason("solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 nan\n"),
            "line 4: expected a finite number instead of 'nan'");
  EXPECT_EQ(reason("solid x\nfacet normal 0 0 1\ninner loop\n"),
            "line 3: expected 'outer' instead of 'inner'");
  EXPECT_EQ(reason("solid x\nvertex\n"),
            "line 2: expected 'facet' or 'endsolid' instead of 'vertex'");
}

}    // namespace
