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
    if (!spec.law.history().fits)
      words.fail(1, "these laws together remember more of a contact than there is room for");
    if (spec.law.num_coefficients() > ContactCoefficients::size)
      words.fail(1, "these laws together have more coefficients than there is room for");
    return spec;
  }

 private:
  void read_law(Stage stage, int word)
  {
    const Law *its = find_law(stage, words_of(stage)[word]);
    spec.law.choose(stage, its);
    its->read(reader);
  }

  /// Reads one keyword with its arguments; false if the next word is none.
  bool keyword()
  {
    using Method = void (Parser::*)();
    static const std::vector<std::pair<std::string, Method>> known = {
        {"tangential", &Parser::tangential},
        {"rolling", &Parser::rolling},
        {"spinning", &Parser::spinning},
        {"adhesion", &Parser::adhesion},
        {"vmin", &Parser::vmin},
        {"limit_damping", &Parser::limit_damping}};
    for (const auto &[word, read] : known) {
      if (!words.is_next(word)) continue;
      if (std::find(seen.begin(), seen.end(), word) != seen.end())
        words.fail(0, "keyword '" + word + "' given twice");
      seen.push_back(word);
      words.skip(1);
      (this->*read)();
      return true;
    }
    return false;
  }

  void tangential()
  {
    if (spec.law.tangential().acts)
      words.fail(1, std::string("'") + spec.law.normal().name +
                        "' has a tangential force of its own: remove 'tangential'");
    read_law(Stage::TANGENTIAL, words.choice("tangential law", words_of(Stage::TANGENTIAL)));
  }

  /// A name, or the arguments of the first law that has any.
  void named_or_first(Stage stage)
  {
    const std::vector<std::string> known = words_of(stage);
    const auto found = std::find(known.begin(), known.end(), words.peek());
    if (found == known.end()) return read_law(stage, 0);
    words.skip(1);
    read_law(stage, static_cast<int>(found - known.begin()));
  }
  void rolling() { named_or_first(Stage::ROLLING); }
  void spinning() { named_or_first(Stage::TWISTING); }

  void adhesion()
  {
    read_law(Stage::COHESION, words.choice("adhesion", words_of(Stage::COHESION)));
  }

  void vmin()
  {
    spec.given["slip_min"] = words.not_negative("slip speed");
    spec.given["roll_min"] = words.not_negative("roll speed");
    spec.given["twist_min"] = words.not_negative("spin speed");
  }

  void limit_damping() { spec.given["limit_damping"] = 1.0; }

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
