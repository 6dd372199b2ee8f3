#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What scripts/instruction_mix takes instructions for. With SKEIN_COUNT_STEPS, the path of count_steps, it also counts
those of a real step."""
import os
import shutil
import sys
import unittest

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))

from script_module import load_script  # noqa: E402

SCRIPT = load_script("instruction_mix")
MULTIPLY, DIVIDE, ADD, PERMUTE = SCRIPT.CLASSES[:4]
SCALAR = SCRIPT.CLASSES[-1]


class Classes(unittest.TestCase):
    def expect(self, line, *classes):
        name, _, operands = line.partition(" ")
        self.assertEqual(sorted(SCRIPT.classes_of(name, operands)), sorted(classes), line)

    def test_arithmetic_goes_by_what_it_does(self):
        self.expect("vfmadd132ps %zmm1,%zmm2,%zmm3", (MULTIPLY, "512"))
        self.expect("vfnmadd231ps %ymm1,%ymm2,%ymm3", (MULTIPLY, "256"))
        self.expect("mulps %xmm1,%xmm2", (MULTIPLY, "128"))
        self.expect("vdivps %zmm1,%zmm2,%zmm3", (DIVIDE, "512"))
        self.expect("vrsqrt14ps %zmm1,%zmm2", (DIVIDE, "512"))
        self.expect("vsubps %zmm1,%zmm2,%zmm3", (ADD, "512"))
        self.expect("vcmpgt_oqps %zmm1,%zmm2,%k1", (ADD, "512"))
        self.expect("vcvttps2dq %zmm1,%zmm2", (ADD, "512"))
        self.expect("vshuff32x4 $0x88,%zmm1,%zmm2,%zmm3", (PERMUTE, "512"))
        self.expect("vpermt2ps %zmm1,%zmm2,%zmm3", (PERMUTE, "512"))
        self.expect("vpaddd %zmm1,%zmm2,%zmm3", ("other vector operations", "512"))
        self.expect("vmovaps %zmm1,%zmm2", ("other vector operations", "512"))

    def test_memory_counts_beside_the_operation(self):
        self.expect("vfmadd213ps 0x40(%rax),%zmm2,%zmm3", (MULTIPLY, "512"), ("vectors read", "512"))
        self.expect("vmovaps 0x40(%rax,%rcx,8),%zmm2", ("vectors read", "512"))
        self.expect("vbroadcastss 0x40(%rax),%zmm2", ("vectors read", "512"))
        self.expect("vmovups %zmm2,0x40(%rax){%k1}", ("vectors written", "512"))
        self.expect("mov 0x8(%rsp),%rax", ("scalar reads", ""))
        self.expect("mov %rax,0x8(%rsp)", ("scalar writes", ""))
        self.expect("addq $0x1,0x8(%rsp)", ("scalar reads", ""), ("scalar writes", ""), (SCALAR, ""))
        self.expect("cmpb $0x0,0x8(%rsp)", ("scalar reads", ""), (SCALAR, ""))

    def test_the_rest_is_scalar(self):
        self.expect("lea 0x8(%rax,%rcx,4),%rdx", (SCALAR, ""))
        self.expect("jne 1234", (SCALAR, ""))
        self.expect("prefetcht0 0x40(%rax)", (SCALAR, ""))
        self.expect("kortestw %k1,%k2", ("masks", ""))
        self.expect("ret ", (SCALAR, ""))


@unittest.skipUnless("SKEIN_COUNT_STEPS" in os.environ and shutil.which("objdump"), "needs count_steps and objdump")
class Counts(unittest.TestCase):
    def test_every_instruction_of_a_step_is_known(self):
        total, found = SCRIPT.mix(os.environ["SKEIN_COUNT_STEPS"], "rk4", "sse4", 16, 1)
        self.assertGreater(total, 1000)
        self.assertGreaterEqual(sum(found.values()), total)
        self.assertGreater(found[MULTIPLY, "128"], 200)
        self.assertEqual(found[MULTIPLY, "512"], 0)


if __name__ == "__main__":
    unittest.main()
