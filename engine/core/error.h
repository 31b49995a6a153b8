#pragma once

#include <stdexcept>
#include <string>

namespace eyrie {

/// Who has to act on an error; decides the exit code of the command line and the colour of the window's message bar.
enum class ErrorKind {
    parameter,  ///< a parameter is unknown or outside its range
    input,      ///< a file to read is missing, damaged or of a foreign kind
    output,     ///< a file cannot be written
    project,    ///< a project file is foreign, damaged, locked or from a newer version
    internal    ///< a defect of ours
};

/// The only exception that crosses a room's boundary. The message names the file, the place and the remedy.
class Error : public std::runtime_error {
 public:
    Error(ErrorKind kind, const std::string& message) : std::runtime_error(message), kind_(kind) {}
    ErrorKind kind() const { return kind_; }

 private:
    ErrorKind kind_;
};

}  // namespace eyrie
