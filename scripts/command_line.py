# SPDX-License-Identifier: Apache-2.0
"""What the command lines of scripts share."""
import argparse
import os
import sys


class Parser(argparse.ArgumentParser):
    """Of a script, whose documentation it prints as help. It says in one line what is wrong with arguments."""

    def __init__(self, documentation):
        super().__init__(prog=f"scripts/{os.path.basename(sys.argv[0])}", description=documentation,
                         formatter_class=argparse.RawDescriptionHelpFormatter)

    def error(self, message):
        self.exit(2, f"{self.prog}: {message} (see {self.prog} --help)\n")


def existing_program(path):
    """The type of an argument that names a program; its absolute path, as a mere name would be looked for in PATH."""
    if not (os.path.isfile(path) and os.access(path, os.X_OK)):
        raise argparse.ArgumentTypeError(f"{path}: no such program")
    return os.path.abspath(path)
