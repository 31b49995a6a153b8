#include "cli/program.h"

int main(int argc, char** argv) {
    return eyrie::cli::runProgram(argc, argv);
}
