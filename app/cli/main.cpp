// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/program.h"

int main(int argumentCount, char** arguments) {
    return posewire::cli::runProgram(argumentCount, arguments);
}
