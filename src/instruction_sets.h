// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The instruction sets that a portable build has styles for, and the choice between them; and what a
// build for one processor needs of the one that it is loaded on. Without LAMMPS and MPI.

#ifndef TALUS_INSTRUCTION_SETS_H
#define TALUS_INSTRUCTION_SETS_H

#include <cstring>
#include <string>

namespace Talus {

/// Slowest first; each contains the ones before it. The words are those of TALUS_ISA, of the files
/// talusstyles-WORD.so, and of the functions in them.
inline constexpr const char *instruction_sets[] = {"baseline", "avx2", "avx512"};
inline constexpr int num_instruction_sets = 3;

/// Index of the fastest set of this processor and its operating system.
inline int fastest_instruction_set()
{
#if defined(__x86_64__)
  // Processors with these have what else the compiler may use at -march=x86-64-v3 and -v4.
  const bool avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
                    __builtin_cpu_supports("bmi") && __builtin_cpu_supports("bmi2");
  const bool avx512 = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
                      __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512dq") &&
                      __builtin_cpu_supports("avx512vl");
  return avx2 && avx512 ? 2 : avx2 ? 1 : 0;
#else
  return 0;
#endif
}

/// Index of a set by its word; -1 if there is no such set.
inline int find_instruction_set(const char *word)
{
  for (int k = 0; k < num_instruction_sets; k++)
    if (std::strcmp(word, instruction_sets[k]) == 0) return k;
  return -1;
}

/// What is wrong with TALUS_ISA=word where `fastest` is the best that all ranks can run; empty if
/// nothing is.
inline std::string problem_of_isa(const std::string &word, int fastest)
{
  const int asked = find_instruction_set(word.c_str());
  if (0 <= asked && asked <= fastest) return {};
  std::string choices;
  for (int k = 0; k <= fastest; k++) choices += (k ? ", " : "") + std::string(instruction_sets[k]);
  return "the environment variable TALUS_ISA is '" + word + "', which " +
         (asked < 0 ? "is no instruction set of Talus" : "not all ranks of this run can execute") +
         "; use one of: " + choices + "; or unset it, and Talus takes the fastest of them";
}

/// Instructions that the code of the styles may consist of, by the compiler's own account, as words of
/// missing_instructions(); ends with nullptr. Plain x86-64 needs none. Data only: needed_instructions.cpp
/// is compiled with the flags of the styles, what reads it for any processor.
extern const char *const needed_instructions[];

/// Those of the list that this processor or its operating system lacks, "avx512f, avx512vl"; empty if
/// the code can run here. A word that is not in the table counts as missing.
inline std::string missing_instructions(const char *const *needed)
{
  std::string missing;
#if defined(__x86_64__)
  const struct {
    const char *word;
    bool here;
  } known[] = {
#define TALUS_KNOWN(word) {word, __builtin_cpu_supports(word) != 0}
      TALUS_KNOWN("ssse3"),
      TALUS_KNOWN("sse4.1"),
      TALUS_KNOWN("sse4.2"),
      TALUS_KNOWN("popcnt"),
      TALUS_KNOWN("avx"),
      TALUS_KNOWN("avx2"),
      TALUS_KNOWN("fma"),
      TALUS_KNOWN("bmi"),
      TALUS_KNOWN("bmi2"),
      TALUS_KNOWN("avx512f"),
      TALUS_KNOWN("avx512bw"),
      TALUS_KNOWN("avx512cd"),
      TALUS_KNOWN("avx512dq"),
      TALUS_KNOWN("avx512vl"),
      TALUS_KNOWN("avx512ifma"),
      TALUS_KNOWN("avx512vbmi"),
      TALUS_KNOWN("avx512vbmi2"),
      TALUS_KNOWN("avx512bitalg"),
      TALUS_KNOWN("avx512vpopcntdq")
#undef TALUS_KNOWN
  };
  for (; *needed; needed++) {
    bool here = false;
    for (const auto &one : known) here = here || (std::strcmp(one.word, *needed) == 0 && one.here);
    if (!here) missing += (missing.empty() ? "" : ", ") + std::string(*needed);
  }
#else
  (void) needed;
#endif
  return missing;
}

}    // namespace Talus

#endif
