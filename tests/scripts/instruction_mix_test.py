#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What scripts/instruction_mix takes instructions for. With SKEIN_COUNT_STEPS, the path of count_steps, it also counts
those of a real step."""
import contextlib
import io
import os
import platform
import shutil
import sys
import unittest
from unittest import mock

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
        self.expect("bt %eax,0x8(%rsp)", ("scalar reads", ""), (SCALAR, ""))

    def test_prefixes_are_no_names(self):
        for line in ("  401:\tdata16 cs nopw 0x0(%rax,%rax,1)", "  401:\tnopw 0x0(%rax,%rax,1)"):
            self.assertEqual(SCRIPT.INSTRUCTION.match(line).groups(), ("401", "nopw", "0x0(%rax,%rax,1)"))
        self.assertEqual(SCRIPT.INSTRUCTION.match("  401:\trep stos %al,%es:(%rdi)")[2], "stos")


@unittest.skipUnless("SKEIN_COUNT_STEPS" in os.environ and shutil.which("objdump") and platform.machine() == "x86_64",
                     "needs count_steps, objdump and an x86-64")
class Counts(unittest.TestCase):
    PROGRAM = os.environ.get("SKEIN_COUNT_STEPS")

    def test_a_step_of_narrow_vectors_multiplies_them_alone(self):
        total, found = SCRIPT.mix(self.PROGRAM, "rk4", "sse4", 4, 1)
        self.assertGreater(total, 1000)
        self.assertGreater(found[MULTIPLY, "128"], 200)
        self.assertEqual(found[MULTIPLY, "512"] + found[MULTIPLY, "256"], 0)

    def test_what_objdump_does_not_know_is_an_error(self):
        with mock.patch.object(SCRIPT, "disassembled", lambda path: {}), self.assertRaises(SystemExit), \
                contextlib.redirect_stderr(io.StringIO()) as said:
            SCRIPT.mix(self.PROGRAM, "rk4", "sse4", 4, 1)
        self.assertIn("objdump knows no instruction at", said.getvalue())


if __name__ == "__main__":
    unittest.main()
