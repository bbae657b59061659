// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The reader of words: what it accepts, and for everything else the index and the whole text of the error.

#include "base/number_text.h"
#include "base/words.h"

#include "comma_locale.h"

#include <gtest/gtest.h>

#include <cfloat>
#include <cmath>
#include <stdexcept>

using namespace Talus;

namespace {

struct Fault {
  int index;
  std::string text;
};

/// Words of a command, with their storage: Line("fix_modify wall", "1 2 3").words
class Line {
 public:
  Line(const std::string &line, int first = 0) :
      stored(split(line)), pointers(pointers_to(stored)),
      words("command", static_cast<int>(pointers.size()), pointers.data(), first,
            [](int index, const std::string &text) {
              throw Fault{index, text};
            })
  {
  }
  Line(const Line &) = delete;
  Line &operator=(const Line &) = delete;

 private:
  static std::vector<std::string> split(const std::string &line)
  {
    std::vector<std::string> found;
    std::size_t begin = 0, end = 0;
    while ((begin = line.find_first_not_of(' ', end)) != std::string::npos) {
      end = std::min(line.find(' ', begin), line.size());
      found.push_back(line.substr(begin, end - begin));
    }
    return found;
  }
  static std::vector<const char *> pointers_to(const std::vector<std::string> &words)
  {
    std::vector<const char *> found;
    found.reserve(words.size());
    for (const std::string &word : words) found.push_back(word.c_str());
    return found;
  }

  std::vector<std::string> stored;
  std::vector<const char *> pointers;

 public:
  Words words;
};

/* The error that reading ends in; index -1 and the text "no error" if there is none. */

template <class Read> Fault fault_of(const std::string &line, Read read)
{
  Line of(line);
  try {
    read(of.words);
  } catch (const Fault &fault) {
    return fault;
  }
  return {-1, "no error"};
}

template <class Read>
void expect_fault(const std::string &line, Read read, int index, const std::string &text)
{
  const Fault fault = fault_of(line, read);
  EXPECT_EQ(fault.index, index) << line;
  EXPECT_EQ(fault.text, text) << line;
}

double number(const std::string &word)
{
  return Line(word).words.number("n");
}

TEST(Words, AreReadOneAfterAnother)
{
  Line line("zero one two three four", 1);
  Words &words = line.words;
  EXPECT_EQ(words.index(), 1);
  EXPECT_FALSE(words.at_end());
  EXPECT_TRUE(words.is_next("one"));
  EXPECT_FALSE(words.is_next("two"));
  EXPECT_EQ(words.peek(), "one");
  EXPECT_FALSE(words.take("two"));
  EXPECT_EQ(words.index(), 1);
  EXPECT_TRUE(words.take("one"));
  EXPECT_EQ(words.text("a word"), "two");
  words.skip(1);
  EXPECT_EQ(words.index(), 4);
  EXPECT_EQ(words.text("a word"), "four");
  EXPECT_TRUE(words.at_end());
  EXPECT_EQ(words.peek(), "");
  EXPECT_FALSE(words.is_next(""));
  EXPECT_FALSE(words.take("four"));
}

TEST(Words, ThatAreLeft)
{
  Line line("one", 1);
  line.words.end();    // nothing is left
  expect_fault(
      "one two",
      [](Words &w) {
        w.skip(1);
        w.end();
      },
      1, "command: surplus word 'two'");
}

TEST(Words, ThatAreMissing)
{
  // the last word is the one at fault where there is none
  expect_fault(
      "one",
      [](Words &w) {
        w.skip(1);
        w.text("the name");
      },
      0, "command: missing the name");
  expect_fault(
      "", [](Words &w) { w.text("the name"); }, -1, "command: missing the name");
  expect_fault(
      "1", [](Words &w) { w.vector("place"); }, 0, "command: missing place (a number)");
  expect_fault(
      "1 2", [](Words &w) { w.direction("axis"); }, 1, "command: missing axis (a number)");
  expect_fault(
      "", [](Words &w) { w.positive("radius"); }, -1, "command: missing radius (a number > 0)");
  expect_fault(
      "", [](Words &w) { w.integer("count", 1); }, -1,
      "command: missing count (a whole number >= 1)");
  expect_fault(
      "",
      [](Words &w) {
        w.choice("law", {"hooke", "hertz"});
      },
      -1, "command: missing law: hooke or hertz");
}

TEST(Words, ThatAreOneOfSome)
{
  const std::vector<std::string> laws{"none", "hooke", "hertz"};
  Line line("hertz none");
  EXPECT_EQ(line.words.choice("law", laws), 2);
  EXPECT_EQ(line.words.choice("law", laws), 0);
  expect_fault(
      "a b",
      [&](Words &w) {
        w.skip(1);
        w.choice("law", laws);
      },
      1, "command: unknown law 'b', expected none, hooke or hertz");
  expect_fault(
      "x", [](Words &w) { w.choice("law", {"hooke"}); }, 0,
      "command: unknown law 'x', expected hooke");
  expect_fault(
      "Hooke", [&](Words &w) { w.choice("law", laws); }, 0,
      "command: unknown law 'Hooke', expected none, hooke or hertz");
}

TEST(Words, WhatTheyAreAbout)
{
  const auto about_walls = [](Words &w) {
    w.about("for types 1 2");
    w.positive("stiffness");
  };
  expect_fault("-1", about_walls, 0,
               "command for types 1 2: expected stiffness (a number > 0) instead of '-1'");
  expect_fault(
      "-1",
      [&](Words &w) {
        w.about("x");
        w.about("");
        w.positive("stiffness");
      },
      0, "command: expected stiffness (a number > 0) instead of '-1'");
}

TEST(Words, OwnErrors)
{
  expect_fault(
      "a b c",
      [](Words &w) {
        w.skip(2);
        w.fail(0, "no");
      },
      2, "command: no");
  expect_fault(
      "a b c",
      [](Words &w) {
        w.skip(2);
        w.fail(2, "no");
      },
      0, "command: no");
  expect_fault(
      "a b c",
      [](Words &w) {
        w.skip(3);
        w.fail(0, "no");
      },
      2, "command: no");
}

TEST(Words, ThrowIfTheHandlerReturns)
{
  const char *const arg[] = {"x"};
  Words words("command", 1, arg, 0, [](int, const std::string &) {});
  EXPECT_THROW(words.number("n"), std::logic_error);
}

TEST(Numbers, ThatAreAccepted)
{
  EXPECT_EQ(number("0"), 0.0);
  EXPECT_EQ(number("12"), 12.0);
  EXPECT_EQ(number("+12"), 12.0);
  EXPECT_EQ(number("-.5"), -0.5);
  EXPECT_EQ(number("5."), 5.0);
  EXPECT_EQ(number("1e3"), 1000.0);
  EXPECT_EQ(number("1E+3"), 1000.0);
  EXPECT_EQ(number("2.5e-3"), 2.5e-3);
  EXPECT_TRUE(std::signbit(number("-0")));
  EXPECT_EQ(number("0.1"), 0.1);
  EXPECT_EQ(number("1.7976931348623157e308"), DBL_MAX);
  EXPECT_EQ(number("4.9406564584124654e-324"), DBL_TRUE_MIN);
}

TEST(Numbers, TooSmallForADoubleAreZero)
{
  EXPECT_EQ(number("1e-400"), 0.0);
  EXPECT_EQ(number("-1E-400"), 0.0);
  const std::string digits = "0." + std::string(400, '0') + "1";
  EXPECT_EQ(number(digits), 0.0);
}

TEST(Numbers, ThatAreRefused)
{
  const auto read = [](Words &w) { w.number("n"); };
  for (const std::string word :
       {"1e400", "-1e400", "1e+400", "nan",  "NAN",   "-nan", "inf",  "-inf", "infinity",
        "0x10",  "0x1p3",  "1,5",    "1.5x", "1d3",   "e3",   "1e",   "+",    "-",
        "+-1",   "++1",    ".",      "--1",  "1_000", "v_x",  "NULL", "1e-"})
    expect_fault(word, read, 0, "command: expected n (a number) instead of '" + word + "'");
  const char *const empty[] = {""};
  Words words("command", 1, empty, 0, [](int index, const std::string &text) {
    throw Fault{index, text};
  });
  EXPECT_THROW(words.number("n"), Fault);
}

TEST(Numbers, WithAHugeNumberOfDigitsAreRefused)
{
  EXPECT_EQ(fault_of(std::string(400, '9'), [](Words &w) { w.number("n"); }).index, 0);
  EXPECT_EQ(fault_of("1" + std::string(400, '0') + "e-50", [](Words &w) { w.number("n"); }).index,
            0);
}

TEST(Numbers, InARange)
{
  EXPECT_EQ(Line("0").words.not_negative("n"), 0.0);
  EXPECT_EQ(Line("1e-300").words.positive("n"), 1e-300);
  EXPECT_EQ(Line("0.5").words.between("n", 0.5, 2.0), 0.5);
  EXPECT_EQ(Line("2").words.between("n", 0.5, 2.0), 2.0);
  EXPECT_EQ(Line("2").words.between("n", 0.5, 2.0, true), 2.0);

  expect_fault(
      "-1e-300", [](Words &w) { w.not_negative("n"); }, 0,
      "command: expected n (a number >= 0) instead of '-1e-300'");
  expect_fault(
      "0", [](Words &w) { w.positive("n"); }, 0,
      "command: expected n (a number > 0) instead of '0'");
  expect_fault(
      "1e-400", [](Words &w) { w.positive("n"); }, 0,
      "command: expected n (a number > 0) instead of '1e-400'");
  for (const std::string word : {"0.49", "2.1", "nan"})
    expect_fault(
        word, [](Words &w) { w.between("n", 0.5, 2.0); }, 0,
        "command: expected n (a number from 0.5 to 2) instead of '" + word + "'");
  expect_fault(
      "0.5", [](Words &w) { w.between("n", 0.5, 2.0, true); }, 0,
      "command: expected n (a number above 0.5, up to 2) instead of '0.5'");
}

TEST(Numbers, OrNull)
{
  double value = 7.0;
  EXPECT_FALSE(Line("NULL").words.not_negative_or_null("n", value));
  EXPECT_EQ(value, 7.0);
  EXPECT_TRUE(Line("3").words.not_negative_or_null("n", value));
  EXPECT_EQ(value, 3.0);
  EXPECT_EQ(Line("NULL").words.number_or_null("n"), 0.0);
  EXPECT_EQ(Line("-3").words.number_or_null("n"), -3.0);
  expect_fault(
      "-1", [&](Words &w) { w.not_negative_or_null("n", value); }, 0,
      "command: expected n (a number >= 0) instead of '-1'");
  expect_fault(
      "null", [](Words &w) { w.number_or_null("n"); }, 0,
      "command: expected n (a number) instead of 'null'");
}

TEST(Numbers, WithoutAFraction)
{
  EXPECT_EQ(Line("-3").words.integer("n", -3), -3);
  EXPECT_EQ(Line("2147483647").words.integer("n", 0), 2147483647);
  EXPECT_EQ(Line("1e3").words.integer("n", 0), 1000);
  for (const std::string word : {"-4", "0.5", "2147483648", "1e20", "nan", "x"})
    expect_fault(
        word, [](Words &w) { w.integer("n", -3); }, 0,
        "command: expected n (a whole number >= -3) instead of '" + word + "'");
}

TEST(Numbers, ByThrees)
{
  Line line("1 -2 3e0 4");
  const Vector3<double> v = line.words.vector("place");
  EXPECT_EQ(v.x, 1.0);
  EXPECT_EQ(v.y, -2.0);
  EXPECT_EQ(v.z, 3.0);
  EXPECT_EQ(line.words.index(), 3);
  expect_fault(
      "1 b 3", [](Words &w) { w.vector("place"); }, 1,
      "command: expected place (a number) instead of 'b'");
}

TEST(Numbers, OfADirection)
{
  const auto unit = [](const std::string &line) { return Line(line).words.direction("axis"); };
  const Vector3<double> v = unit("3 0 -4");
  EXPECT_EQ(v.x, 1.0 / 5.0 * 3.0);
  EXPECT_EQ(v.y, 0.0);
  EXPECT_EQ(v.z, 1.0 / 5.0 * -4.0);
  for (const std::string size :
       {"1e300", "1e-300", "1.5e308", "4e-324", "1e150", "1e-150", "1e160", "1e-160"}) {
    const Vector3<double> w = unit(size + " -" + size + " " + size);
    for (const double c : {w.x, -w.y, w.z}) EXPECT_NEAR(c, std::sqrt(1.0 / 3.0), 1e-15) << size;
  }
  const Vector3<double> uneven = unit("1e300 1e-300 0");
  EXPECT_EQ(uneven.x, 1.0);
  EXPECT_EQ(uneven.z, 0.0);
  expect_fault(
      "0 0 -0 1", [](Words &w) { w.direction("axis"); }, 0, "command: axis must not be zero");
  expect_fault(
      "a 0 1e-400 0",
      [](Words &w) {
        w.skip(1);
        w.direction("axis");
      },
      1, "command: axis must not be zero");
  expect_fault(
      "0 inf 0", [](Words &w) { w.direction("axis"); }, 1,
      "command: expected axis (a number) instead of 'inf'");
}

TEST(Numbers, DoNotDependOnTheLocale)
{
  const CommaLocale comma;
  ASSERT_TRUE(comma.works);
  ASSERT_EQ(std::strtod("0,5", nullptr), 0.5);
  EXPECT_EQ(number("0.5"), 0.5);
  EXPECT_EQ(number_text(1234.5), "1234.5");
  EXPECT_EQ(number_text(1.0 / 3.0, 4), "0.3333");
  EXPECT_EQ(number_text(-2.5e-7), "-2.5e-07");
  expect_fault(
      "0,5", [](Words &w) { w.number("n"); }, 0, "command: expected n (a number) instead of '0,5'");
  expect_fault(
      "0", [](Words &w) { w.between("n", 0.5, 2.0); }, 0,
      "command: expected n (a number from 0.5 to 2) instead of '0'");
}

}    // namespace
