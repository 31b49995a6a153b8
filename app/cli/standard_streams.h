#pragma once

namespace eyrie::cli {

/// Call first. Streams that the caller closed are opened on nothing, so that no file of ours gets their numbers and our
/// words; writing into a pipe that nobody reads becomes an error instead of the end of the process.
void prepareStreams();

/// Call last. Writes what is still to be printed; false, with one line on standard error, when any of it was lost
/// (a full disk, a reader that has gone).
bool finishOutput();

}  // namespace eyrie::cli
