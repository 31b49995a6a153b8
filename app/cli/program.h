#pragma once

namespace eyrie::cli {

/// All of eyrie-cli: takes what main() is given, prints, and answers the exit code. Once in a process, since it
/// prepares the standard streams.
int runProgram(int argc, char** argv);

}  // namespace eyrie::cli
