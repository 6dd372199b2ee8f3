// SPDX-License-Identifier: Apache-2.0
#include "src/program.h"

int main(int argc, char** argv) { return skein::RunProgram(argc, argv); }
