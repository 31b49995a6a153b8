#pragma once

#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace eyrie::cli {

/// How a child ended.
struct ChildEnd {
    int exit_code = 0;   ///< 0 for one that a signal ended; −1: not known
    int signal = 0;      ///< 0: it ended by itself
    std::string errors;  ///< the last of what it wrote to standard error

    /// The last line of these, without the name of this program that it may begin with; says so where there is none.
    std::string lastWords() const;
};

/// This program's own file, whatever it is called.
inline constexpr const char* kThisProgram = "/proc/self/exe";

/// This program once more as a process of its own, so that a file that brings it down brings down nothing else; or
/// another one. It gets no input; what it prints goes nowhere. It is asked to stop when this process ends, however that
/// ends.
class ChildProgram {
 public:
    /// `words`: command and arguments. Throws Error(internal) when no process can be made. Only to be called from the
    /// thread that lives as long as the process.
    explicit ChildProgram(const std::vector<std::string>& words, const std::filesystem::path& program = kThisProgram);
    ~ChildProgram();
    ChildProgram(const ChildProgram&) = delete;
    ChildProgram& operator=(const ChildProgram&) = delete;

    /// Asks it to stop, as Ctrl-C does.
    void stop();
    /// How it ended; nothing while it works. Does not wait.
    std::optional<ChildEnd> ended();

 private:
    pid_t process_ = -1;
    int errors_ = -1;
};

}  // namespace eyrie::cli
