// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "laws/contact_words.h"

#include "laws/law_list.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace Talus {
namespace {

class Parser {
 public:
  Parser(Words &words, double pressure_unit) : words(words), reader{words, spec, pressure_unit} {}

  ContactSpec parse()
  {
    read_law(Stage::NORMAL, words.choice("normal law", words_of(Stage::NORMAL)));
    while (keyword()) {
    }
    reader.finish();
    if (spec.law.num_coefficients() > ContactCoefficients::size)
      words.fail(1, "these laws together have more coefficients than there is room for");
    return spec;
  }

 private:
  void read_law(Stage stage, int word)
  {
    const Law *chosen = find_law(stage, words_of(stage)[word]);
    spec.law.choose(stage, chosen);
    chosen->read(reader);
  }

  /// Reads one keyword with its arguments; false if the next word is none.
  bool keyword()
  {
    using Method = void (Parser::*)();
    static const std::vector<std::pair<std::string, Method>> known = {
        {"tangential", &Parser::tangential},
        {"damping", &Parser::damping},
        {"rolling", &Parser::rolling},
        {"spinning", &Parser::spinning},
        {"twisting", &Parser::twisting},
        {"adhesion", &Parser::adhesion},
        {"heat", &Parser::heat},
        {"vmin", &Parser::vmin},
        {"limit_damping", &Parser::limit_damping}};
    for (const auto &[word, read] : known) {
      if (!words.is_next(word)) continue;
      if (was_seen(word)) words.fail(0, "keyword '" + word + "' given twice");
      seen.push_back(word);
      words.skip(1);
      (this->*read)();
      return true;
    }
    return false;
  }

  bool was_seen(const std::string &keyword) const
  {
    return std::find(seen.begin(), seen.end(), keyword) != seen.end();
  }

  /// Error at the keyword that has just been read.
  [[noreturn]] void refuse_own(const std::string &what)
  {
    words.fail(1, std::string("'") + spec.law.normal().name + "' has " + what +
                      " of its own: remove '" + seen.back() + "'");
  }

  void tangential()
  {
    if (spec.law.tangential().acts) refuse_own("a tangential force");
    read_law(Stage::TANGENTIAL, words.choice("tangential law", words_of(Stage::TANGENTIAL)));
  }

  void damping()
  {
    if (reader.damping_at < 0) refuse_own("a damping");
    read_law(Stage::DAMPING, words.choice("damping", words_of(Stage::DAMPING)));
    const std::string name = spec.law.damping().name;
    if (spec.law.normal().cohesive && !spec.law.damping().allows_cohesion)
      words.fail(1, "cannot use damping " + name + " with a cohesive normal law, " +
                        spec.law.normal().name + ": use another damping");
  }

  /// A name, or the arguments of the first law.
  void rolling()
  {
    const std::vector<std::string> known = words_of(Stage::ROLLING);
    const auto found = std::find(known.begin(), known.end(), words.peek());
    if (found == known.end()) return read_law(Stage::ROLLING, 0);
    words.skip(1);
    read_law(Stage::ROLLING, static_cast<int>(found - known.begin()));
  }

  /// Two words for one stage.
  void refuse_both(const std::string &other)
  {
    if (was_seen(other))
      words.fail(1, "'spinning' and 'twisting' are two words for one torque: remove one");
  }
  void spinning()
  {
    refuse_both("twisting");
    read_law(Stage::TWISTING, 0);
  }
  void twisting()
  {
    refuse_both("spinning");
    read_law(Stage::TWISTING, words.choice("twisting law", words_of(Stage::TWISTING)));
  }

  void adhesion()
  {
    if (spec.law.normal().cohesive) refuse_own("adhesion");
    read_law(Stage::COHESION, words.choice("adhesion", words_of(Stage::COHESION)));
  }

  void heat() { read_law(Stage::HEAT, words.choice("heat", words_of(Stage::HEAT))); }

  void vmin()
  {
    spec.given["slip_min"] = words.not_negative("slip speed");
    spec.given["roll_min"] = words.not_negative("roll speed");
    spec.given["twist_min"] = words.not_negative("spin speed");
  }

  void limit_damping()
  {
    if (spec.law.normal().cohesive)
      words.fail(1, std::string("cannot limit damping with a cohesive normal law, ") +
                        spec.law.normal().name + ": remove 'limit_damping'");
    spec.given["limit_damping"] = 1.0;
  }

  Words &words;
  ContactSpec spec;
  LawReader reader;
  std::vector<std::string> seen;
};

}    // namespace

ContactSpec parse_contact(Words &words, double pressure_unit)
{
  return Parser(words, pressure_unit).parse();
}

}    // namespace Talus
