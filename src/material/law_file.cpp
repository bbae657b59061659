// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "material/law_file.h"

#include "laws/law_list.h"

#include <cstring>
#include <stdexcept>

namespace Talus {
namespace {

const char *const cure = "write a data file with the Talus that wrote it, or read it with that one";

void append(std::string &bytes, const std::string &name)
{
  bytes += name;
  bytes += '\0';
}

void append(std::string &bytes, double number)
{
  char raw[sizeof number];
  std::memcpy(raw, &number, sizeof number);
  bytes.append(raw, sizeof raw);
}

class Reader {
 public:
  explicit Reader(const std::string &text) : bytes(text) {}

  bool at_end() const { return next == bytes.size(); }
  std::string name()
  {
    const std::size_t end = bytes.find('\0', next);
    if (end == std::string::npos) fail();
    const std::string word = bytes.substr(next, end - next);
    next = end + 1;
    return word;
  }
  double number()
  {
    double value;
    if (bytes.size() - next < sizeof value) fail();
    std::memcpy(&value, bytes.data() + next, sizeof value);
    next += sizeof value;
    return value;
  }

 private:
  [[noreturn]] static void fail()
  {
    throw std::runtime_error("the contact laws of the restart file are damaged");
  }
  const std::string &bytes;
  std::size_t next = 0;
};

}    // namespace

std::string to_bytes(const ContactSpec &spec)
{
  std::string bytes;
  const ContactLaw &law = spec.law;
  for (int s = 0; s < num_stages; s++) append(bytes, law[static_cast<Stage>(s)].name);
  for (const auto &[name, value] : spec.given.all()) {
    append(bytes, name);
    append(bytes, value);
  }
  return bytes;
}

ContactSpec from_bytes(const std::string &bytes)
{
  Reader reader(bytes);
  ContactSpec spec;
  for (int s = 0; s < num_stages; s++) {
    const Stage stage = static_cast<Stage>(s);
    const std::string name = reader.name();
    const Law *chosen = find_law(stage, name);
    if (!chosen)
      throw std::runtime_error("the restart file has the " + std::string(name_of(stage)) +
                               " law '" + name + "', which this Talus does not have: " + cure);
    spec.law.choose(stage, chosen);
  }
  while (!reader.at_end()) {
    const std::string name = reader.name();
    spec.given[name] = reader.number();
  }
  return spec;
}

}    // namespace Talus
