// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The words of tangential laws with friction.

#include "laws/law_list.h"
#include "laws/tangential/common.h"
#include "laws/tangential/multistep.h"

#include <string>

namespace Talus {

void read_friction(LawReader &r, bool with_kt, bool needs_spring)
{
  Words &words = r.words;
  GivenNumbers &given = r.spec.given;
  const ContactLaw &law = r.spec.law;
  const int at_kt = words.index();
  double kt = 0.0, gt = 0.0;
  const bool has_kt = with_kt && words.not_negative_or_null("kt", kt);
  const int at_gt = words.index();
  const bool has_gt = words.not_negative_or_null("gt", gt);
  r.set_not_negative("mu");
  const auto complain = [&words](int at, const std::string &what) {
    words.fail(words.index() - at, what);
  };
  r.check_later(at_gt, [has_gt](const ContactLaw &whole) -> std::string {
    const Law &damping = whole.damping();
    if (!has_gt && damping.needs_gt)
      return std::string("expected a number for gt instead of NULL: ") + damping.needs_gt;
    if (has_gt && damping.takes_no_gt)
      return std::string("expected NULL for gt: ") + damping.takes_no_gt;
    return "";
  });
  if (has_kt && law.normal().takes_no_kt)
    complain(at_kt, std::string("expected NULL for kt: ") + law.normal().takes_no_kt);
  // a spring of a linear law is not a pressure
  if (has_kt) given["kt"] = law.normal().exponent == 1.0 ? kt : kt * r.pressure_unit;
  if (has_gt) given["gt"] = gt;
  const bool missing = has_kt ? kt == 0.0 : given.has("kn") && given.value("kn") == 0.0;
  if (needs_spring && missing)
    complain(at_kt, "tangential multistep needs kt > 0; without a tangential spring use "
                    "'tangential dashpot'");
}

void MultistepStock::read(LawReader &r)
{
  read_friction(r, true, true);
  bool midpoint = false;
  std::string rule;
  const auto is_rule = [](const std::string &word) {
    return word == "stock" || word == "slider" || word == "spring";
  };
  for (std::string word = r.words.peek(); word == "midpoint" || is_rule(word);
       word = r.words.peek()) {
    r.words.skip(1);
    if (word == "midpoint" ? midpoint : !rule.empty())
      r.words.fail(1, "surplus word '" + word + "' after tangential multistep");
    if (word == "midpoint")
      midpoint = true;
    else
      rule = word;
  }
  if (rule.empty()) rule = r.spec.law.normal().like_stock ? "stock" : "slider";
  if (midpoint && rule == "spring")
    r.words.fail(1, "'spring' is a rule for the plain update: remove 'midpoint', or use 'slider'");
  const std::string name =
      "multistep" + (rule == "stock" ? "" : " " + rule) + (midpoint ? " midpoint" : "");
  r.spec.law.choose(Stage::TANGENTIAL, find_law(Stage::TANGENTIAL, name));
}

}    // namespace Talus
