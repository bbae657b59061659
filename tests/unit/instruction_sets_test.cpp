// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The choice between the instruction sets of a portable build; what another build needs of a processor.

#include "instruction_sets.h"

#include "base/simd.h"

#include <gtest/gtest.h>

using namespace Talus;

TEST(InstructionSets, WordsAreFound)
{
  EXPECT_EQ(find_instruction_set("baseline"), 0);
  EXPECT_EQ(find_instruction_set("avx2"), 1);
  EXPECT_EQ(find_instruction_set("avx512"), 2);
  EXPECT_EQ(find_instruction_set("AVX2"), -1);
  EXPECT_EQ(find_instruction_set(""), -1);
}

TEST(InstructionSets, WhatThisTestWasCompiledForIsFound)
{
  const std::string compiled = instruction_set();
  const int least = compiled == "AVX-512" ? 2 : compiled == "AVX2" ? 1 : 0;
  EXPECT_GE(fastest_instruction_set(), least);
  EXPECT_LT(fastest_instruction_set(), num_instruction_sets);
}

TEST(InstructionSets, WhatAllRanksCanRunIsAccepted)
{
  for (int fastest = 0; fastest < num_instruction_sets; fastest++)
    for (int asked = 0; asked <= fastest; asked++)
      EXPECT_EQ(problem_of_isa(instruction_sets[asked], fastest), "");
}

TEST(InstructionSets, ComplaintsNameVariableWordAndCure)
{
  EXPECT_EQ(problem_of_isa("sse2", 2),
            "the environment variable TALUS_ISA is 'sse2', which is no instruction set of Talus; "
            "use one of: baseline, avx2, avx512; or unset it, and Talus takes the fastest of them");
  EXPECT_EQ(
      problem_of_isa("avx512", 1),
      "the environment variable TALUS_ISA is 'avx512', which not all ranks of this run can "
      "execute; use one of: baseline, avx2; or unset it, and Talus takes the fastest of them");
  EXPECT_NE(problem_of_isa("avx2", 0), "");
}

TEST(InstructionSets, WhatThisTestWasCompiledForIsNotMissing)
{
  EXPECT_EQ(missing_instructions(needed_instructions), "");
  const std::string compiled = instruction_set();
  const auto needs = [](const char *word) {
    for (const char *const *one = needed_instructions; *one; one++)
      if (std::string(word) == *one) return true;
    return false;
  };
  EXPECT_EQ(needs("avx2"), compiled == "AVX2" || compiled == "AVX-512");
  EXPECT_EQ(needs("avx512f"), compiled == "AVX-512");
}

#if defined(__x86_64__)
TEST(InstructionSets, WhatIsMissingIsNamed)
{
  const char *const none[] = {nullptr}, *const two[] = {"avx1024f", "avx1024vl", nullptr};
  EXPECT_EQ(missing_instructions(none), "");
  EXPECT_EQ(missing_instructions(two), "avx1024f, avx1024vl");
}
#endif
